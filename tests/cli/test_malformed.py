"""Every file of malformed/ is refused with the message that its first line expects, and nothing is written."""
import re
import unittest

from support import CommandLineTest, here, impact, plane_strain


def examples():
    for path in sorted((here / "malformed").glob("*.toml")):
        text = path.read_text(errors="replace")
        expected = re.match(r"# expect: (.*)", text)
        yield path, expected.group(1) if expected else None, "[path]" in text


class Malformed(CommandLineTest):
    def assert_refused(self, path, expected, command, *arguments):
        answer = self.vitrum(command, path, *arguments, status=2)
        self.assertRegex(answer.stderr, expected)
        self.assertEqual(answer.stdout, "")
        for line in answer.stderr.splitlines():
            self.assertRegex(line, r"^((error|warning): | +\d* \| )")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_all(self):
        self.assertGreater(len(list(examples())), 20)
        for path, expected, is_point in examples():
            with self.subTest(file=path.name):
                self.assertIsNotNone(expected, "the first line must be '# expect: REGEX'")
                if is_point:
                    self.assert_refused(path, expected, "point", "--out", self.folder / "point.csv")
                else:
                    self.assert_refused(path, expected, "check")
                    self.assert_refused(path, expected, "run", "--out", self.folder / "out")

    def test_field_that_no_material_has(self):
        # Known by name, so that only the scene's materials can tell.
        for command in ("check", "run"):
            self.assert_refused(plane_strain, r"--set 1: key 'output\.fields': found \"damage\"", command, "--set", 'output.fields=["damage"]')

    def test_every_message_has_a_place_and_a_key(self):
        answer = self.vitrum("check", here / "malformed" / "unknown_key.toml", status=2)
        self.assertRegex(answer.stderr, r"unknown_key\.toml:\d+:\d+: key 'integrator\.stp'")

    def test_overrides(self):
        for argument, expected in (
            ("foo", "KEY=VALUE"),
            ("space.cell=-1", r"space\.cell.*-1"),
            ("space.cel=1", r"did you mean 'cell'"),
            ("body.7.velocity.1=0", r"body\.7"),
            ("space.cell=one", r"space\.cell|one"),
            ("space.cell.x=1", r"space\.cell"),
        ):
            with self.subTest(argument=argument):
                self.assert_refused(impact, "--set 1: .*(" + expected + ")", "check", "--set", argument)


if __name__ == "__main__":
    unittest.main()
