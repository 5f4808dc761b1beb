"""The progress bar that a run shows on a terminal."""
import os
import unittest

from support import CommandLineTest, impact, overrides


class Progress(CommandLineTest):
    def run_on_terminal(self, *arguments):
        """What a run writes on standard error when that is a terminal."""
        try:
            ours, theirs = os.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminals here: {error}")
        shown = b""
        try:
            self.vitrum("run", impact, "--out", "out", *overrides(integrator__step=2e-9), *arguments, stderr=theirs)
        finally:
            os.close(theirs)
            while True:
                try:
                    piece = os.read(ours, 65536)
                except OSError:  # the terminal's other end is closed and all is read
                    break
                if not piece:
                    break
                shown += piece
            os.close(ours)
        return shown.decode()

    def test_bar(self):
        shown = self.run_on_terminal()
        self.assertRegex(shown, r"\r\[#* *\] +\d+ %  t = \S+ us  dt = 0\.0020 us  \d+ steps, 0 rejected  limit: .*\d+ s left")
        self.assertIn("\r\033[K", shown, "the bar is cleared at the end")
        self.assertNotIn("\nt = ", shown)

    def test_quiet(self):
        self.assertNotIn("steps", self.run_on_terminal("--quiet"))


if __name__ == "__main__":
    unittest.main()
