"""Results and checkpoints that are damaged, cut, foreign, or no files at all, given to `info`, `compare` and `run --resume`: each
command ends in time and within bounded memory, with status 4 or with the content that was written; never with another one.

VITRUM_CORRUPTIONS is the number of damaged files (a longer campaign: VITRUM_CORRUPTIONS=5000).
"""
import os
import pathlib
import random
import resource
import shutil
import subprocess
import unittest

import damage
import foreign
from support import CommandLineTest, impact, overrides, program

corruptions = int(os.environ.get("VITRUM_CORRUPTIONS", 120))
seconds = 20
bytes_of_memory = 1 << 30
interval = overrides(output__every=1e-5, output__checkpoint_every=1e-5)


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (bytes_of_memory, bytes_of_memory))


# Address sanitizers reserve more than any limit admits.
is_limited = subprocess.run([program, "--version"], preexec_fn=limit_memory, stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL).returncode == 0


class DamagedFiles(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.good = self.run_scene("good", "--quiet", *interval)
        self.result, self.checkpoint = self.good / "result.h5", self.good / "checkpoint.h5"
        self.random = random.Random(20240607)

    def ask(self, *arguments):
        """Status and standard output of a command that must end by itself, with a reason when it fails."""
        done = subprocess.run([program, *map(str, arguments)], text=True, timeout=seconds, cwd=self.folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit_memory if is_limited else None)
        if done.returncode != 0:
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertEqual(done.stdout, "")
            self.assertRegex(done.stderr.splitlines()[-1], "^error: .")
        return done.returncode, done.stdout

    def answers(self, path):
        """What `info` and `compare` say of a result; its own name left out."""
        return [(status, text.replace(str(path), "FILE")) for status, text in (
            self.ask("info", path, "--json"), self.ask("compare", self.result, path, "--json"))]

    def copy_of_result(self, name):
        """result.h5 in a folder of its own with its outputs, to be damaged."""
        folder = self.folder / name
        shutil.copytree(self.good / "steps", folder / "steps")
        return pathlib.Path(shutil.copy(self.result, folder))

    def damaged(self, path, count):
        data = path.read_bytes()
        for number in range(count):
            yield number, damage.kinds[number % len(damage.kinds)], data

    def test_damaged_result(self):
        path = self.copy_of_result("damaged")
        right = self.answers(path)
        self.assertEqual([status for status, _ in right], [0, 0])
        refused = 0
        parts = [path, path.parent / "steps" / "00002.h5", path, path.parent / "steps" / "particles.h5"]
        for number in range(corruptions):
            part, kind = parts[number % len(parts)], damage.kinds[number % len(damage.kinds)]
            data = part.read_bytes()
            part.write_bytes(kind(data, self.random))
            with self.subTest(number=number, part=part.name, kind=kind.__name__):
                for answer, expected in zip(self.answers(path), right, strict=True):
                    refused += answer[0] != 0
                    if answer[0] == 0:
                        self.assertEqual(answer, expected)
            part.write_bytes(data)
        self.assertGreater(refused, corruptions // 3)

    def resume(self, folder):
        return self.ask("run", impact, "--out", folder, "--resume", "--quiet", *interval)[0]

    def test_resume_from_damaged_files(self):
        """The checkpoint is refused whatever its damage; what is damaged in the result is refused or stays an error."""
        right = self.ask("compare", self.result, self.result, "--json")[1]
        for name in ("checkpoint.h5", "result.h5", "steps/00001.h5", "steps/particles.h5", "energy.csv"):
            for number, kind, data in self.damaged(self.good / name, max(corruptions // 6, 1)):
                out = self.folder / f"resumed-{name.replace('/', '-')}-{number}"
                shutil.copytree(self.good, out)
                (out / name).write_bytes(kind(data, self.random))
                changed = (out / name).read_bytes()
                with self.subTest(name=name, number=number, kind=kind.__name__):
                    status = self.resume(out)
                    if name == "checkpoint.h5" and changed != data:
                        self.assertEqual(status, 4)
                    elif name.endswith(".h5") and status == 0:
                        status, text = self.ask("compare", self.result, out / "result.h5", "--json")
                        if status == 0:
                            self.assertEqual(text.replace(str(out / "result.h5"), str(self.result)), right)
                shutil.rmtree(out)

    def test_foreign_files(self):
        accepted = {"many_steps", "old_format", "mass_is_elsewhere"}  # odd, but all that is asked for is there
        for name, (part, write) in foreign.writers.items():
            path = self.copy_of_result(name)
            write(path.parent / part, self.good / part)
            with self.subTest(name=name):
                answers = self.answers(path)
                self.assertEqual({status for status, _ in answers} <= {0, 4}, True)
                if name not in accepted:
                    self.assertIn(4, [status for status, _ in answers])
                out = self.folder / "resumed"
                shutil.copytree(self.good, out)
                shutil.copy(path.parent / part, out / part)
                self.resume(out)
                shutil.rmtree(out)

    def test_what_is_no_file(self):
        pipe, folder, link = self.folder / "pipe", self.folder / "folder", self.folder / "loop"
        os.mkfifo(pipe)
        folder.mkdir()
        link.symlink_to(link)
        for path in (pipe, folder, link, "/dev/zero", "/dev/null", "/dev/stdin", "/proc/self/mem", self.folder / "a" / "b"):
            with self.subTest(path=str(path)):
                for arguments in (("info", path), ("compare", self.result, path), ("compare", path, self.result)):
                    self.assertEqual(self.ask(*arguments)[0], 4)
        for name in ("checkpoint.h5", "result.h5", "energy.csv", "steps/00000.h5", "steps/particles.h5"):
            for stand_in in (pipe, folder, "/dev/zero"):
                out = self.folder / "out"
                shutil.copytree(self.good, out)
                (out / name).unlink()
                (out / name).symlink_to(stand_in)
                with self.subTest(name=name, stand_in=str(stand_in)):
                    self.assertEqual(self.resume(out), 4)
                shutil.rmtree(out)

    def test_damaged_summary(self):
        summary = self.good / "summary.json"
        text = summary.read_bytes()
        other = self.folder / "other"
        shutil.copytree(self.good, other)
        texts = [b"", b"{", b"[]", b"null", b"\xff", b"1e999", b"[" * 100000, b'{"energy": ' * 100000, text[:len(text) // 2],
                 b'{"failure": {"fragments": 1}, "status": 7, "energy": [[[1, "x"]]]}', b'{"status": "complete", "energy": 1e999}']
        for content in texts:
            summary.write_bytes(content)
            with self.subTest(content=content[:20]):
                statuses = self.ask("info", self.good)[0], self.ask("compare", self.good, other)[0]
                if b"fragments" not in content[:40]:
                    self.assertEqual(statuses, (4, 4))
        summary.unlink()
        summary.symlink_to("/dev/zero")
        self.assertEqual((self.ask("info", self.good)[0], self.ask("compare", self.good, other)[0]), (4, 4))


if __name__ == "__main__":
    unittest.main()
