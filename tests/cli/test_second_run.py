"""A second run into the same folder: refused unless it continues (--resume) or replaces (--force) the first, and always
while that is under way."""
import errno
import signal
import subprocess
import unittest

import h5py
from support import CommandLineTest, file_contents, file_names, impact, output_count, overrides, preload, preloaded, program, read_summary

long = overrides(integrator__step=4e-9, output__every=2e-6)
checkpoints = overrides(output__checkpoint_every=4e-6)


def contents(folder):
    """All but the lock, which a killed run leaves and the next one takes away."""
    return {name: content for name, content in file_contents(folder).items() if name != ".vitrum.lock"}


class EarlierRun(CommandLineTest):
    in_memory = True

    def assert_refused(self, out, *found, arguments=(), remedies=("--resume", "--force", "--out")):
        before = contents(out)
        answer = self.vitrum("run", impact, "--out", out, "--quiet", *arguments, status=2)
        message = answer.stderr.splitlines()[-1]
        self.assertTrue(message.startswith(f"error: {out}: found an earlier run ("), message)
        for text in (*found, *remedies):
            self.assertIn(text, message)
        self.assertEqual(contents(out), before)

    def test_complete(self):
        out = self.run_scene("out", *checkpoints)
        self.assert_refused(out, "result.h5 with 11 outputs", "checkpoint.h5", "summary.json", "continue it by --resume")
        self.assert_refused(self.run_scene("plain"), "result.h5 with 11 outputs", "it left no checkpoint for --resume")
        self.assert_refused(self.run_scene("no fields", "--no-fields"), "result.h5 with 11 outputs")

    def test_failed_after_outputs(self):
        self.assert_refused(self.run_scene("out", *overrides(integrator__step=3e-7), status=3), "result.h5 with")

    def test_interrupted_and_killed(self):
        for number in (signal.SIGINT, signal.SIGKILL):
            out = self.folder / f"out {number}"
            process = self.start("run", impact, "--out", out, *long, *checkpoints)
            self.wait_for_outputs(process, 4)
            process.send_signal(number)
            process.wait()
            self.assert_refused(out, "result.h5 with", "checkpoint.h5", "continue it by --resume", arguments=[*long, *checkpoints])

    def test_parts_of_a_run(self):
        """What somebody keeps of a run, and files of other programs under the same names."""
        whole = self.run_scene("whole", *checkpoints)
        for name, content in (("summary.json", None), ("checkpoint.h5", None), ("result.h5", None), ("result.h5", b"mine"),
                              ("result.h5", b""), ("summary.json", b"{}"), ("summary.json", b"mine"), ("energy.csv", b"a,b\n1,2\n")):
            with self.subTest(name, content=content):
                out = self.folder / "out"
                out.mkdir(exist_ok=True)
                (out / name).write_bytes((whole / name).read_bytes() if content is None else content)
                self.assert_refused(out, name)
                (out / name).unlink()
        with h5py.File(out / "result.h5", "w") as foreign:
            foreign["mine"] = 1.0
        self.assert_refused(out, "result.h5, which cannot be read as a result")
        whole.rename(self.folder / "kept")
        (self.folder / "kept" / "result.h5").unlink()
        self.assert_refused(self.folder / "kept", "outputs in steps/")

    def test_nothing_worth_keeping(self):
        """Killed, or ended by a full disk, before the first output; an empty folder; other files."""
        whole = self.run_scene("whole")
        scene = self.folder / "last.toml"  # one output only, at the end
        scene.write_text(impact.read_text().replace("every = 2.0e-6", ""))
        out = self.folder / "out"
        process = self.start("run", scene, "--out", out, "--quiet", *overrides(integrator__step=5e-10))
        while not (out / "energy.csv").exists() or len((out / "energy.csv").read_text().splitlines()) < 50:
            self.assertIsNone(process.poll())
        process.kill()
        process.wait()
        self.assertEqual(output_count(out), 0)
        (out / "notes.txt").write_text("mine")
        (out / "pictures").mkdir()
        self.run_scene("out")
        self.assert_same_results(out, whole)
        self.assertEqual((out / "notes.txt").read_text(), "mine")
        self.assertTrue((out / "pictures").is_dir())
        self.assertEqual(file_names(out), sorted([*file_names(whole), "notes.txt"]))

    def test_force_replaces(self):
        """All of it, and nothing else; also what failed, was killed, or is no run's."""
        fresh = self.run_scene("fresh", "--no-fields")
        out = self.run_scene("out", *checkpoints)
        (out / "failed_point.toml").write_text("of an earlier failure")
        (out / ".result.h5.next").write_text("of a killed run")
        (out / ".checkpoint.h5.next").write_text("of a killed run")
        (out / "steps" / ".00011.h5.next").write_text("of a killed run")
        (out / ".vitrum.lock").write_text("of a killed run")
        (out / "notes.txt").write_text("mine")
        self.run_scene("out", "--no-fields", "--force")
        self.assertEqual((out / "energy.csv").read_text(), (fresh / "energy.csv").read_text())
        self.assertEqual(file_names(out), sorted([*file_names(fresh), "notes.txt"]))
        (out / "result.h5").write_bytes(b"mine")
        self.run_scene("out", "--force")
        self.run_scene("new", "--force")  # and where there is nothing to replace

    def test_force_and_resume(self):
        answer = self.vitrum("run", impact, "--out", "out", "--resume", "--force", status=2)
        self.assertRegex(answer.stderr, "--resume excludes --force")
        self.assertFalse((self.folder / "out").exists())

    def test_resume_without_a_checkpoint(self):
        out = self.run_scene("out")
        before = contents(out)
        answer = self.vitrum("run", impact, "--out", out, "--resume", "--quiet", status=4)
        self.assertRegex(answer.stderr, r"error: \S*/checkpoint\.h5: cannot read: No such file or directory; --resume goes on from a "
                         "checkpoint, which a run leaves when it is interrupted and as output.checkpoint_every asks; --force instead")
        self.assertEqual(contents(out), before)
        answer = self.vitrum("run", impact, "--out", "never", "--resume", "--quiet", status=4)
        self.assertIn("start without --resume", answer.stderr)
        self.assertFalse((self.folder / "never").exists())


class UnderWay(CommandLineTest):
    in_memory = True

    def test_nobody_else_comes_in(self):
        whole = self.run_scene("whole", *long, *checkpoints)
        out, link = self.folder / "out", self.folder / "link"
        link.symlink_to(out)
        process = self.start("run", impact, "--out", out, *long, *checkpoints)
        self.wait_for_outputs(process, 4)  # there is a checkpoint
        process.send_signal(signal.SIGSTOP)
        for folder in (out, link):
            for arguments in ([], ["--force"], ["--resume"]):
                with self.subTest(folder=folder.name, arguments=arguments):
                    answer = self.vitrum("run", impact, "--out", folder, "--quiet", *long, *checkpoints, *arguments, status=2)
                    self.assertRegex(answer.stderr, rf"error: {folder}: found a run under way here \(process {process.pid} on \S+, since "
                                     r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ\), expected a folder of its own for every run")
        self.vitrum("info", out)
        process.send_signal(signal.SIGCONT)
        process.stderr.read()
        self.assertEqual(process.wait(), 0)
        self.assert_same_results(out, whole)
        self.assertFalse((out / ".vitrum.lock").exists())

    def test_the_lock_goes_with_the_process(self):
        out = self.folder / "out"
        process = self.start("run", impact, "--out", out, *long)
        self.wait_for_outputs(process, 2)
        process.kill()
        process.wait()
        self.assertTrue((out / ".vitrum.lock").exists())
        self.run_scene("out", "--force")
        self.assertFalse((out / ".vitrum.lock").exists())

    @unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
    def test_file_system_without_locks(self):
        whole = self.run_scene("whole")
        for reason in (errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP):
            out = self.folder / f"out{reason}"
            answer = self.vitrum("run", impact, "--out", out, "--quiet", env=preloaded(LOCKS_FAIL=reason))
            self.assertIn(f"warning: {out}: this file system has no locks; nothing keeps a second run out", answer.stderr)
            self.assert_same_results(out, whole)
            self.assertFalse((out / ".vitrum.lock").exists())

    def test_at_the_same_moment(self):
        """Of several runs that start together one gets the folder, and is not disturbed."""
        whole = self.run_scene("whole")
        for n in range(5):
            out = self.folder / f"out{n}"
            runs = [subprocess.Popen([program, "run", impact, "--out", out, "--quiet"], stderr=subprocess.PIPE, text=True) for _ in range(6)]
            answers = [run.communicate()[1].splitlines()[-1] for run in runs]
            statuses = sorted(run.returncode for run in runs)
            self.assertEqual(statuses, [0, 2, 2, 2, 2, 2], answers)
            for run, answer in zip(runs, answers):
                if run.returncode == 2:
                    self.assertRegex(answer, "found a run under way here|found an earlier run")
            self.assert_same_results(out, whole)
            self.assertEqual(read_summary(out)["status"], "complete")


if __name__ == "__main__":
    unittest.main()
