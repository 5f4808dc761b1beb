"""The script `quickstart` beside a CMake, an apt-get and a program that only write down how they were called."""
import os
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Quickstart(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name) / "a place, with blanks"
        self.tools = Path(folder.name) / "tools"
        self.log = Path(folder.name) / "calls"
        self.home.mkdir()
        self.tools.mkdir()
        self.log.write_text("")
        shutil.copy(ROOT / "quickstart", self.home)
        self.program(self.home / "build/release/src/app/vitrum", "")
        for name in ("dirname", "grep", "rm", "mkdir"):
            (self.tools / name).symlink_to(shutil.which(name))
        self.tool("cmake", "")
        self.tool("ctest", "")
        self.tool("apt-get", "")
        self.tool("id", "echo 1000\n")
        self.installed("")

    def program(self, path, body):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#!/bin/sh\necho "{path.name} $*" >> "{self.log}"\n{body}')
        path.chmod(path.stat().st_mode | stat.S_IXUSR)

    def tool(self, name, body):
        self.program(self.tools / name, body)

    def installed(self, missing):
        """dpkg-query says of each package that it is there, but of those that the pattern names."""
        self.tool("dpkg-query", f'case "$4" in {missing or "nothing"}) exit 1;; esac\nprintf "install ok installed"\n')

    def run_it(self, *arguments):
        done = subprocess.run(["/bin/sh", "quickstart", *arguments], cwd=self.home, text=True, capture_output=True,
                              env={"PATH": str(self.tools), "HOME": os.environ.get("HOME", "/")})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        calls = [call for call in self.log.read_text().splitlines() if not call.startswith(("dpkg-query", "id"))]
        return done.stdout, calls

    def test_a_first_picture_needs_the_program_alone(self):
        built = self.home / "build"
        built.rename(self.home / "to be built")
        self.tool("cmake", f'[ -e "{built}" ] || /bin/cp -r "{self.home}/to be built" "{built}"\n')
        (self.home / "studies").mkdir()
        for script in ("plot_run.py", "vitrum-report"):
            (self.home / "studies" / script).write_text("")
        _, calls = self.run_it()
        self.assertIn("cmake --preset release -DVITRUM_TESTS=OFF", calls)
        self.assertIn("cmake --build --preset release --target vitrum", calls)
        self.assertEqual(sum(call.startswith("vitrum run") for call in calls), 2)

    def test_the_suite_is_built_whole(self):
        _, calls = self.run_it("test", "asan")
        self.assertEqual(calls, ["cmake --preset asan -DVITRUM_TESTS=ON", "cmake --build --preset asan", "ctest --preset asan"])

    def test_the_pages_need_no_build(self):
        """And no package of the program."""
        self.installed("libsundials-dev|python3-sphinx-rtd-theme")
        self.tool("sphinx-build", "")
        out, calls = self.run_it("docs")
        self.assertEqual(calls, ["sphinx-build -q -W --keep-going -c docs/site docs build/docs"])
        self.assertIn("apt-get install python3-sphinx-rtd-theme", out)
        self.assertNotIn("libsundials-dev", out)
        self.assertIn("build/docs/index.html", out)

    def test_a_moved_checkout_builds_anew_and_says_so(self):
        cache = self.home / "build/release/CMakeCache.txt"
        for home, moved in ((str(self.home), False), ("/somewhere/else", True)):
            cache.write_text(f"A:STRING=b\nCMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
            out, _ = self.run_it("test")
            self.assertEqual("moved or copied" in out, moved, out)
            self.assertEqual(cache.exists(), not moved)

    def test_a_study_file_is_named_from_where_one_stands(self):
        self.program(self.home / "studies/vitrum-study", "")
        elsewhere = self.home.parent / "else where"
        elsewhere.mkdir()
        (elsewhere / "mine.toml").write_text("")
        done = subprocess.run(["/bin/sh", self.home / "quickstart", "study", "mine.toml", "--quick", "--cores", "1"], cwd=elsewhere, text=True, capture_output=True,
                              env={"PATH": str(self.tools), "HOME": "/"})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.log.read_text().splitlines()[-1], f"vitrum-study {elsewhere}/mine.toml --quick --cores 1")

    def test_without_root_it_names_what_is_missing_and_goes_on(self):
        self.installed("catch2|libfmt-dev")
        out, calls = self.run_it("test")
        self.assertIn("apt-get install libfmt-dev", out)
        self.assertIn("apt-get install catch2", out)
        self.assertEqual(calls[-1], "ctest --preset release")
        self.assertFalse(any(call.startswith("apt-get") for call in calls))

    def test_a_package_that_cannot_be_had_ends_nothing(self):
        self.tool("id", "echo 0\n")
        self.tool("apt-get", '[ "$1" != install ]\n')
        self.installed("snakemake")
        out, calls = self.run_it("test")
        self.assertIn("could not be installed: going on without. the test suite needs: snakemake", out)
        self.assertEqual(calls[-1], "ctest --preset release")


if __name__ == "__main__":
    unittest.main()
