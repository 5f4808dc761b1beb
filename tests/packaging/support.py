"""What the tests of packaging share: CMake, the build folder (environment variable VITRUM_BUILD), and folders that go away."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

if "VITRUM_BUILD" not in os.environ:
    sys.exit("set VITRUM_BUILD to the folder of a build of all targets")
build = pathlib.Path(os.environ["VITRUM_BUILD"])
source = pathlib.Path(__file__).resolve().parents[2]

# What `vitrum point` is given, so that it does what examples/point does.
example_point = """
[material.glass]
density = 2500.0
young = 72.0e9
poisson = 0.25
damage = {toughness = 0.83e6, k = 5.0e26, m = 6.0, rate_floor = 1.0}
decohesion = {opening = 5.0e-6, mode_ratio = 50.0}
[path]
time = [0.0, 4.0e-6]
strain = [[0, 0, 0, 0], [12.0e-3, 0, 0, 0]]
size = 1.0e-3
samples = 400
"""


class PackagingTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum packaging "))
        self.addCleanup(shutil.rmtree, self.folder)

    def command(self, *words, **options):
        """Runs a command that must succeed; its standard output."""
        done = subprocess.run(list(map(str, words)), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=500, cwd=self.folder, **options)
        self.assertEqual(done.returncode, 0, f"{words}:\n{done.stdout}")
        return done.stdout

    def assert_drives_point(self, example):
        """The example prints what `vitrum point` computes along the same path."""
        rows = [line.split() for line in self.command(example).splitlines()]
        self.assertEqual(len(rows), 400)
        file = self.folder / "point.toml"
        file.write_text(example_point)
        answer = subprocess.run([build / "src/app/vitrum", "point", file], text=True, capture_output=True, check=True)
        names, *lines = [line.split(",") for line in answer.stdout.splitlines()]
        program = [dict(zip(names, map(float, line))) for line in lines[1:]]
        self.assertEqual(len(program), 400)
        peak = max(row["s_rr"] for row in program)
        for row, expected in zip(rows, program):
            time, strain, stress, damage = map(float, row[:4])
            self.assertAlmostEqual(time, expected["t"], delta=1e-14)
            self.assertAlmostEqual(strain, expected["e_rr"], delta=1e-10)
            self.assertAlmostEqual(stress, expected["s_rr"], delta=1e-6 * peak)
            self.assertAlmostEqual(damage, expected["damage"], delta=1e-6)
        events = [event for row in rows for event in row[4:]]
        self.assertEqual(events, [line.split()[1] for line in answer.stderr.splitlines() if line.startswith("event ")])
        self.assertEqual(events[-2:], ["localisation", "separation"])
