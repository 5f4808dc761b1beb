"""summary.json: every key of the interface with its type; and energy.csv."""
import unittest

import numpy as np
from support import CommandLineTest, here, impact, overrides, plane_strain, read_csv, read_summary

pulverised = here / "scenes" / "pulverised.toml"
number, integer, text, boolean, listing, anything = (float, int), int, str, bool, list, object
nothing = type(None)


def or_null(*types):
    return (*types, nothing)


first = {"time": number, "r": number, "z": number, "body": text}
body = {"particles": integer, "mass": number, "momentum": listing, "centre": listing, "kinetic": number, "localised": integer,
        "separated": integer}
interface = {
    "status": text, "message": or_null(str), "warnings": listing, "time": number, "particles": integer, "wall_seconds": number, "total_seconds": number, "threads": integer,
    "integrator": {"method": text, "steps": integer, "rejected": integer, "rhs_evaluations": integer,
                   "newton_iterations": integer, "factorisations": integer, "factor_entries": integer, "step_min": number, "step_max": number,
                   "limited_by": {"stability": integer, "accuracy": integer, "output": integer}},
    "constitutive": {"method": text, "evaluations": integer, "cvode_solves": integer, "cvode_steps": integer,
                     "cvode_rhs": integer, "failures": integer, "events": integer},
    "energy": dict.fromkeys(("initial", "kinetic", "elastic", "plastic", "damage", "fracture", "contact", "friction", "filtered", "ringing", "external", "residual",
                             "relative_residual", "max_growth"), number),
    "failure": {"first_damage": first, "first_localisation": first, "first_separation": first, "localised": integer,
                "separated": integer, "crack_area": number, "localised_volume": number, "localised_radius_max": number, "damage_front_radius": number, "max_opening": number,
                "max_opening_radius": number, "perforated": boolean, "fragments": {"count": integer, "largest_mass": number}},
    "bodies": {"plate": body, "cylinder": body},
    "provenance": dict.fromkeys(("version", "git", "command", "sundials", "compiler", "host", "started", "scene_sha256"), text),
}


class Summary(CommandLineTest):
    def assert_shape(self, found, expected, path=""):
        for key, kind in expected.items():
            self.assertIn(key, found, path)
            if isinstance(kind, dict):
                self.assertIsInstance(found[key], dict, f"{path}.{key}")
                self.assert_shape(found[key], kind, f"{path}.{key}")
            else:
                self.assertIsInstance(found[key], kind, f"{path}.{key}")

    def test_every_key_has_its_type(self):
        summary = read_summary(self.run_scene("out"))
        self.assert_shape(summary, interface)
        self.assertEqual((summary["status"], summary["message"]), ("complete", None))
        self.assertEqual(summary["time"], 20e-6)
        self.assertEqual(summary["integrator"]["steps"], 1000)
        self.assertEqual(summary["integrator"]["method"], "explicit")
        # (Bodies coast until they meet.)
        self.assertLess(summary["constitutive"]["evaluations"], 200 * 1000)
        self.assertGreater(summary["constitutive"]["evaluations"], 100 * 1000)
        self.assertEqual(summary["bodies"]["plate"]["particles"] + summary["bodies"]["cylinder"]["particles"], 200)
        self.assertEqual(len(summary["provenance"]["scene_sha256"]), 64)
        self.assertRegex(summary["provenance"]["started"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")

    def test_bodies_add_up(self):
        summary = read_summary(self.run_scene("out"))
        bodies, failure = summary["bodies"].values(), summary["failure"]
        self.assertAlmostEqual(sum(b["kinetic"] for b in bodies), summary["energy"]["kinetic"], delta=1e-9)
        for count in ("localised", "separated"):
            self.assertEqual(sum(b[count] for b in bodies), failure[count])
        self.assertLessEqual(failure["separated"], failure["localised"])
        self.assertGreater(failure["crack_area"], failure["localised_volume"] / 1e-3)  # L_e is at most the cell
        self.assertLessEqual(failure["first_localisation"]["time"], failure["first_separation"]["time"])
        self.assertGreater(failure["fragments"]["count"], 0)

    def test_null_where_nothing_happened(self):
        out = self.run_scene("out", scene=plane_strain)
        failure = read_summary(out)["failure"]
        for key in ("first_damage", "first_localisation", "first_separation", "localised_radius_max", "damage_front_radius",
                    "max_opening", "max_opening_radius", "perforated"):
            self.assertIsNone(failure[key], key)
        self.assertEqual([failure[key] for key in ("localised", "separated", "crack_area", "localised_volume")], [0, 0, 0, 0])

    def test_a_projectile_through_a_target_of_which_nothing_is_left(self):
        failure = read_summary(self.run_scene("out", "--no-fields", scene=pulverised))["failure"]
        self.assertNotIn("plate", [fragment["body"] for fragment in failure["fragments"]["list"]])
        self.assertIs(failure["perforated"], True)
        early = read_summary(self.run_scene("early", "--no-fields", *overrides(time__end=10e-6), scene=pulverised))
        self.assertIs(early["failure"]["perforated"], False)

    def test_a_step_limited_by_stability(self):
        integrator = read_summary(self.run_scene("out", scene=plane_strain))["integrator"]
        limited = integrator["limited_by"]
        self.assertGreater(limited["stability"], limited["output"])
        self.assertEqual(sum(limited.values()), integrator["steps"])
        self.assertLess(integrator["step_min"], integrator["step_max"])

    def test_warnings_are_those_told(self):
        for quiet in ((), ("--quiet",)):
            done = self.vitrum("run", impact, "--out", self.folder / "out", "--force", *quiet,
                               *overrides(integrator__scheme='"usl"', time__end=1e-7))
            told = [line.removeprefix("warning: ") for line in done.stderr.splitlines() if line.startswith("warning: ")]
            self.assertEqual(read_summary(self.folder / "out")["warnings"], told)
            self.assertRegex(told[0], r"^--set 1: key 'integrator\.scheme': ")

    def test_overrides_reach_the_run(self):
        summary = read_summary(self.run_scene("out", *overrides(body__1__velocity__1=-100.0, time__end=1e-6)))
        # A cylinder of 20 mm, radius 5 mm.
        mass = 7800 * np.pi * 0.005**2 * 0.020
        self.assertAlmostEqual(summary["energy"]["initial"], 0.5 * mass * 100.0**2, delta=1e-9 * 100.0**2)
        self.assertEqual(summary["time"], 1e-6)


class EnergyAccount(CommandLineTest):
    def test_residual_is_what_is_missing(self):
        for name, arguments in (("impact", {}), ("plane", {"scene": plane_strain})):
            out = self.run_scene(name, **arguments)
            rows, energy = read_csv(out / "energy.csv"), read_summary(out)["energy"]
            self.assertEqual(list(rows), ["time", "step", "kinetic", "elastic", "plastic", "damage", "fracture", "external",
                                          "residual", "contact", "friction", "filtered"])
            initial = rows["kinetic"][0] + rows["elastic"][0]
            accounted = sum(rows[share] for share in ("kinetic", "elastic", "plastic", "damage", "fracture", "contact", "friction"))
            np.testing.assert_allclose(rows["residual"], initial + rows["external"] - accounted, atol=1e-12 * initial)
            self.assertTrue(np.all(np.diff(rows["step"]) > 0) and np.all(np.diff(rows["time"]) > 0))
            for share in ("plastic", "damage", "fracture"):
                self.assertTrue(np.all(np.diff(rows[share]) >= -1e-12 * initial), share)
            for name, column in rows.items():
                if name in energy:
                    self.assertEqual(column[-1], energy[name], name)
            self.assertEqual(initial, energy["initial"])
            self.assertLess(abs(energy["relative_residual"]), 0.02)


if __name__ == "__main__":
    unittest.main()
