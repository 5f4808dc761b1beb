"""The line that a run draws on a terminal while it gets on."""
import re
import signal
import unittest

from support import CommandLineTest, impact, overrides
from terminal import Terminal, drawn_lines, drawn_part

long = overrides(integrator__step=2e-10)  # 100,000 steps: killed when enough is seen


class Progress(CommandLineTest):
    in_memory = True

    def seen(self, columns, *arguments, lines=3):
        """A run on a terminal of this width until so many lines are drawn."""
        terminal = Terminal(self, "run", impact, "--out", f"out{columns}", *arguments, columns=columns)
        terminal.read_until(r"(\r[^\r\n]+\r[^\n]*){%d}" % lines)
        terminal.process.kill()
        terminal.read_to_end()
        return drawn_part(terminal.shown)

    def test_never_wider_than_the_terminal(self):
        for columns in (20, 33, 40, 60, 80, 100, 132, 200):
            with self.subTest(columns=columns):
                shown = self.seen(columns, *long, lines=2)
                self.assertNotIn("\n", shown, "the line is drawn anew, not followed by another")
                lines = drawn_lines(shown)
                self.assertGreaterEqual(len(lines), 2)
                for line in lines:
                    self.assertLess(len(line), columns, line)  # the last column may begin another line
                self.assertRegex(lines[-1], r"\d %")

    def test_what_a_line_of_eighty_columns_tells(self):
        line = drawn_lines(self.seen(80, *long))[-1]
        self.assertRegex(line, r"^ *\d+ % +[0-9.]+ (s|min|h) left  residual [+-]\d+\.\d\d %  kinetic \S+ +J  elastic \S+ +J$")

    def test_wide_line(self):
        line = drawn_lines(self.seen(200, *long))[-1]
        self.assertRegex(line, r"t = \S+ +us  steps \d+  dt = 0\.0002 +us  limit: fixed step +rejected 0$")

    def test_unknown_width(self):
        for line in drawn_lines(self.seen(0, *long)):
            self.assertLess(len(line), 80)

    def test_window_that_changes(self):
        terminal = Terminal(self, "run", impact, "--out", "out", *long, columns=120)
        terminal.read_until(r"\d %")
        for columns in (30, 150, 50):
            before = terminal.resize_while_stopped(columns)
            terminal.read_until(r"(\r[^\r]+\r.*){2}")
            lines = drawn_lines(terminal.shown[before:])
            self.assertGreaterEqual(len(lines), 2)
            for line in lines:
                self.assertLess(len(line), columns)
            if columns == 150:
                self.assertGreater(len(lines[-1]), 120, "what fits is told")
        self.assertNotIn("\n", drawn_part(terminal.shown))

    def test_drawn_by_time_also_where_steps_are_slow(self):
        """60 steps of 125,000 particles; gravity keeps them from coasting."""
        slow = overrides(space__cell=4e-5, integrator__step=1e-10, time__end=6e-9, gravity__acceleration="[0, -9.81]")
        terminal = Terminal(self, "run", impact, "--out", "out", *slow, "--threads", 1, columns=80)
        terminal.read_to_end()
        self.assertGreaterEqual(len(re.findall(r"\d %  ", drawn_part(terminal.shown))), 2)

    def test_cleared_at_the_end(self):
        terminal = Terminal(self, "run", impact, "--out", "out", *long, columns=80)
        terminal.read_until(r"\d %")
        terminal.process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.read_to_end(), 130)
        self.assertRegex(terminal.shown, r"\r\033\[J\S*interrupted:")
        self.assertNotIn("\nt = ", terminal.shown)

    def test_quiet(self):
        terminal = Terminal(self, "run", impact, "--out", "out", "--quiet", columns=80)
        self.assertEqual(terminal.read_to_end(), 0)
        self.assertNotIn("%", terminal.shown)

    def test_terminal_that_cannot_draw(self):
        terminal = Terminal(self, "run", impact, "--out", "out", columns=80, environment={"TERM": "dumb"})
        terminal.read_to_end()
        self.assertNotIn("\033", terminal.shown)
        self.assertIn("\nt = ", terminal.shown)


if __name__ == "__main__":
    unittest.main()
