"""vitrum as a subdirectory of another project: its paths are its own, and what it builds for itself stays out."""
import unittest

from support import PackagingTest, source


class Subproject(PackagingTest):
    def test_parent_links_the_laws(self):
        self.command("cmake", "-G", "Ninja", "-S", source / "tests/packaging/parent", "-B", "parent", f"-DVITRUM_SOURCE_DIR={source}",
                     "-DCMAKE_CXX_FLAGS=-O1")
        cache = (self.folder / "parent/CMakeCache.txt").read_text()
        self.assertIn("CMAKE_BUILD_TYPE:STRING=\n", cache)
        self.assertNotIn("Catch2_DIR", cache)
        self.command("cmake", "--build", "parent", "--target", "point")
        self.assert_drives_point(self.folder / "parent/point")


if __name__ == "__main__":
    unittest.main()
