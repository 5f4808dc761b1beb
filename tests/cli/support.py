"""What the tests of the command line share: running the program, and reading what it leaves.

The program's path comes from the environment variable VITRUM.
"""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

here = pathlib.Path(__file__).resolve().parent
source = here.parent.parent
impact = here / "scenes" / "impact.toml"
plane_strain = here / "scenes" / "plane_strain.toml"
glass_point = here / "points" / "glass.toml"

if "VITRUM" not in os.environ:
    sys.exit("set VITRUM to the path of the program")
program = os.environ["VITRUM"]
preload = os.environ.get("VITRUM_PRELOAD")  # tests/cli/preload as a library; without it tests that need it are skipped


def preloaded(**settings):
    """The environment in which tests/cli/preload stands between the program and the C library."""
    # A sanitizer wants to be the first library; here it may be the second.
    sanitizer = ":".join(filter(None, (os.environ.get("ASAN_OPTIONS"), "verify_asan_link_order=0")))
    return {**os.environ, "LD_PRELOAD": preload, "ASAN_OPTIONS": sanitizer,
            **{name: str(value) for name, value in settings.items()}}


class CommandLineTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`, and assertions on the program's answers."""

    in_memory = False  # whether the folder may be one that costs no disk: much is written, and forced to disk

    def setUp(self):
        memory = "/dev/shm" if self.in_memory and os.access("/dev/shm", os.W_OK) else None
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-", dir=memory))
        self.addCleanup(shutil.rmtree, self.folder)

    def vitrum(self, *arguments, status=0, **options):
        """Runs the program to its end and checks its exit status (None: any); stdout and stderr as texts."""
        given = {} if "input" in options else {"stdin": subprocess.DEVNULL}
        done = subprocess.run([program, *map(str, arguments)], text=True, encoding="utf-8", timeout=120, cwd=self.folder,
                              **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **given, **options})
        if status is not None:
            self.assertEqual(done.returncode, status, f"{arguments}: {done.stderr}")
        return done

    def run_scene(self, name, *arguments, scene=impact, status=0):
        """`vitrum run` into the folder `name`, which is returned."""
        out = self.folder / name
        self.vitrum("run", scene, "--out", out, *arguments, status=status)
        return out

    def start(self, *arguments, **options):
        """Starts the program and leaves it running; standard error is a pipe."""
        process = subprocess.Popen([program, *map(str, arguments)], text=True, cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def run_on_terminal(self, *arguments, **options):
        """What the program writes on standard error when that is a terminal."""
        try:
            ours, theirs = os.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminals here: {error}")
        shown = b""
        try:
            self.vitrum(*arguments, stderr=theirs, **options)
        finally:
            os.close(theirs)
            while True:
                try:
                    piece = os.read(ours, 65536)
                except OSError:  # the terminal's other end is closed and all is read
                    break
                if not piece:
                    break
                shown += piece
            os.close(ours)
        return shown.decode()

    def wait_for_outputs(self, process, count):
        """Until the program has told of so many outputs; its lines."""
        lines = []
        while sum(line.startswith("t = ") for line in lines) < count:
            lines.append(process.stderr.readline())
            self.assertTrue(lines[-1], f"ended too early: {''.join(lines)}")
        return lines

    def wait_for_line(self, process, line):
        """Until the program writes `line` on standard error."""
        while (read := process.stderr.readline()) != line:
            self.assertTrue(read, f"ended without saying {line!r}")

    def assert_completed_outputs(self, out, whole):
        """Whatever happened to the run in `out`, its outputs so far can be read and are those of the run `whole`, and what it
        tells of energies is what that told. The number of outputs; None: it came to nothing."""
        if not (out / "result.h5").exists():
            return None
        outputs = output_count(out)
        self.assert_same_results(out, whole, steps=outputs)
        for table in out.glob("*.csv"):
            self.assertTrue((whole / table.name).read_text().startswith(table.read_text()), table.name)
        return outputs

    def recover(self, out, *arguments, scene=impact):
        """Goes on with an ended run from its checkpoint, or starts anew where there is none."""
        self.vitrum("run", scene, "--out", out, "--quiet", *arguments,
                    "--resume" if (out / "checkpoint.h5").exists() else "--force")

    def assert_same_results(self, one, other, steps=None):
        """All that two runs left is equal to the last bit, but for provenance and times of day. With `steps`, the first
        folder holds that many outputs only and has not come to its end."""
        a, b = read_result(one), read_result(other)
        if steps is not None:
            # Series come into being with the first output.
            b = {name: value[:steps] if name.startswith("series/") else value for name, value in b.items()
                 if not (name.startswith("steps/") and int(name.split("/")[1]) >= steps
                         or name.startswith("series/") and steps == 0)}
            # Tables reach result.h5 at the end; what stands in files is compared by who calls.
            a, b = ({name: value for name, value in each.items() if not name.startswith(("tables/", "events/"))}
                    for each in (a, b))
        self.assertEqual(sorted(a), sorted(b))
        for name, value in a.items():
            self.assertEqual(value.dtype, b[name].dtype, name)
            self.assertEqual(value.tobytes(), b[name].tobytes(), f"{name} differs")
        if steps is not None:
            return
        self.assertEqual([path.name for path in sorted(one.glob("*.csv"))], [path.name for path in sorted(other.glob("*.csv"))])
        for table in one.glob("*.csv"):
            self.assertEqual(table.read_text(), (other / table.name).read_text(), table.name)
        self.assertEqual(drawings(one), drawings(other))
        self.assertEqual(file_names(one / "steps"), file_names(other / "steps"))
        self.assertEqual(comparable_summary(one), comparable_summary(other))


def told(stderr):
    """The messages on standard error, without the lines of the input that they show below themselves."""
    return [line for line in stderr.splitlines() if not re.match(r" +\d* \| ", line)]


def read_result(folder):
    """Every dataset that result.h5 leads to by its path, and the attributes of the steps."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            value = np.array(item[()])
            found[name] = value.astype(bytes) if value.dtype == object else value
            return
        if "time" in item.attrs:
            found[name] = np.array([item.attrs["time"], item.attrs["step_index"]])
        for member in item:
            visit(f"{name}/{member}".lstrip("/"), item[member])

    with h5py.File(folder / "result.h5") as result:
        visit("", result)
    return found


def file_names(folder):
    """All files below a folder."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir())


def file_contents(folder):
    return {name: (folder / name).read_bytes() for name in file_names(folder)}


def size_of(folder):
    """Bytes of all files below a folder."""
    return sum(len(content) for content in file_contents(folder).values())


def drawings(folder):
    """The XDMF files of a run."""
    return {name: (folder / name).read_text() for name in file_names(folder) if name.endswith((".xdmf", ".xmf"))}


def output_count(folder):
    with h5py.File(folder / "result.h5") as result:
        return len(result["steps"])


def read_summary(folder):
    return json.loads((folder / "summary.json").read_text())


def comparable_summary(folder):
    """The summary without what may differ between equal runs."""
    summary = read_summary(folder)
    for key in ("wall_seconds", "total_seconds", "provenance", "threads"):
        summary.pop(key, None)
    summary["warnings"] = [line[max(line.find(": key '"), 0):] for line in summary["warnings"]]  # not the scene's name
    return summary


def read_csv(path):
    """Columns of a CSV file by name."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], np.array(rows[1:], float).T, strict=True))


def overrides(**values):
    """Arguments --set for keys whose dots are written as double underscores."""
    return [argument for key, value in values.items() for argument in ("--set", f"{key.replace('__', '.')}={value}")]
