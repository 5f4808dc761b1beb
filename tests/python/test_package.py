"""The package `vitrum`: what it reads is what the files hold; what it says holds in its own examples."""
import csv
import doctest
import gc
import importlib
import os
import pathlib
import pkgutil
import subprocess
import sys
import unittest
from unittest import mock

import h5py
import numpy as np
from support import PackageTest, impact, source

import vitrum

glass_point = source / "tests/cli/points/glass.toml"


class Examples(unittest.TestCase):
    def test_examples_in_the_documentation_hold(self):
        attempted = 0
        for module in pkgutil.walk_packages(vitrum.__path__, "vitrum."):
            if module.name.count(".") == 1 or not module.name.startswith("vitrum.plot."):
                done = doctest.testmod(importlib.import_module(module.name))
                self.assertEqual(done.failed, 0, module.name)
                attempted += done.attempted
        self.assertGreater(attempted, 15)


class Types(PackageTest):
    @unittest.skipUnless(importlib.util.find_spec("mypy"), "no mypy")
    def test_annotations_hold(self):
        done = subprocess.run([sys.executable, "-m", "mypy", "--ignore-missing-imports", "--check-untyped-defs", f"--cache-dir={self.folder}",
                               *[word for package in ("vitrum", "study", "own", "paper", "trade", "sensitivity", "stability", "findings") for word in ("-p", package)]],
                              capture_output=True, text=True, cwd=source / "studies")
        self.assertEqual(done.returncode, 0, done.stdout)


class Results(PackageTest):
    @classmethod
    def setUpClass(cls):
        cls.run_of_impact = vitrum.run(impact, {"output.every": 5e-6, "output.history_every": 1e-6})

    def test_fields_are_those_of_the_file(self):
        run = self.run_of_impact
        self.assertEqual(run.bodies, ["plate", "cylinder"])
        with h5py.File(run.directory / "result.h5") as result:
            for n, frame in enumerate(run.frames):
                particles = result[f"steps/{n:05}/particles"]
                self.assertEqual(set(frame.names), set(particles))
                for name in particles:
                    np.testing.assert_array_equal(frame[name], particles[name][()])
                    self.assertEqual(run.units[name], particles[name].attrs["unit"])
        velocity = run.fields("velocity", "cylinder")
        self.assertEqual(velocity.shape, (5, 100, 2))
        self.assertTrue(np.all(velocity[0] == [0.0, -200.0]))
        self.assertEqual(run.fields("damage").shape, (5, 200))
        np.testing.assert_allclose(run.time, 5e-6 * np.arange(5), atol=1e-12)

    def test_masses_and_momentum_are_the_summary_s(self):
        run = self.run_of_impact
        for name, body in run.summary["bodies"].items():
            chosen = run.body == run.bodies.index(name)
            self.assertAlmostEqual(run.mass[chosen].sum(), body["mass"], delta=1e-12 * body["mass"])
            momentum = (run.mass[chosen, None] * run.frames[-1]["velocity"][chosen]).sum(axis=0)
            np.testing.assert_allclose(momentum, body["momentum"], rtol=1e-9, atol=1e-12)

    def test_tables_are_those_of_the_files(self):
        run = self.run_of_impact
        for name in ("energy", "events", "bodies", "reactions"):
            with open(run.directory / f"{name}.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            columns = run.columns(name)
            self.assertEqual(list(columns), list(rows[0]))
            for n in (0, len(rows) // 2, len(rows) - 1):
                for column, values in columns.items():
                    text = rows[n][column]
                    self.assertEqual(str(values[n]) if values.dtype.kind == "U" else float(values[n]), text if values.dtype.kind == "U" else float(text))
            self.assertEqual(len(run.table(name)), len(rows))
        self.assertEqual(set(run.histories), {"bodies", "reactions"})
        self.assertIn("damage", set(run.events["kind"]))
        self.assertTrue(np.all(np.diff(np.asarray(run.events["time"])) >= 0.0))

    def test_without_pandas_tables_are_structured_arrays(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            table = self.run_of_impact.histories["bodies"]
            self.assertIsInstance(table, np.ndarray)
            self.assertEqual(set(table["body"]), {"plate", "cylinder"})
            self.assertEqual(table["time"].dtype.kind, "f")

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "no pandas")
    def test_with_pandas_tables_are_frames(self):
        counted = self.run_of_impact.events.groupby("kind").size()
        self.assertEqual(counted.sum(), len(self.run_of_impact.columns("events")["time"]))

    def test_a_cut_line_is_left_out(self):
        path = self.folder / "table.csv"
        path.write_text('time,body,x\n0,"a, b",\n1,c,2.5\n2,d')
        from vitrum.tables import read_csv
        columns = read_csv(path)
        self.assertEqual(list(columns["body"]), ["a, b", "c"])
        np.testing.assert_array_equal(columns["x"], [np.nan, 2.5])

    def test_pictures(self):
        import matplotlib
        matplotlib.use("Agg")
        run = self.run_of_impact
        for draw in (*vitrum.plot.of_particles, *vitrum.plot.over_time):
            figure = draw(run)
            self.assertIsNotNone(figure, draw.__name__)
            figure.savefig(self.folder / "figure.png", dpi=30)
        self.assertEqual(len(vitrum.plot.snapshots(run, [0.0]).axes), 1)


class Runs(PackageTest):
    def test_settings_folder_and_scene_as_text_or_table(self):
        text = impact.read_text()
        out = vitrum.run(text, {"time.end": 1e-6, "body.cylinder.velocity": [0, -100.0], "output.every": None}, self.folder / "out")
        self.assertEqual(out.directory, self.folder / "out")
        self.assertTrue((self.folder / "out/summary.json").exists())
        self.assertEqual(out.scene["body"][1]["velocity"], [0.0, -100.0])
        again = vitrum.run(out.scene, out=self.folder / "again")
        for name in out.frames[-1].names:
            np.testing.assert_array_equal(out.frames[-1][name], again.frames[-1][name])

    def test_a_temporary_folder_goes_with_the_run(self):
        run = vitrum.run(impact, {"time.end": 1e-7})
        folder = run.directory
        self.assertTrue(folder.exists())
        last = run.frames[-1]["velocity"]
        del run
        gc.collect()
        self.assertFalse(folder.exists())
        self.assertEqual(last.shape, (200, 2))

    def test_no_fields(self):
        run = vitrum.run(impact, {"time.end": 1e-7}, fields=False)
        self.assertEqual(run.frames, [])
        self.assertIsNone(vitrum.plot.snapshots(run))
        with self.assertRaisesRegex(vitrum.InputError, "--no-fields"):
            run.fields("velocity")

    def test_errors(self):
        with self.assertRaisesRegex(vitrum.InputError, "unknown key, expected one of geometry"):
            vitrum.run(impact, {"space.nonsense": 1})
        with self.assertRaisesRegex(vitrum.InputError, "no such file"):
            vitrum.load(self.folder)
        with self.assertRaisesRegex(vitrum.InputError, "no TOML value"):
            vitrum.run(impact, {"space.cell": object()})
        with self.assertRaisesRegex(vitrum.ComputationError, "step") as failed:
            vitrum.run(impact, {"integrator.step": 1e-6})
        self.assertEqual(failed.exception.run.summary["status"], "failed")
        with self.assertRaises(vitrum.FileError):
            vitrum.run(impact, out="/proc/nowhere")
        run = vitrum.run(impact, {"time.end": 1e-7})
        with self.assertRaisesRegex(vitrum.InputError, "no field 'speed'.*velocity"):
            run.frames[0]["speed"]
        with self.assertRaisesRegex(vitrum.InputError, "no body 'ball'.*plate"):
            run.fields("velocity", "ball")
        with self.assertRaisesRegex(vitrum.InputError, "outside the run"):
            run.frames_at([1.0])

    def test_point_is_the_command_s(self):
        ours = vitrum.point(glass_point, {"path.samples": 50})
        answer = subprocess.run([os.environ["VITRUM"], "point", glass_point, "--set", "path.samples=50"], capture_output=True, text=True, check=True)
        rows = list(csv.DictReader(answer.stdout.splitlines()))
        self.assertEqual(list(ours.columns), list(rows[0]))
        for name, values in ours.columns.items():
            np.testing.assert_array_equal(values, [float(row[name]) for row in rows])
        self.assertEqual([f"event {name} t={time!r}" for time, name in ours.events][1:], answer.stderr.splitlines()[1:])
        self.assertEqual(ours.events[-1][1], "localisation")
        self.assertEqual(len(ours.table), 51)


class Program(PackageTest):
    def test_found_by_environment_or_path(self):
        from vitrum import program
        with mock.patch.dict(os.environ, {"PATH": str(self.folder)}):
            os.environ.pop("VITRUM")
            with mock.patch.object(program, "studies", self.folder / "a/b/c"):
                with self.assertRaisesRegex(vitrum.InputError, "environment variable VITRUM"):
                    program.program()
                (self.folder / "vitrum").touch(0o755)
                self.assertEqual(program.program(), (self.folder / "vitrum").resolve())
            prefix = self.folder / "prefix"
            (prefix / "bin").mkdir(parents=True)
            (prefix / "bin/vitrum").touch(0o755)
            with mock.patch.object(program, "studies", prefix / "share/vitrum/studies"):
                self.assertEqual(program.program(), prefix / "bin/vitrum")

    def test_pip_installs_it(self):
        if not importlib.util.find_spec("pip") or not importlib.util.find_spec("setuptools"):
            self.skipTest("no pip or no setuptools")
        import shutil
        shutil.copytree(source / "studies", self.folder / "studies", ignore=shutil.ignore_patterns("__pycache__"))
        target = self.folder / "site"
        done = subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index", "--target", target,
                               self.folder / "studies"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        code = "import vitrum, sys; print(vitrum.__file__); print(vitrum.load(sys.argv[1]).bodies)"
        out = vitrum.run(impact, {"time.end": 1e-7}, self.folder / "out")
        answer = subprocess.run([sys.executable, "-c", code, out.directory], capture_output=True, text=True, cwd=self.folder, check=True,
                                env={**os.environ, "PYTHONPATH": str(target)})
        self.assertEqual(answer.stdout.splitlines(), [str(pathlib.Path(target, "vitrum/__init__.py")), "['plate', 'cylinder']"])


if __name__ == "__main__":
    unittest.main()
