"""Arguments: what the program says of itself, and what it refuses."""
import os
import re
import shutil
import subprocess
import unittest

from support import CommandLineTest, glass_point, impact, program


class Arguments(CommandLineTest):
    def test_version_names_every_library(self):
        lines = self.vitrum("--version").stdout.splitlines()
        self.assertRegex(lines[0], r"^vitrum \d+\.\d+\.\d+ \(\S+\)$")
        for library in ("SUNDIALS", "SuiteSparse", "Eigen", "HDF5"):
            self.assertTrue(any(line.startswith(library) and line.split()[1][0].isdigit() for line in lines), library)

    def test_help(self):
        self.assertIn("Subcommands", self.vitrum("--help").stdout)
        for command in ("run", "check", "point", "info", "compare"):
            self.assertIn("Usage", self.vitrum(command, "--help").stdout)

    def test_no_arguments_print_the_help(self):
        self.assertIn("Usage", self.vitrum(status=2).stdout)

    def test_wrong_usage(self):
        for arguments, named in (
            (["bogus"], "bogus"),
            (["--bogus"], "--bogus"),
            (["run"], "SCENE"),
            (["run", impact, "--bogus"], "--bogus"),
            (["run", impact, "another.toml"], "another.toml"),
            (["run", impact, "--threads", "-1"], "--threads"),
            (["run", impact, "--threads", "many"], "--threads"),
            (["run", impact, "--set"], "--set"),
            (["check", impact, "--threads", "1"], "--threads"),
            (["info"], "RESULT"),
        ):
            with self.subTest(arguments=arguments):
                answer = self.vitrum(*arguments, status=2)
                self.assertIn(named, answer.stderr)
                self.assertEqual(answer.stdout, "")

    def test_what_was_meant(self):
        for arguments, meant, help in ((["chek", impact], "check", "vitrum --help"),
                                       (["--versio"], "--version", "vitrum --help"),
                                       (["run", impact, "--resum"], "--resume", "vitrum run --help"),
                                       (["run", "--thread", 2, impact], "--threads", "vitrum run --help"),
                                       (["run", impact, "--ouT=x"], "--out", "vitrum run --help"),
                                       (["check", impact, "--jsn"], "--json", "vitrum check --help"),
                                       (["compare", "a", "b", "--Json"], "--json", "vitrum compare --help")):
            with self.subTest(arguments=arguments):
                answer = self.vitrum(*arguments, status=2)
                self.assertIn(f"did you mean '{meant}'? (see {help})", answer.stderr)
        self.assertNotIn("did you mean", self.vitrum("frobnicate", status=2).stderr)
        self.assertIn("expected one of run, check", self.vitrum("frobnicate", status=2).stderr)

    def test_examples_of_the_help_work(self):
        """As a user would type them, in a folder with the scene that they speak of."""
        shutil.copy(impact, self.folder / "plate.toml")
        shutil.copy(glass_point, self.folder / "glass.toml")
        (self.folder / "bin").mkdir()
        os.symlink(program, self.folder / "bin" / "vitrum")
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        for command in ("run", "check", "point", "info", "compare", "reference"):
            examples = re.search(r"^Examples:\n((?:  .*\n?)+)", self.vitrum(command, "--help").stdout, re.MULTILINE).group(1)
            self.assertGreaterEqual(len(examples.splitlines()), 2, command)
            for line in examples.splitlines():
                with self.subTest(line=line):
                    self.assertIn(f"vitrum {command} ", line)
                    done = subprocess.run(["sh", "-c", line], cwd=self.folder, env=environment, capture_output=True, text=True,
                                          stdin=subprocess.DEVNULL, timeout=120)
                    self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Examples:", self.vitrum("--help").stdout)

    def test_missing_scene(self):
        for command in ("run", "check", "point"):
            answer = self.vitrum(command, "missing.toml", status=2)
            self.assertRegex(answer.stderr, r"error: missing\.toml: found no such file")
            self.assertRegex(self.vitrum(command, ".", status=2).stderr, "directory")

    def test_full_disk_behind_standard_output(self):
        for arguments in (["check", impact], ["--version"], ["point", glass_point]):
            with self.subTest(arguments=arguments), open("/dev/full", "w") as full:
                answer = self.vitrum(*arguments, status=4, stdout=full)
                self.assertIn("No space left on device", answer.stderr)


if __name__ == "__main__":
    unittest.main()
