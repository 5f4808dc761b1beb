"""Disks that are full: a tmpfs of many sizes, with few files, an ext4, and a limit on the size of files; disks that are
read-only.

Each run ends with status 4 and names file and cause, what it completed is right, and it goes on when there is space.
"""
import os
import resource
import shutil
import subprocess
import time
import unittest

import mounts
from support import CommandLineTest, file_contents, file_names, impact, overrides, program, read_summary, size_of

settings = [*overrides(time__end=4e-6, output__every=5e-7, output__checkpoint_every=1e-6), "--threads", "1"]
no_space = "No space left on device"
tools = "/usr/sbin:/sbin:/usr/bin:/bin"


def starts_without_files():
    """The thread sanitizer writes one before main()."""
    return subprocess.run([program, "--version"], preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0)),
                          stdout=subprocess.DEVNULL).returncode == 0


class FullDisk(CommandLineTest):
    in_memory = True

    def setUp(self):
        super().setUp()
        self.whole = self.run_scene("whole", *settings)
        self.disk = self.folder / "disk"
        self.size = size_of(self.whole)

    def run_until_full(self, out, reason, **options):
        """The last message of a run that ends for want of space, and its completed outputs; None twice when there was enough."""
        answer = self.vitrum("run", impact, "--out", out, "--quiet", *settings, status=None, **options)
        if answer.returncode == 0:
            self.assert_same_results(out, self.whole)
            return None, None
        self.assertEqual(answer.returncode, 4, answer.stderr)
        message = answer.stderr.splitlines()[-1]
        self.assertRegex(message, f"^error: .*{out}.*: {reason}")
        if (out / "summary.json").exists():
            self.assertEqual(read_summary(out)["status"], "failed")
        return message, self.assert_completed_outputs(out, self.whole) or 0

    def assert_goes_on(self, out):
        self.recover(out, *settings)
        self.assert_same_results(out, self.whole)

    @mounts.needs_mounts
    def test_tmpfs(self):
        outputs, messages = set(), []
        # From nothing to enough: every file takes whole pages, and there are two of some while they are renewed.
        sizes = range(4096, 2 * self.size, 2 * self.size // 40 // 4096 * 4096)
        for size in sizes:
            with self.subTest(size=size), mounts.mounted(self.disk, "-t", "tmpfs", "-o", f"size={size}", "none") as change:
                message, completed = self.run_until_full(self.disk / "out", no_space)
                if message is not None:
                    messages.append(message)
                    outputs.add(completed)
                    change("size=100m")
                    self.assert_goes_on(self.disk / "out")
        self.assertGreater(len(outputs), 5, "the disk was full at few places only")
        self.assertLess(len(messages), len(sizes), "there never was enough")
        for saved in ("checkpoint written", "nor could a checkpoint be written"):
            self.assertTrue(any(saved in message for message in messages), saved)

    @mounts.needs_mounts
    def test_tmpfs_without_room_for_another_file(self):
        enough = len(file_names(self.whole)) + 3  # the disk itself, steps, and the lock
        for files in [*range(2, 10), enough // 2, enough - 2, enough - 1, enough]:
            with self.subTest(files=files), mounts.mounted(self.disk, "-t", "tmpfs", "-o", f"nr_inodes={files}", "none") as change:
                message, _ = self.run_until_full(self.disk, no_space)
                self.assertEqual(message is None, files >= enough, message)
                if message is not None:
                    change("nr_inodes=100")
                    self.assert_goes_on(self.disk)

    @mounts.needs_mounts
    def test_ext4(self):
        """It allocates late: what does not fit may be found when it is forced to disk."""
        if shutil.which("mkfs.ext4", path=tools) is None:
            self.skipTest("no mkfs.ext4")
        image = self.folder / "image"
        with open(image, "wb") as file:
            file.truncate(64 << 20)
        subprocess.run(["mkfs.ext4", "-q", "-m", "0", image], check=True, capture_output=True, env={"PATH": tools})
        with mounts.mounted(self.disk, "-o", "loop", image):
            for part in (0.02, 0.1, 0.3, 0.5, 0.7, 0.85, 0.95):
                out, filler = self.disk / "out", self.disk / "filler"
                with self.subTest(part=part):
                    subprocess.run(["fallocate", "-l", str(shutil.disk_usage(self.disk).free - int(part * self.size)), filler], check=True)
                    message, _ = self.run_until_full(out, no_space)
                    self.assertIsNotNone(message)
                    filler.unlink()
                    self.assert_goes_on(out)
                    shutil.rmtree(out)

    def test_limit_on_the_size_of_files(self):
        """What `ulimit -f` sets: needs no file system of its own."""
        largest = max(map(len, file_contents(self.whole).values()))
        for part in (0.0, 0.01, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95):
            out, limit = self.folder / f"out {part}", int(part * largest)
            with self.subTest(limit=limit):
                if limit == 0 and not starts_without_files():
                    continue
                message, _ = self.run_until_full(
                    out, "File too large", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                self.assertIsNotNone(message)
                self.assert_goes_on(out)


class ReadOnly(CommandLineTest):
    @mounts.needs_mounts
    def test_read_only_disk(self):
        out = self.folder / "disk"
        with mounts.mounted(out, "-t", "tmpfs", "none") as change:
            self.run_scene("disk", *overrides(output__checkpoint_every=4e-6))
            change("ro")
            for arguments in ([], ["--force"], ["--resume"]):
                answer = self.vitrum("run", impact, "--out", out, "--quiet", *arguments, status=4)
                self.assertRegex(answer.stderr, f"error: {out}/\\S+: cannot open: Read-only file system")
            self.vitrum("info", out)
            answer = self.vitrum("run", impact, "--out", out / "new", "--quiet", status=4)
            self.assertIn(f"error: {out}/new: cannot be made: Read-only file system", answer.stderr)

    @mounts.needs_mounts
    def test_disk_that_becomes_read_only_during_a_run(self):
        """As the system does to a disk with errors."""
        settings = overrides(integrator__step=4e-9, output__checkpoint_every=2e-6)
        whole = self.run_scene("whole", *settings)
        disk = self.folder / "disk"
        with mounts.mounted(disk, "-t", "tmpfs", "none"):
            # Renaming and creating fail on a folder that is mounted read-only over itself; open files can still be written.
            process = self.start("run", impact, "--out", disk / "out", *settings)
            self.wait_for_outputs(process, 4)
            with mounts.mounted(disk / "out", "--bind", disk / "out"):
                # (Busy while the run has a file of it open.)
                for _ in range(1000):
                    if subprocess.run(["mount", "-o", "remount,bind,ro", disk / "out"], capture_output=True).returncode == 0:
                        break
                    time.sleep(0.002)
                message = process.stderr.read().splitlines()[-1]
                self.assertEqual(process.wait(), 4, message)
                self.assertRegex(message, "error: .*Read-only file system")
            self.assertGreaterEqual(self.assert_completed_outputs(disk / "out", whole), 4)
            self.recover(disk / "out", *settings)
            self.assert_same_results(disk / "out", whole)

    @unittest.skipUnless(mounts.is_root and shutil.which("setpriv"), "another user can be played by root only")
    def test_folder_of_somebody_else(self):
        program = shutil.copy(os.environ["VITRUM"], self.folder / "vitrum")
        self.folder.chmod(0o755)
        out = self.run_scene("out", *overrides(output__checkpoint_every=4e-6))
        scene = shutil.copy(impact, self.folder / "scene.toml")
        for arguments in ([], ["--force"], ["--resume"]):
            done = subprocess.run(["setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups", program, "run", scene,
                                   "--out", out, "--quiet", *arguments], capture_output=True, text=True)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertRegex(done.stderr, f"error: {out}/\\S+: cannot open: Permission denied")
        self.assertFalse((out / ".vitrum.lock").exists())


if __name__ == "__main__":
    mounts.enter_private_mounts()
    unittest.main()
