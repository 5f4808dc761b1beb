"""Signals beside the one SIGINT or SIGTERM of test_resume: repeated ones, SIGHUP, and signals at the start of a run."""
import pathlib
import re
import signal
import time
import unittest

from support import CommandLineTest, impact, overrides, preload, preloaded, read_summary

long = overrides(integrator__step=4e-9, output__every=2e-6)


class Signals(CommandLineTest):
    in_memory = True

    def setUp(self):
        super().setUp()
        self.whole = self.run_scene("whole", *long)

    def interrupt(self, out, *numbers, **options):
        """Sends signals after the third output, without a pause; the run that ends by them."""
        process = self.start("run", impact, "--out", out, *long, **options)
        self.wait_for_outputs(process, 3)
        for number in numbers:
            process.send_signal(number)
        process.stderr.read()
        return process

    def assert_resumable(self, out):
        self.assertEqual(read_summary(out)["status"], "interrupted")
        self.run_scene(out.name, *long, "--resume")
        self.assert_same_results(out, self.whole)

    def test_terminal_that_hangs_up(self):
        out = self.folder / "out"
        self.assertEqual(self.interrupt(out, signal.SIGHUP).wait(), 129)
        self.assert_resumable(out)

    def test_nohup(self):
        out = self.folder / "out"
        ignore = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        self.assertEqual(self.interrupt(out, signal.SIGHUP, preexec_fn=ignore).wait(), 0)
        self.assert_same_results(out, self.whole)

    @unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
    def test_nohup_beside_a_library_that_takes_the_signal(self):
        out = self.folder / "out"
        ignore = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        self.assertEqual(self.interrupt(out, signal.SIGHUP, preexec_fn=ignore, env=preloaded(TAKES_SIGNAL=1)).wait(), 0)
        self.assert_same_results(out, self.whole)

    def test_signals_are_the_programs_own(self):
        """Libraries that are loaded before main could take others, or take away what the shell said of SIGHUP."""
        process = self.start("run", impact, "--out", self.folder / "out", *long)
        self.wait_for_outputs(process, 1)
        libraries, status = (pathlib.Path(f"/proc/{process.pid}/{name}").read_text() for name in ("maps", "status"))
        process.kill()
        process.stderr.read()
        if re.search(r"/lib[at]san\.so", libraries):
            self.skipTest("a sanitizer handles signals, too")
        caught = int(re.search(r"^SigCgt:\s*(\w+)$", status, re.MULTILINE)[1], 16)
        numbers = {number for number in range(1, 32) if caught >> (number - 1) & 1}
        self.assertEqual(numbers, {signal.SIGHUP, signal.SIGINT, signal.SIGTERM})

    def test_in_the_background_of_a_script(self):
        """A shell ignores SIGINT for what it starts by `&`; the promise of a checkpoint holds there, too."""
        out = self.folder / "out"
        ignore = lambda: signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.assertEqual(self.interrupt(out, signal.SIGINT, preexec_fn=ignore).wait(), 130)
        self.assert_resumable(out)

    def test_the_same_signal_sent_twice(self):
        """`timeout` sends to the process and to its group, `kill` may be called again: one wish."""
        for number in (signal.SIGINT, signal.SIGTERM):
            out = self.folder / f"out {number}"
            self.assertEqual(self.interrupt(out, number, number).wait(), 128 + number)
            self.assert_resumable(out)

    @unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
    def test_a_second_interrupt_ends_at_once(self):
        """The run hangs in a call to the file system: nothing but that helps."""
        out = self.folder / "out"
        third = preloaded(FAULT="STALL", FAULT_NAME="renameat2", FAULT_CALL=11)  # the third output's publication
        process = self.start("run", impact, "--out", out, *long, env=third)
        self.wait_for_line(process, "stalled\n")
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.7)
        self.assertIsNone(process.poll(), "one signal waits for the end of the step")
        process.send_signal(signal.SIGTERM)
        time.sleep(0.1)
        self.assertIsNone(process.poll(), "only SIGINT insists")
        process.send_signal(signal.SIGINT)
        self.assertIn("interrupted again: ended at once, without a checkpoint", process.stderr.read())
        self.assertEqual(process.wait(), 130)
        self.assertEqual(self.assert_completed_outputs(out, self.whole), 2)
        self.recover(out, *long)
        self.assert_same_results(out, self.whole)

    def test_at_the_start(self):
        """Before the run catches signals it ends at once, afterwards with a checkpoint; either leaves order."""
        statuses = set()
        for n in range(40):
            if n >= 24 and 130 in statuses:  # later moments are for programs that a sanitizer slows down
                break
            out = self.folder / f"out{n}"
            process = self.start("run", impact, "--out", out, "--quiet", *long)
            time.sleep(0.002 * n if n < 24 else 0.05 * (n - 22))
            process.send_signal(signal.SIGINT)
            statuses.add(process.wait())
            self.assert_completed_outputs(out, self.whole)
            if process.returncode == 130:
                self.assertTrue((out / "checkpoint.h5").exists())
        self.assertLessEqual(statuses, {-signal.SIGINT, 130})
        self.assertIn(130, statuses)
        self.recover(out, *long)
        self.assert_same_results(out, self.whole)


if __name__ == "__main__":
    unittest.main()
