"""Standard streams that are closed, full, or read by nobody: a run goes on, and its files hold nothing but results."""
import os
import signal
import subprocess
import unittest

from support import CommandLineTest, glass_point, impact, overrides, program, read_summary

settings = overrides(output__every=2e-7)  # a hundred lines of progress


class Streams(CommandLineTest):
    in_memory = True

    def setUp(self):
        super().setUp()
        self.whole = self.run_scene("whole", *settings)
        self.out = self.folder / "out"
        self.command = [program, "run", impact, "--out", self.out, *settings]

    def assert_complete(self, status, expected=0):
        self.assertEqual(status, expected)
        self.assert_same_results(self.out, self.whole)

    def test_closed(self):
        for closed in ((0,), (1,), (2,), (0, 1, 2)):
            with self.subTest(closed=closed):
                close = lambda: [os.close(stream) for stream in closed]
                done = subprocess.run([*self.command, "--force"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=close)
                self.assert_complete(done.returncode)

    def test_closed_and_the_input_is_wrong(self):
        done = subprocess.run([program, "check", self.folder / "missing.toml"], preexec_fn=lambda: os.close(2))
        self.assertEqual(done.returncode, 2)

    def test_nobody_reads_messages(self):
        reader, writer = os.pipe()
        os.close(reader)
        with os.fdopen(writer, "w") as pipe:
            self.assert_complete(subprocess.run(self.command, stdout=pipe, stderr=pipe).returncode)

    def test_the_reader_leaves_after_a_line(self):
        process = subprocess.Popen(self.command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        process.stdout.readline()
        process.stdout.close()
        self.assert_complete(process.wait())

    def test_full_disk_behind_messages(self):
        with open("/dev/full", "w") as full:
            self.assert_complete(subprocess.run(self.command, stdout=subprocess.DEVNULL, stderr=full).returncode)

    def test_full_disk_behind_the_summary(self):
        """The text is lost, the results are not; the status tells."""
        with open("/dev/full", "w") as full:
            done = subprocess.run(self.command, stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertIn("error: standard output: cannot be written: No space left on device", done.stderr)
        self.assert_complete(done.returncode, expected=4)
        self.assertEqual(read_summary(self.out)["status"], "complete")

    def test_a_terminal_that_goes(self):
        try:
            ours, theirs = os.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminals here: {error}")
        process = subprocess.Popen([*self.command, *overrides(integrator__step=4e-9)], stdout=theirs, stderr=theirs)
        os.close(theirs)
        os.read(ours, 1)
        os.close(ours)  # from now on every write ends with an error
        self.assertEqual(process.wait(), 4, "standard output was lost, and it is not a pipe whose reader had enough")
        self.assertEqual(read_summary(self.out)["status"], "complete")

    def test_commands_that_only_print(self):
        """They end by SIGPIPE, silently, as such commands do."""
        read, write = os.pipe()
        os.close(read)
        with os.fdopen(write, "w") as pipe:
            done = subprocess.run([program, "info", self.out.with_name("whole")], stdout=pipe, stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))

    def test_long_answers_on_a_full_disk(self):
        """Longer than any buffer: the failure is met while printing."""
        with open("/dev/full", "w") as full:
            answer = self.vitrum("info", self.folder / "whole", "--json", status=4, stdout=full)
            point = self.vitrum("point", glass_point, status=4, stdout=full)
        self.assertEqual(answer.stderr, "error: standard output: cannot be written: No space left on device\n")
        self.assertIn("error: standard output: cannot be written: No space left on device\n", point.stderr)

    def test_scene_on_standard_input(self):
        for pipe in (True, False):
            with self.subTest(pipe=pipe), open(impact, "rb") as file:
                given = {"input": file.read()} if pipe else {"stdin": file}
                done = subprocess.run([program, "run", "/dev/stdin", "--out", self.out, "--quiet", "--force", *settings], **given)
                self.assert_complete(done.returncode)


if __name__ == "__main__":
    unittest.main()
