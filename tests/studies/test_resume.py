"""A study that was killed goes on where it was; scenes are validated before anything runs."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from support import run_study, source


class Resume(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-study-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = self.folder / "out"

    def finished(self):
        return {path: path.stat().st_mtime_ns for path in self.out.glob("runs/**/outcome.json")}

    def test_killed(self):
        # A group of its own, so that what it started dies with it.
        study = subprocess.Popen([source / "studies/run", "sensitivity", self.out, "1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 start_new_session=True)
        deadline = time.monotonic() + 900
        while len(self.finished()) < 4 and study.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        os.killpg(study.pid, signal.SIGKILL)
        study.wait()
        before = self.finished()
        self.assertGreaterEqual(len(before), 4)
        self.assertFalse((self.out / "page.md").exists())
        done = run_study("sensitivity", self.out)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        after = self.finished()
        self.assertGreater(len(after), len(before))
        self.assertEqual({path: after[path] for path in before}, before, "finished runs were made again")
        for path in after:
            self.assertEqual(json.loads(path.read_text())["status"], "complete")
        self.assertTrue((self.out / "page.md").exists())

    def test_scenes_are_checked_first(self):
        refusing = self.folder / "vitrum"
        refusing.write_text("#!/bin/sh\necho \"scene.toml:1:1: key 'x': no\" >&2\nexit 2\n")
        refusing.chmod(0o755)
        environment = {**os.environ, "VITRUM": str(refusing)}
        # A study of a file, and one whose cases are made by its module.
        for name, expected in (("paper", "error: scene.toml:1:1: key 'x': no"), ("findings", "case pictures/reference: exit status 2: scene.toml:1:1: key 'x': no")):
            done = subprocess.run([source / "studies/run", name, self.out, "1"], capture_output=True, text=True, env=environment, timeout=900)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(expected, done.stderr)
            self.assertFalse((self.out / "runs").exists())


if __name__ == "__main__":
    unittest.main()
