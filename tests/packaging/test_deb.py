"""CPack's Debian package: its fields, its dependencies, and what it holds."""
import shutil
import unittest

from support import PackagingTest, build


@unittest.skipUnless(shutil.which("dpkg-shlibdeps") and shutil.which("file"), "no Debian tools for packages (dpkg-dev, file)")
class DebianPackage(PackagingTest):
    def test_package(self):
        self.command("cpack", "-G", "DEB", "--config", build / "CPackConfig.cmake", "-B", self.folder)
        packages = list(self.folder.glob("*.deb"))
        self.assertEqual(len(packages), 1, packages)
        package = packages[0]
        architecture = self.command("dpkg", "--print-architecture").strip()
        self.assertRegex(package.name, rf"^vitrum_\d+\.\d+\.\d+_{architecture}\.deb$")

        self.assertIn("Package: vitrum", self.command("dpkg-deb", "-I", package))
        dependencies = self.command("dpkg-deb", "-f", package, "Depends")
        for library in ("libc6", "libstdc++6", "libhdf5", "libklu", "libssl"):
            self.assertIn(library, dependencies)
        self.assertNotIn("mpi", dependencies)  # computes in one process (cmake/SerialSundials.cmake)

        contents = [line.split()[5] for line in self.command("dpkg-deb", "-c", package).splitlines()]
        self.assertTrue(all(name.startswith("./usr/") or name in ("./", "./usr") for name in contents), contents)
        for name in ("bin/vitrum", "bin/vitrum-report", "bin/vitrum-study", "include/vitrum/materials/law.hpp", "share/vitrum/studies/plot_run.py", "lib/python3/dist-packages/vitrum",
                     "share/doc/vitrum/CITATION.cff", "share/doc/vitrum/examples/point/point.cpp"):
            self.assertIn(f"./usr/{name}", contents)
        self.assertTrue(any(name.endswith("cmake/vitrum/vitrumConfig.cmake") for name in contents))
        self.assertFalse([name for name in contents if "__pycache__" in name or "/tests/" in name])

        self.command("dpkg-deb", "-x", package, "root")
        self.assertIn("vitrum", self.command(self.folder / "root/usr/bin/vitrum", "--version"))


if __name__ == "__main__":
    unittest.main()
