"""SIGINT and SIGTERM, --resume, and checkpoints that must not be resumed from."""
import hashlib
import signal
import unittest

from support import CommandLineTest, impact, overrides, plane_strain, read_summary

# 5000 steps, so that there is time to interrupt.
long = overrides(integrator__step=4e-9, output__every=2e-6)
adaptive = overrides(integrator__courant=0.03, output__every=2e-6)
checkpoints = overrides(output__checkpoint_every=4e-6)


def digests(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir()}


class Signals(CommandLineTest):
    def interrupt(self, number, out, *arguments):
        """Sends a signal after the third output; standard error of the run."""
        process = self.start("run", impact, "--out", out, *arguments)
        lines = []
        while sum(line.startswith("t = ") for line in lines) < 3:
            lines.append(process.stderr.readline())
            self.assertTrue(lines[-1], "".join(lines))
        process.send_signal(number)
        lines += process.stderr.readlines()
        self.assertEqual(process.wait(), 128 + number)
        return "".join(lines)

    def test_interrupted_and_resumed(self):
        for name, number, settings in (("INT", signal.SIGINT, long), ("TERM", signal.SIGTERM, long),
                                       ("adaptive", signal.SIGINT, adaptive)):
            with self.subTest(name):
                whole = self.run_scene(f"whole {name}", *settings)
                out = self.folder / f"out {name}"
                message = self.interrupt(number, out, *settings)
                self.assertRegex(message, r"interrupted: signal \d+: checkpoint written at t = \S+ s; continue with the same command and --resume")
                summary = read_summary(out)
                self.assertEqual(summary["status"], "interrupted")
                self.assertLess(summary["time"], 20e-6)
                self.assertIn("interrupted", self.vitrum("info", out).stdout)
                self.run_scene(out.name, *settings, "--resume", "--threads", 2)
                self.assert_same_results(out, whole)

    def test_interrupted_twice(self):
        whole = self.run_scene("whole", *long)
        out = self.folder / "out"
        self.interrupt(signal.SIGINT, out, *long)
        self.interrupt(signal.SIGINT, out, *long, "--resume")
        self.run_scene("out", *long, "--resume")
        self.assert_same_results(out, whole)


class Resume(CommandLineTest):
    def test_a_finished_run(self):
        # With a checkpoint before the end, and with one at the end.
        for every in (4e-6, 2e-6):
            with self.subTest(every=every):
                settings = overrides(output__checkpoint_every=every)
                whole, out = self.run_scene(f"whole{every}", *settings), self.run_scene(f"out{every}", *settings)
                self.run_scene(out.name, *settings, "--resume")
                self.assert_same_results(out, whole)

    def test_without_fields(self):
        whole, out = (self.run_scene(name, "--no-fields", *checkpoints) for name in ("whole", "out"))
        self.run_scene("out", "--no-fields", *checkpoints, "--resume")
        self.assertEqual((out / "energy.csv").read_text(), (whole / "energy.csv").read_text())
        self.assertEqual(digests(out).keys(), digests(whole).keys())

    def assert_refused(self, out, status, expected, *arguments, scene=impact):
        before = digests(out)
        answer = self.vitrum("run", scene, "--out", out, "--resume", "--quiet", *arguments, status=status)
        self.assertRegex(answer.stderr, expected)
        self.assertEqual(digests(out), before)

    def test_another_scene(self):
        out = self.run_scene("out", *checkpoints)
        self.assert_refused(out, 2, "checkpoint of another scene", *checkpoints, *overrides(body__1__velocity__1=-150.0))
        self.assert_refused(out, 2, "checkpoint of another scene", *checkpoints, scene=plane_strain)

    def test_fields_come_and_go(self):
        out = self.run_scene("with", *checkpoints)
        self.vitrum("run", impact, "--out", out, "--resume", "--no-fields", *checkpoints, status=2)
        out = self.run_scene("without", "--no-fields", *checkpoints)
        answer = self.vitrum("run", impact, "--out", out, "--resume", *checkpoints, status=2)
        self.assertIn("--no-fields", answer.stderr)

    def test_no_checkpoint(self):
        self.assert_refused(self.run_scene("out"), 4, r"error: \S*checkpoint\.h5: cannot read: No such file")
        answer = self.vitrum("run", impact, "--out", "never", "--resume", status=4)
        self.assertIn("checkpoint.h5", answer.stderr)

    def test_damaged_checkpoint(self):
        out = self.run_scene("out", *checkpoints)
        path = out / "checkpoint.h5"
        content = path.read_bytes()
        for name, damaged in (("cut", content[:-100]), ("flipped", content[:9000] + bytes([content[9000] ^ 1]) + content[9001:]),
                              ("empty", b"")):
            with self.subTest(name):
                path.write_bytes(damaged)
                self.assert_refused(out, 4, r"error: \S*checkpoint\.h5: is ", *checkpoints)


if __name__ == "__main__":
    unittest.main()
