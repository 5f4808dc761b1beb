"""The progress bar that a run shows on a terminal."""
import unittest

from support import CommandLineTest, impact, overrides

fine = overrides(integrator__step=2e-9)


class Progress(CommandLineTest):
    def test_bar(self):
        shown = self.run_on_terminal("run", impact, "--out", "out", *fine)
        self.assertRegex(shown, r"\r\[#* *\] +\d+ %  t = \S+ us  dt = 0\.0020 us  \d+ steps, 0 rejected  limit: .*\d+ s left")
        self.assertIn("\r\033[K", shown, "the bar is cleared at the end")
        self.assertNotIn("\nt = ", shown)

    def test_quiet(self):
        self.assertNotIn("steps", self.run_on_terminal("run", impact, "--out", "out", *fine, "--quiet"))


if __name__ == "__main__":
    unittest.main()
