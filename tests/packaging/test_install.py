"""`cmake --install`: a prefix that works wherever it is, and a package that others' CMake finds."""
import os
import re
import shutil
import unittest

from support import PackagingTest, build, source


class Install(PackagingTest):
    def setUp(self):
        super().setUp()
        self.prefix = self.folder / "prefix"
        self.command("cmake", "--install", build, "--prefix", self.prefix)

    def test_program_is_the_one_that_was_built(self):
        self.assertEqual(self.command(self.prefix / "bin/vitrum", "--version"), self.command(build / "src/app/vitrum", "--version"))

    def test_example_is_built_against_the_prefix(self):
        moved = self.folder / "moved"
        self.prefix.rename(moved)  # nothing in it may name where it was installed
        examples = list(moved.glob("share/doc/vitrum/examples/point"))
        self.assertEqual(len(examples), 1)
        self.command("cmake", "-G", "Ninja", "-S", examples[0], "-B", "example", f"-DCMAKE_PREFIX_PATH={moved}", "-DCMAKE_BUILD_TYPE=Release")
        self.command("cmake", "--build", "example")
        self.assert_drives_point(self.folder / "example/point")

    def test_every_command_has_a_page(self):
        if not shutil.which("help2man"):
            self.skipTest("no help2man")
        help_text = self.command(self.prefix / "bin/vitrum", "--help")
        commands = re.findall(r"^  (\w+)  ", help_text.split("Subcommands:")[1], re.MULTILINE)
        self.assertIn("run", commands)
        pages = {page.stem for page in (self.prefix / "share/man/man1").iterdir()}
        self.assertEqual(pages, {"vitrum"} | {f"vitrum-{command}" for command in commands})
        for command in commands:
            page = (self.prefix / f"share/man/man1/vitrum-{command}.1").read_text().replace("\\", "")
            help_text = self.command(self.prefix / "bin/vitrum", command, "--help")
            for option in set(re.findall(r"^  (--[\w-]+)", help_text, re.MULTILINE)):
                self.assertIn(option, page)
            self.assertNotIn(str(build), page)

    def test_python_package_runs_the_program_beside_it(self):
        moved = self.folder / "moved"
        self.prefix.rename(moved)
        code = "import vitrum, vitrum.program; print(vitrum.program.program()); print(vitrum.run(%r, {'time.end': 1e-7}).bodies)"
        environment = {**os.environ, "PYTHONPATH": str(moved / "lib/python3/dist-packages"), "PYTHONDONTWRITEBYTECODE": "1"}
        environment.pop("VITRUM", None)
        said = self.command("/usr/bin/python3", "-c", code % str(source / "tests/cli/scenes/impact.toml"), env=environment)
        self.assertEqual(said.splitlines(), [str(moved / "bin/vitrum"), "['plate', 'cylinder']"])

    def test_report_of_a_run_is_written_by_what_is_installed(self):
        run = self.folder / "run"
        self.command(self.prefix / "bin/vitrum", "run", source / "tests/cli/scenes/impact.toml", "--out", run)
        self.command(self.prefix / "bin/vitrum-report", run, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
        self.assertIn("The run is complete", (run / "report.html").read_text())

    def test_study_of_a_scene_runs_by_what_is_installed(self):
        study = self.folder / "mine.toml"
        study.write_text(f'scene = "{source}/tests/cli/scenes/impact.toml"\nset = {{"time.end" = 1e-6}}\n[vary]\n"body.cylinder.velocity.1" = [-100, -200]\n'
                         '[report]\nkinds = ["sweep"]\n')
        environment = {key: value for key, value in os.environ.items() if key != "VITRUM"} | {"PYTHONDONTWRITEBYTECODE": "1"}
        self.command(self.prefix / "bin/vitrum-study", study, env=environment)
        self.assertEqual(len((self.folder / "out/study-mine/tables/sweep.csv").read_text().splitlines()), 3)
        outcomes = list((self.folder / "out/study-mine/runs").rglob("outcome.json"))
        self.assertEqual(len(outcomes), 2)
        for outcome in outcomes:
            self.assertIn(str(self.prefix / "bin/vitrum"), outcome.read_text())

    def test_pictures_of_a_run_are_drawn_by_what_is_installed(self):
        run = self.folder / "run"
        self.command(self.prefix / "bin/vitrum", "run", source / "tests/cli/scenes/impact.toml", "--out", run)
        # What an administrator installed is not the user's to write.
        self.command("/usr/bin/python3", self.prefix / "share/vitrum/studies/plot_run.py", run,
                     env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
        self.assertTrue((run / "pictures/energy.png").exists())


if __name__ == "__main__":
    unittest.main()
