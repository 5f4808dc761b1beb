"""Loads over time and place, tractions, prestress: what scenes say of them, and what runs keep."""
import csv
import json
import math
import unittest

import h5py

from support import CommandLineTest, here, overrides, read_summary, source

loaded = here / "scenes" / "loaded.toml"
examples = source / "examples"


class Loads(CommandLineTest):
    def fields(self, out):
        with h5py.File(out / "result.h5") as result:
            return {f"{step}/{name}": data[()].tobytes() for step in result["steps"]
                    for name, data in result[f"steps/{step}/particles"].items()}

    def test_bits(self):
        """Threads and an interruption change nothing."""
        for method in ("explicit", "arkode-explicit", "arkode-implicit"):
            run = ("--set", f'integrator.method="{method}"', *overrides(output__checkpoint_every=6e-6))
            whole = self.run_scene(f"whole-{method}", *run, "--threads", "1", scene=loaded)
            fields, energy = self.fields(whole), read_summary(whole)["energy"]
            self.assertGreater(energy["external"], 0.0)
            self.assertLess(abs(energy["relative_residual"]), 0.05)
            shared = self.run_scene(f"shared-{method}", *run, "--threads", "3", scene=loaded)
            self.assertEqual(self.fields(shared), fields)
            (whole / "summary.json").unlink()
            self.vitrum("run", loaded, "--out", whole, *run, "--resume")
            self.assertEqual(self.fields(whole), fields)
            self.assertEqual(read_summary(whole)["energy"], energy)

    def test_resolved(self):
        """The resolved scene has formulas and tables, and is the same scene."""
        resolved = json.loads(self.vitrum("check", loaded, "--json").stdout)["resolved"]
        for text in ('velocity = [0.0, "=-sin(pi*t/(10*us))*(t < 10*us)"]', 'pressure = "=p*(1 - (r/(10*mm))^2)"',
                     "acceleration = [0.0, {table = [[0.0, 0.0], [5e-06, -9810.0]]}]", "parameters = {p = 2e+06}"):
            self.assertIn(text, resolved)
        again = self.vitrum("check", "-", "--json", input=resolved)
        self.assertEqual(json.loads(again.stdout)["resolved"], resolved)

    def test_messages(self):
        for settings, status, words in (
                (['traction.0.pressure="=q*r"'], 2, r"key 'traction\.0\.pressure': .*'q' is no parameter"),
                (['traction.0.follows=none', 'traction.0.vector=[0, 1]'], 0, "^"),
                (['traction.0.body="plat"'], 2, r"key 'traction\.0\.body': .*did you mean 'plate'"),
                (['traction.0.box={min=[0, 1], max=[1, 2]}'], 2, r"key 'traction\.0\.box': found nothing of the surface of body 'plate'"),
                (['traction.1.blast={charge=1, standoff=100}'], 2, r"key 'traction\.1\.blast': found a scaled distance of 100 "),
                (['traction.0.vector=[0, 1]', 'traction.0.follows=true'], 2, r"key 'traction\.0\.follows': found together with 'vector'"),
                (['body.0.stress=["=1/0", 0, 0, 0]'], 2, r"key 'body\.0\.stress\.0': "),
                (['body.0.stress=["=sqrt(r-0.01)", 0, 0, 0]'], 2, r"key 'body\.0\.stress\.0': found \"=sqrt\(r-0.01\)\" = "),
        ):
            with self.subTest(settings):
                done = self.vitrum("check", loaded, *(a for s in settings for a in ("--set", s)), status=status)
                self.assertRegex(done.stderr, words)
        done = self.vitrum("run", loaded, "--out", "late", "--set", 'traction.0.pressure="=1e6/(t < 5*us)"', status=3)
        self.assertRegex(done.stderr, r"key 'traction\.0\.pressure': found \"=1e6/\(t < 5\*us\)\" = inf at t = 5")

    def test_balance(self):
        profile = ('body.0.stress=["=1e7*(1-3*(2*z/0.004-1)^2)", 0, "=1e7*(1-3*(2*z/0.004-1)^2)", 0]', "body.0.relax=true")
        out = self.vitrum("check", loaded, "--set", profile[0], "--set", profile[1]).stdout
        self.assertRegex(out, r"# body 'plate': initial stress up to 1.*e\+07 Pa; a mean section of it carries a force of ")
        self.assertNotIn("initial stress", self.vitrum("check", loaded).stdout)


class Examples(CommandLineTest):
    """The scenes that ship, on coarse grids or for a short while."""

    def test_blast(self):
        out = self.run_scene("out", *overrides(space__cell=1.52e-3, time__end=60e-6), scene=examples / "blast_window.toml")
        summary = read_summary(out)
        self.assertEqual(summary["status"], "complete")
        # Panes and frame have got the impulse of the pulse, per metre: peak x half the span x time, less its decay so far.
        momentum = -sum(body["momentum"][1] for body in summary["bodies"].values())
        self.assertLess(10.0, momentum)
        self.assertLess(momentum, 2.11e6 * 0.152 * 60e-6)
        self.assertLess(abs(summary["energy"]["relative_residual"]), 0.05)

    def test_tempered_drop(self):
        """A fall that annealed glass does not bear, and tempered glass does."""
        for stress, breaks in ((100e6, False), (0.0, True)):
            out = self.run_scene(f"S{stress:g}", *overrides(space__cell=1e-3, parameters__fall=1.25, parameters__S=stress),
                                 scene=examples / "tempered_drop.toml")
            summary = read_summary(out)
            self.assertEqual(summary["status"], "complete")
            self.assertEqual(summary["failure"]["first_damage"] is not None, breaks)
            self.assertLess(abs(summary["energy"]["relative_residual"]), 0.01)

    def test_ring_on_ring(self):
        """Stiffness and stress of a thin plate on two rings (Kirchhoff; ASTM C1499), and failure from the face in tension."""
        out = self.run_scene("out", *overrides(time__end=1.2e-3), scene=examples / "ring_on_ring.toml")
        self.assertLess(abs(read_summary(out)["energy"]["relative_residual"]), 0.01)
        a, b, h, R, speed, rise, E, nu = 0.03, 0.0105, 3e-3, 0.036, 0.2, 0.2e-3, 72e9, 0.25
        shape = (1 - nu) * (a * a - b * b) / (2 * (1 + nu) * R * R)
        moment = (1 + nu) / (4 * math.pi) * (math.log(a / b) + shape)  # within the load ring, over its force
        D = E * h**3 / (12 * (1 - nu * nu))
        middle = ((a * a - b * b) * (1 + shape) - b * b * math.log(a / b)) / (8 * math.pi * D)
        rings = middle - moment / (D * (1 + nu)) * b * b / 2
        impulse = {ring: [(float(row["time"]), float(row["impulse_z"])) for row in rows(out / "reactions.csv") if row["boundary"] == ring]
                   for ring in ("load ring", "support ring")}
        first = next(event for event in rows(out / "events.csv") if event["kind"] == "localisation")
        breaks = float(first["time"])
        for whole in (0.6e-3, 0.9e-3):  # s, over whole swings of the disk, nearly
            force = -slope(impulse["load ring"], whole - 0.2e-3, whole)
            self.assertAlmostEqual(force * rings / (speed * (whole - 0.1e-3 - rise / 2)), 1.0, delta=0.03)
            self.assertAlmostEqual(slope(impulse["support ring"], whole - 0.2e-3, whole) / force, 1.0, delta=0.02)
        force = -slope(impulse["load ring"], breaks - 60e-6, breaks - 20e-6) * (breaks - rise / 2) / (breaks - 40e-6 - rise / 2)
        row = 0.75e-3 / 4  # m, of the particles next to the face
        stress = 6 * moment * force / (h * h) * (1 - 2 * row / h)
        self.assertAlmostEqual(float(first["value"]) / stress, 0.91, delta=0.03)  # softened by the damage at localisation
        self.assertLess(float(first["r"]), b + h)
        self.assertLess(float(first["z"]), row)


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def slope(series, begin, end):
    """Mean slope of a time series between its points next to two times."""
    (t0, y0), (t1, y1) = (min(series, key=lambda point: abs(point[0] - t)) for t in (begin, end))
    return (y1 - y0) / (t1 - t0)


if __name__ == "__main__":
    unittest.main()
