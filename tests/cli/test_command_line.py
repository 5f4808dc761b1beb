"""Arguments: what the program says of itself, and what it refuses."""
import unittest

from support import CommandLineTest, glass_point, impact


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
