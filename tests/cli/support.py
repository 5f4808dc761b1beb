"""What the tests of the command line share: running the program, and reading what it leaves.

The program's path comes from the environment variable VITRUM.
"""
import csv
import json
import os
import pathlib
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


class CommandLineTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`, and assertions on the program's answers."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def vitrum(self, *arguments, status=0, **options):
        """Runs the program to its end and checks its exit status; stdout and stderr as texts."""
        done = subprocess.run([program, *map(str, arguments)], text=True, encoding="utf-8", timeout=120, cwd=self.folder,
                              stdin=subprocess.DEVNULL,
                              **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})
        self.assertEqual(done.returncode, status, f"{arguments}: {done.stderr}")
        return done

    def run_scene(self, name, *arguments, scene=impact, status=0):
        """`vitrum run` into the folder `name`, which is returned."""
        out = self.folder / name
        self.vitrum("run", scene, "--out", out, *arguments, status=status)
        return out

    def start(self, *arguments):
        """Starts the program and leaves it running; standard error is a pipe."""
        process = subprocess.Popen([program, *map(str, arguments)], text=True, cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def assert_same_results(self, one, other, steps=None):
        """All that two runs left is equal to the last bit, but for provenance and times of day. With `steps`, the first
        folder holds that many outputs only and has not come to its end."""
        a, b = read_result(one), read_result(other)
        if steps is not None:
            # Series come into being with the first output.
            b = {name: value[:steps] if name.startswith("series/") else value for name, value in b.items()
                 if not (name.startswith("steps/") and int(name.split("/")[1]) >= steps
                         or name.startswith("series/") and steps == 0)}
        self.assertEqual(sorted(a), sorted(b))
        for name, value in a.items():
            self.assertEqual(value.dtype, b[name].dtype, name)
            self.assertEqual(value.tobytes(), b[name].tobytes(), f"{name} differs")
        if steps is not None:
            return
        self.assertEqual((one / "energy.csv").read_text(), (other / "energy.csv").read_text())
        self.assertEqual((one / "result.xdmf").read_text(), (other / "result.xdmf").read_text())
        self.assertEqual(comparable_summary(one), comparable_summary(other))


def read_result(folder):
    """Every dataset of result.h5 by its path, and the attributes of the steps."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            value = np.array(item[()])
            found[name] = value.astype(bytes) if value.dtype == object else value
        elif name.startswith("steps/") and "time" in item.attrs:
            found[name] = np.array([item.attrs["time"], item.attrs["step_index"]])

    with h5py.File(folder / "result.h5") as result:
        result.visititems(visit)
    return found


def output_count(folder):
    with h5py.File(folder / "result.h5") as result:
        return len(result["steps"])


def read_summary(folder):
    return json.loads((folder / "summary.json").read_text())


def comparable_summary(folder):
    """The summary without what may differ between equal runs."""
    summary = read_summary(folder)
    for key in ("wall_seconds", "provenance", "threads"):
        del summary[key]
    return summary


def read_csv(path):
    """Columns of a CSV file by name."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], np.array(rows[1:], float).T, strict=True))


def overrides(**values):
    """Arguments --set for keys whose dots are written as double underscores."""
    return [argument for key, value in values.items() for argument in ("--set", f"{key.replace('__', '.')}={value}")]
