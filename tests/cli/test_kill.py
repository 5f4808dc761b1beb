"""kill -9 at fifty random moments: what was written can be read and is right, and --resume, killed as well, goes on to the
same bits, whatever the method."""
import random
import time
import unittest

from support import CommandLineTest, impact, overrides, read_summary

# Each takes some tenths of a second, in so many steps that kills hit the run.
common = overrides(output__every=1e-6, output__checkpoint_every=1.3e-6)
methods = {
    "explicit": overrides(integrator__step=1e-8, time__end=15e-6),
    "arkode-explicit": overrides(integrator__method='"arkode-explicit"', integrator__rtol=1e-2, integrator__max_step=2e-8),
    "arkode-implicit": overrides(integrator__method='"arkode-implicit"', integrator__rtol=1e-2, integrator__order=2, time__end=8e-6),
    "cvode": overrides(constitutive__method='"cvode"', time__end=6e-6),
}
kills = {"explicit": 14, "arkode-explicit": 12, "arkode-implicit": 12, "cvode": 12}


class Kill(CommandLineTest):
    in_memory = True

    def kill_after(self, seconds, out, *arguments):
        """Starts a run and kills it; whether it was still under way."""
        process = self.start("run", impact, "--out", out, "--quiet", *arguments)
        time.sleep(seconds)
        alive = process.poll() is None
        process.kill()
        process.wait()
        return alive

    def assert_told_truly(self, out):
        """Only a run that had done all but end when it was killed has a summary."""
        if (out / "summary.json").exists():
            self.assertEqual(read_summary(out)["status"], "complete")
        elif (out / "result.h5").exists():
            self.assertIn("killed, or under way", self.vitrum("info", out).stdout)

    def test_killed_and_resumed(self):
        for method, settings in methods.items():
            settings = [*common, *settings]
            begun = time.monotonic()
            whole = self.run_scene(f"whole {method}", *settings)
            duration = time.monotonic() - begun
            moments, hits, seen = random.Random(method), 0, set()
            for n in range(kills[method]):
                out = self.folder / f"{method} {n}"
                moment, second = duration * moments.random(), duration * moments.random()
                with self.subTest(method, moment=moment / duration, second=second / duration):
                    hit = self.kill_after(moment, out, *settings)
                    hits += hit
                    duration = duration if hit else min(duration, moment)  # the machine has less to do than before
                    seen.add(self.assert_completed_outputs(out, whole))
                    self.assert_told_truly(out)
                    if (out / "checkpoint.h5").exists() and self.kill_after(second, out, *settings, "--resume"):
                        self.assertIsNotNone(self.assert_completed_outputs(out, whole))
                        self.assert_told_truly(out)
                    self.recover(out, *settings)
                    self.assert_same_results(out, whole)
            with self.subTest(method):
                self.assertGreater(hits, kills[method] // 2, "too few kills hit the run")
                self.assertGreater(len(seen), 1, "kills hit the same place only")


if __name__ == "__main__":
    unittest.main()
