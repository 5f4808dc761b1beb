"""How errors and warnings look: the line that they speak of, on a terminal wrapped and coloured."""
import re
import signal
import unittest

from support import CommandLineTest, glass_point, impact
from terminal import Terminal

text = impact.read_text()
wrong = text.replace("young = 72.0e9", "young = -72.0e9")


class Excerpt(CommandLineTest):
    def scene(self, content, name="wrong.toml", encoding="utf-8"):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode(encoding))
        return path

    def refused(self, *arguments, **options):
        return self.vitrum(*arguments, status=2, **options).stderr.splitlines()

    def assert_marked(self, lines, message, source, marked):
        """A message, the line of the file, and a caret under `marked` in it."""
        self.assertRegex(lines[0], message)
        number = int(re.match(r"error: [^:]*:(\d+):", lines[0]).group(1))
        self.assertEqual(lines[1], f"{number:5} | {source}")
        self.assertEqual(lines[2].index("^"), lines[1].index(marked))

    def test_value(self):
        lines = self.refused("check", self.scene(wrong))
        self.assert_marked(lines, r"^error: \S*wrong\.toml:\d+:\d+: key 'material\.glass\.young': found -7\.2e\+10",
                           "young = -72.0e9", "-72")

    def test_run_and_point(self):
        self.assert_marked(self.refused("run", self.scene(wrong)), "young", "young = -72.0e9", "-72")
        point = self.scene(re.sub(r"young *= *\S+", "young = 0", glass_point.read_text()), "point.toml")
        self.assert_marked(self.refused("point", point), "young", "young = 0", "0")

    def test_a_line_for_each_fault(self):
        lines = self.refused("check", self.scene(wrong.replace("cell = ", "cel = ")))
        self.assertEqual(sum(line.startswith("error: ") for line in lines), 3)  # unknown, missing, negative
        self.assertEqual(sum("^" in line for line in lines), 3)

    def test_characters_of_several_bytes(self):
        lines = self.refused("check", self.scene(text.replace('name = "plate"', 'name = "gläß", material = "ø"')
                                                 .replace('[[body]]\nname', '[[body]]\nnäme = 1 # →\nname')))
        self.assertIn("^", lines[2])

    def test_no_toml(self):
        lines = self.refused("check", self.scene(text.replace('material = "glass"', 'material = "gla')))
        self.assertRegex(lines[0], r"^error: \S*wrong\.toml:\d+:\d+: ")
        self.assertIn('material = "gla', lines[1])

    def test_bytes_that_are_no_text(self):
        lines = self.refused("check", self.scene(text.encode().replace(b'title = "', b'title = "\xff\xfe\x1b[31m')))
        self.assertRegex(lines[0], r"^error: ")
        self.assertNotIn("\x1b", "".join(lines))

    def test_long_line(self):
        """The part of it around the column."""
        polygon = ", ".join(f"[{n}.0, 0.0]" for n in range(2000)) + ", [true, 1.0]"
        lines = self.refused("check", self.scene(text.replace("box = {min = [0.0, 0.0], max = [0.02, 0.005]}", f"polygon = [{polygon}]")))
        self.assertLessEqual(len(lines[1]), 120)
        self.assertEqual(lines[1][lines[2].index("^"):][:4], "true")

    def test_argument(self):
        lines = self.refused("check", impact, "--set", "time.end=1e-3", "--set", "material.glass.young=-1")
        self.assertRegex(lines[0], r"^error: --set 2: key 'material\.glass\.young'")
        self.assertEqual(lines[1].strip(), "| --set material.glass.young=-1")

    def test_standard_input(self):
        answer = self.vitrum("check", "-", input=text)
        self.assertIn("# <stdin> is valid", answer.stdout)
        scene = lambda shown: shown.split("\n\n", 1)[1]
        self.assertEqual(scene(answer.stdout), scene(self.vitrum("check", impact).stdout))
        lines = self.refused("check", "-", input=wrong)
        self.assert_marked(lines, r"^error: <stdin>:\d+:\d+: key 'material\.glass\.young'", "young = -72.0e9", "-72")
        point = glass_point.read_text()
        self.assertEqual(self.vitrum("point", "-", input=point).stdout, self.vitrum("point", glass_point).stdout)
        self.assertRegex(self.refused("check", "-")[0], r"^error: <stdin>:\d+:\d+: key 'space': found nothing")

    def test_what_a_formula_lacks(self):
        """Parameters that stand below, or are wrong themselves, are not unknown; and what looks like a formula is told how one begins."""
        parameters = self.scene("[parameters]\na = '=b'\nb = inf\n" + text)
        lines = self.refused("check", parameters, "--set", "time.end='=a'", "--set", "time.start='2*us'")
        self.assertRegex("\n".join(lines), r"key 'parameters\.a': found \"=b\", expected a formula: parameter 'b' has no value here")
        self.assertRegex("\n".join(lines), r"key 'time\.end': found \"=a\", expected a formula: parameter 'a' has no value here")
        self.assertRegex("\n".join(lines), r"key 'time\.start': found \"2\*us\", expected a finite number \(s\); a formula begins with '='")

    def test_a_run_wants_a_file(self):
        """It reads its scene again when it is resumed."""
        answer = self.vitrum("run", "-", input=text, status=2)
        self.assertRegex(answer.stderr, r"^error: SCENE: found -, expected a file: .* `vitrum check -`")
        self.assertEqual(list(self.folder.iterdir()), [])


class OnATerminal(CommandLineTest):
    def shown(self, columns, **environment):
        (self.folder / "wrong.toml").write_text(wrong)
        terminal = Terminal(self, "check", "wrong.toml", columns=columns, environment=environment)
        self.assertEqual(terminal.read_to_end(), 2)
        return terminal.shown.replace("\r\n", "\n")

    def test_wrapped(self):
        for columns in (30, 47, 80):
            with self.subTest(columns=columns):
                shown = re.sub(r"\033\[[0-9;]*m", "", self.shown(columns))
                message, excerpt = shown.split("\n   ", 1)
                self.assertIn("\n", message) if columns < 80 else None
                for line in shown.splitlines():
                    self.assertTrue(len(line) <= columns or " " not in line.strip(), line)
                self.assertIn("key 'material.glass.young': found -7.2e+10", " ".join(message.split()))
                self.assertTrue(message.startswith("error: wrong.toml:"), message)
                self.assertIn("young = -72.0e9", excerpt)

    def test_coloured(self):
        self.assertRegex(self.shown(100), r"^\033\[1;31merror:\033\[0m wrong\.toml:\d+:\d+: ")
        self.assertNotIn("\033", self.shown(100, NO_COLOR="1"))
        self.assertIn("\033", self.shown(100, NO_COLOR=""))
        self.assertNotIn("\033", self.shown(100, TERM="dumb"))

    def test_commands_stay_in_one_piece(self):
        terminal = Terminal(self, "run", impact, "--out", "a folder", "--set", "integrator.step=2e-10", columns=60)
        terminal.read_until(r"\d %")
        terminal.process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.read_to_end(), 130)
        self.assertRegex(terminal.shown, r"`\S+ run \S+ --set integrator\.step=2e-10 --out 'a folder' --resume`")


if __name__ == "__main__":
    unittest.main()
