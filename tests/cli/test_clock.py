"""Wall clocks that show another century, or jump: only the date in the provenance follows them."""
import re
import time
import unittest

from support import CommandLineTest, impact, overrides, preload, preloaded, read_summary

settings = overrides(integrator__step=4e-9, output__every=2e-6, output__checkpoint_every=4e-6)
clocks = {  # seconds since 1970, and jumps at every look
    "1970": (0, 0),
    "1969": (-86400, 0),
    "2100": (4102444800, 0),
    "9999": (253402300799, 0),
    "jumps by an hour": (1700000000, 3600),
    "jumps by thirty years": (1700000000, 946080000),
}


@unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
class Clock(CommandLineTest):
    in_memory = True

    def test_clocks(self):
        whole = self.run_scene("whole", *settings)
        for name, (base, jump) in clocks.items():
            with self.subTest(name):
                out = self.folder / name
                begun = time.monotonic()
                answer = self.vitrum("run", impact, "--out", out, *settings, env=preloaded(CLOCK_BASE=base, CLOCK_JUMP=jump))
                took = time.monotonic() - begun
                self.assert_same_results(out, whole)
                self.assertEqual(sum(line.startswith("t = ") for line in answer.stderr.splitlines()), 11)
                summary = read_summary(out)
                self.assertGreater(summary["wall_seconds"], 0.0)
                self.assertLess(summary["wall_seconds"], took)
                started = summary["provenance"]["started"]
                self.assertRegex(started, r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
                if jump == 0:
                    self.assertTrue(started.startswith(name), started)
                self.assertIn(started, self.vitrum("info", out).stdout)

    def test_progress_bar(self):
        """The time left comes from a clock that nobody sets."""
        answer = self.run_on_terminal("run", impact, "--out", "out", *overrides(integrator__step=2e-9),
                                      env=preloaded(CLOCK_BASE=1700000000, CLOCK_JUMP=946080000))
        left = [int(seconds) for seconds in re.findall(r"(-?\d+) s left", answer)]
        self.assertTrue(left)
        self.assertTrue(all(0 <= seconds < 120 for seconds in left), left)

    def test_resumed_in_another_century(self):
        whole = self.run_scene("whole", *settings)
        out = self.folder / "out"
        process = self.start("run", impact, "--out", out, *settings, env=preloaded(CLOCK_BASE=4102444800))
        self.wait_for_outputs(process, 5)
        process.kill()
        process.wait()
        self.vitrum("run", impact, "--out", out, "--resume", *settings, env=preloaded(CLOCK_BASE=0))
        self.assert_same_results(out, whole)
        self.assertGreater(read_summary(out)["wall_seconds"], 0.0)


if __name__ == "__main__":
    unittest.main()
