"""SIGINT and SIGTERM, --resume, and checkpoints that must not be resumed from."""
import hashlib
import os
import re
import shutil
import signal
import subprocess
import unittest

from support import CommandLineTest, file_contents, impact, overrides, plane_strain, program, read_summary

# 5000 steps, so that there is time to interrupt.
long = overrides(integrator__step=4e-9, output__every=2e-6)
adaptive = overrides(integrator__courant=0.03, output__every=2e-6)
checkpoints = overrides(output__checkpoint_every=4e-6)


def digests(folder):
    return {name: hashlib.sha256(content).hexdigest() for name, content in file_contents(folder).items()}


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
                self.assertRegex(message, r"interrupted: signal \d+: checkpoint written at t = \S+ s; continue with `.* run .*`")
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


class PrintedCommand(CommandLineTest):
    """What an interrupted run prints is a command that a shell takes, and that ends with the results of a whole run."""

    def interrupted(self, arguments, where, program=program):
        process = subprocess.Popen([program, *map(str, arguments)], text=True, cwd=where, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        self.wait_for_outputs(process, 3)
        process.send_signal(signal.SIGINT)
        message = process.stderr.read()
        self.assertEqual(process.wait(), 130)
        return re.search(r"^interrupted: .* continue with `(.*)`$", message, re.MULTILINE).group(1)

    def obey(self, command, where, shell="sh"):
        done = subprocess.run([shell, "-c", command], cwd=where, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, f"{command}: {done.stderr}")

    def test_names_and_values_that_need_quotes(self):
        whole = self.run_scene("whole", *long, "--set", "title=\"it's $HOME `x` \\\\ \"")
        where = self.folder / "a folder with 'quotes' & $blanks"
        where.mkdir()
        shutil.copy(impact, where / "my plate; rm -f x.toml")
        for n, out in enumerate(("out b/it's", '-da"sh', "grüße $(touch hit)", "~x*?")):
            with self.subTest(out=out):
                command = self.interrupted(["run", "my plate; rm -f x.toml", f"--out={out}", *long,
                                            "--set", "title=\"it's $HOME `x` \\\\ \"", "--threads", 1 + n % 2], where)
                self.obey(command, where)
                self.assert_same_results(where / out, whole)
        self.assertFalse((where / "hit").exists())

    def test_control_characters(self):
        """On one line all the same, for shells that know $'..'."""
        whole = self.run_scene("whole", *long)
        out = "two\nlines\tand 'more' \\n"
        self.obey(self.interrupted(["run", impact, "--out", out, *long], self.folder), self.folder, shell="bash")
        self.assert_same_results(self.folder / out, whole)

    def test_interrupted_while_it_replaces_a_run(self):
        """--force is part of the command that made the run, not of the one that goes on with it."""
        whole = self.run_scene("whole", *long)
        self.run_scene("out", *long)
        command = self.interrupted(["run", impact, "--out", "out", *long, "--force"], self.folder)
        self.assertNotIn("--force", command)
        self.obey(command, self.folder)
        self.assert_same_results(self.folder / "out", whole)

    def test_default_folder_no_fields_and_twice(self):
        whole = self.run_scene("whole", *long, "--no-fields")
        command = self.interrupted(["run", impact, *long, "--no-fields"], self.folder)
        process = subprocess.Popen(["sh", "-c", "exec " + command], text=True, cwd=self.folder, stderr=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL)
        self.addCleanup(process.stderr.close)
        self.wait_for_outputs(process, 2)
        process.send_signal(signal.SIGINT)
        self.assertIn(f"continue with `{command}`", process.stderr.read())
        self.assertEqual(process.wait(), 130)
        self.obey(command, self.folder)
        self.assertEqual((self.folder / "out" / "impact" / "energy.csv").read_text(), (whole / "energy.csv").read_text())

    def test_program_in_a_folder_with_a_blank(self):
        (self.folder / "my programs").mkdir()
        copy = self.folder / "my programs" / "vitrum it's"
        os.symlink(program, copy)
        self.obey(self.interrupted(["run", impact, "--out", "out", *long], self.folder, program=copy), self.folder)

    def test_the_command_of_a_refused_resumption(self):
        """Without the --set values of its run; what is printed continues it."""
        whole = self.run_scene("whole", *long)
        self.interrupted(["run", impact, "--out", "out put", *long], self.folder)
        answer = self.vitrum("run", impact, "--out", "out put", "--resume", "--quiet", status=2)
        self.assertRegex(answer.stderr, r"key 'integrator\.step': found 2e-08, expected 4e-09; expected those of the run that it continues: `.*`$")
        self.obey(re.search(r"`(.*)`$", answer.stderr, re.MULTILINE).group(1), self.folder)
        self.assert_same_results(self.folder / "out put", whole)


class Resume(CommandLineTest):
    def test_a_finished_run(self):
        # With a checkpoint before the end, and with one at the end.
        for every in (4e-6, 2e-6):
            with self.subTest(every=every):
                settings = overrides(output__checkpoint_every=every)
                whole, out = self.run_scene(f"whole{every}", *settings), self.run_scene(f"out{every}", *settings)
                self.run_scene(out.name, *settings, "--resume")
                self.assert_same_results(out, whole)

    def test_stretched_domains_and_cracks_that_share_cells(self):
        shared = overrides(output__checkpoint_every=4e-6, time__end=6e-6, space__shape_functions='"cpgimp"', body__0__particles_per_cell=4, body__1__particles_per_cell=4)
        for method in ("explicit", "arkode-explicit", "arkode-implicit"):
            with self.subTest(method):
                settings = (*shared, *overrides(integrator__method=f'"{method}"'))
                whole, out = (self.run_scene(f"{name} {method}", *settings, "--threads", 1) for name in ("whole", "out"))
                self.run_scene(out.name, *settings, "--resume", "--threads", 2)
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

    def test_outputs_beyond_the_checkpoint_are_removed(self):
        whole, out = (self.run_scene(name, *checkpoints, *overrides(time__end=14e-6)) for name in ("whole", "out"))
        for number in range(8, 12):  # as of a run that was killed later
            (out / "steps" / f"{number:05d}.h5").write_bytes((out / "steps" / "00003.h5").read_bytes())
            (out / "steps" / f"{number:05d}.xmf").write_text("<Grid/>")
        (out / "steps" / ".00012.h5.next").write_bytes(b"in the making")
        (out / "steps" / "notes.txt").write_text("mine")
        self.run_scene("out", *checkpoints, *overrides(time__end=14e-6), "--resume")
        self.assertEqual((out / "steps" / "notes.txt").read_text(), "mine")
        (out / "steps" / "notes.txt").unlink()
        self.assert_same_results(out, whole)

    def test_another_scene(self):
        out = self.run_scene("out", *checkpoints)
        self.assert_refused(out, 2, "checkpoint of another scene.*key 'body.1.velocity.1': found -150.0, expected -200.0",
                            *checkpoints, *overrides(body__1__velocity__1=-150.0))
        self.assert_refused(out, 2, "key 'output.checkpoint_every': found nothing, expected 4e-06")
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
