"""kill -9 at any moment: what was written can be read and is right, and --resume goes on to the same end."""
import random
import time
import unittest

from support import CommandLineTest, impact, output_count, overrides

# 5000 steps, so that there is time to kill in.
settings = overrides(integrator__step=4e-9, output__every=1e-6, output__checkpoint_every=1.3e-6)
kills = 10


class Kill(CommandLineTest):
    def setUp(self):
        super().setUp()
        begun = time.monotonic()
        self.whole = self.run_scene("whole", *settings)
        self.duration = time.monotonic() - begun
        self.moments = random.Random(2014)

    def kill_after(self, seconds, out, *arguments):
        """Starts a run and kills it; whether it was still under way."""
        process = self.start("run", impact, "--out", out, "--quiet", *settings, *arguments)
        time.sleep(seconds)
        alive = process.poll() is None
        process.kill()
        process.wait()
        return alive

    def assert_consistent(self, out):
        """All outputs in the file are those of the uninterrupted run."""
        outputs = output_count(out)
        self.assert_same_results(out, self.whole, steps=outputs)
        self.assertTrue((self.whole / "energy.csv").read_text().startswith((out / "energy.csv").read_text()))
        if not (out / "summary.json").exists():  # otherwise the kill met a process that had done all but end
            self.assertIn("killed, or under way", self.vitrum("info", out).stdout)
        return outputs

    def test_outputs_so_far_are_right(self):
        seen = set()
        for n in range(kills):
            out = self.folder / f"killed{n}"
            moment = self.duration * (n + self.moments.random()) / kills
            with self.subTest(moment=moment):
                if self.kill_after(moment, out) and (out / "energy.csv").exists():
                    seen.add(self.assert_consistent(out))
        self.assertGreater(len(seen), 1, "too few kills hit the run")

    def test_resumed_again_and_again(self):
        out = self.folder / "out"
        resume, interrupted = [], 0
        for _ in range(kills):
            if not self.kill_after(self.duration * self.moments.uniform(0.15, 0.4), out, *resume):
                break
            if (out / "checkpoint.h5").exists():
                resume = ["--resume"]
                interrupted += 1
        self.assertGreater(interrupted, 0, "too few kills hit the run")
        self.run_scene("out", *settings, *resume)
        self.assert_same_results(out, self.whole)


if __name__ == "__main__":
    unittest.main()
