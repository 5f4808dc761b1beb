"""Every call that writes to the file system fails, or is the last one before kill -9: at the start, at outputs, at
checkpoints, at the end, and while a run is resumed.

A run makes some hundreds of such calls. All kinds are tried, and of the frequent ones every VITRUM_FAULT_STRIDE-th (1: all).
"""
import errno
import os
import shutil
import signal
import unittest

from support import CommandLineTest, impact, overrides, preload, preloaded, read_summary, told

settings = [*overrides(time__end=4e-6, integrator__step=1e-7, output__every=1e-6, output__checkpoint_every=2e-6,
                       output__fields='["velocity"]'), "--threads", "1"]
stride = int(os.environ.get("VITRUM_FAULT_STRIDE", "23"))


@unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
class WritingCalls(CommandLineTest):
    in_memory = True

    def setUp(self):
        super().setUp()
        self.whole = self.run_scene("whole", *settings)

    def run_with(self, begun, **environment):
        """Runs into a fresh folder, or resumes in a copy of the folder `begun`; the folder, and what the program said."""
        out = self.folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        if begun is not None:
            shutil.copytree(begun, out)
        resume = [] if begun is None else ["--resume"]
        return out, self.vitrum("run", impact, "--out", out, "--quiet", *settings, *resume, env=preloaded(**environment), status=None)

    def names_of_calls(self, begun=None):
        log = self.folder / "calls"
        self.assertEqual(self.run_with(begun, FAULT_LOG=log)[1].returncode, 0)
        return log.read_text().split()

    def chosen_calls(self, begun=None):
        """Numbers of the calls to try, from 1."""
        names = self.names_of_calls(begun)
        frequent = {name for name in names if names.count(name) > 20}
        return [n for n, name in enumerate(names, 1) if name not in frequent or (n - 1) % stride == 0 or n == len(names)]

    def fail_calls(self, reason, **fault):
        """Lets the chosen calls fail; folder and message of each run that could not do without."""
        for number in self.chosen_calls():
            with self.subTest(call=number):
                out, answer = self.run_with(None, FAULT=reason, FAULT_CALL=number, **fault)
                self.assertIn(answer.returncode, (0, 4), answer.stderr)
                errors = [line for line in told(answer.stderr) if not line.startswith("warning: ")]
                if answer.returncode == 0:
                    self.assertEqual(errors, [])  # what failed was a help to others: who holds the lock
                else:
                    self.assertTrue(all(line.startswith("error: ") for line in errors), errors)
                    self.assertIn(os.strerror(reason), errors[-1])
                    self.assertIn(str(out), errors[-1])
                    if self.assert_completed_outputs(out, self.whole) is not None and (out / "energy.csv").exists():
                        self.assertTrue((out / "energy.csv").read_text().endswith("\n"), "half a row")
                    yield out, errors[-1]
                    self.recover(out, *settings)
                self.assert_same_results(out, self.whole)

    def test_each_fails_once(self):
        """Then the run ends with a checkpoint, once there is something to keep."""
        under_way = 0
        for out, message in self.fail_calls(errno.EIO):
            if message.startswith("error: t = "):
                under_way += 1
                self.assertIn("checkpoint written: when the cause is mended, continue with `", message)
                self.assertEqual(read_summary(out)["status"], "failed")
        self.assertGreater(under_way, 10)

    def test_the_disk_is_full_from_then_on(self):
        messages = [message for _, message in self.fail_calls(errno.ENOSPC, FAULT_LASTS=1)]
        self.assertGreater(sum("nor could a checkpoint be written" in message for message in messages), 10)

    def kill_at_calls(self, begun=None):
        for number in self.chosen_calls(begun):
            with self.subTest(call=number):
                out, answer = self.run_with(begun, FAULT="KILL", FAULT_CALL=number)
                self.assertEqual(answer.returncode, -signal.SIGKILL)
                self.assert_completed_outputs(out, self.whole)
                self.recover(out, *settings)
                self.assert_same_results(out, self.whole)
                self.assertEqual([path.name for path in out.iterdir() if path.name.startswith(".")], [])

    def test_each_is_the_last(self):
        self.kill_at_calls()

    def test_each_is_the_last_of_a_resumed_run(self):
        # What is resumed was killed when it had one more output than its checkpoint knows.
        names = self.names_of_calls()
        last_output = len(names) - names[::-1].index("renameat2")  # result.xdmf, behind the output and result.h5
        killed, _ = self.run_with(None, FAULT="KILL", FAULT_CALL=last_output)
        self.assertTrue((killed / "checkpoint.h5").exists())
        self.kill_at_calls(killed.rename(self.folder / "begun"))


if __name__ == "__main__":
    unittest.main()
