"""Folders and files that go while a run needs them."""
import shutil
import signal
import unittest

from support import CommandLineTest, impact, overrides

settings = overrides(integrator__step=2e-9, output__every=2e-6, output__checkpoint_every=4e-6)


class LostFolders(CommandLineTest):
    in_memory = True

    def setUp(self):
        super().setUp()
        self.whole = self.run_scene("whole", *settings)
        self.out = self.folder / "out"
        self.scene = shutil.copy(impact, self.folder / "scene.toml")
        self.process = self.start("run", self.scene, "--out", self.out, *settings)
        self.wait_for_outputs(self.process, 4)

    def assert_ends(self, expected):
        message = self.process.stderr.read().splitlines()[-1]
        self.assertEqual(self.process.wait(), 4, message)
        self.assertRegex(message, f"error: t = \\S+ s: {self.out}: {expected}.*nor could a checkpoint be written")

    def test_removed(self):
        shutil.rmtree(self.out)
        self.assert_ends("is no longer this run's folder: it was moved, removed, cleared or taken by another run")
        self.assertFalse(self.out.exists())

    def test_moved_and_resumed_where_it_is(self):
        moved = self.out.rename(self.folder / "moved")
        self.assert_ends("is no longer this run's folder")
        self.assertGreaterEqual(self.assert_completed_outputs(moved, self.whole), 4)
        self.recover(moved, *settings)
        self.assert_same_results(moved, self.whole)

    def test_another_run_took_the_place(self):
        """The first run touches nothing of the second's."""
        self.out.rename(self.folder / "moved")
        other = self.start("run", impact, "--out", self.out, *settings)
        self.assert_ends("is no longer this run's folder")
        other.stderr.read()
        self.assertEqual(other.wait(), 0)
        self.assert_same_results(self.out, self.whole)

    def test_cleared_and_taken(self):
        """By a script that removes all files of a folder, hidden ones, too, before it runs into it again."""
        self.process.send_signal(signal.SIGSTOP)
        for path in self.out.iterdir():
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        other = self.start("run", impact, "--out", self.out, *settings)
        self.wait_for_outputs(other, 2)
        self.process.send_signal(signal.SIGCONT)
        self.assert_ends("is no longer this run's folder")
        other.stderr.read()
        self.assertEqual(other.wait(), 0)
        self.assert_same_results(self.out, self.whole)

    def test_lock_removed(self):
        """By somebody who tidies: the run takes it again, and keeps others out again."""
        (self.out / ".vitrum.lock").unlink()
        self.wait_for_outputs(self.process, 2)
        self.assertTrue((self.out / ".vitrum.lock").exists())
        self.process.stderr.read()
        self.assertEqual(self.process.wait(), 0)
        self.assert_same_results(self.out, self.whole)
        self.assertFalse((self.out / ".vitrum.lock").exists())

    def test_result_removed(self):
        """It is written anew at the next output, and leads to all of them."""
        (self.out / "result.h5").unlink()
        self.process.stderr.read()
        self.assertEqual(self.process.wait(), 0)
        self.assert_same_results(self.out, self.whole)

    def test_outputs_removed(self):
        shutil.rmtree(self.out / "steps")
        message = self.process.stderr.read().splitlines()[-1]
        self.assertEqual(self.process.wait(), 4, message)
        self.assertRegex(message, r"error: t = \S+ s: \S*/steps/\S+: cannot open: No such file or directory; checkpoint written")
        answer = self.vitrum("run", self.scene, "--out", self.out, "--quiet", *settings, "--resume", status=4)
        self.assertRegex(answer.stderr, "error: .*/steps/")

    def test_scene_removed(self):
        """It was read once, and is part of the result."""
        self.scene.unlink()
        self.process.stderr.read()
        self.assertEqual(self.process.wait(), 0)
        self.assert_same_results(self.out, self.whole)


if __name__ == "__main__":
    unittest.main()
