"""decohesion.separated = "removed": told in tables and summary, and resumed to the bit."""
import csv
import unittest

import h5py
import numpy as np
from support import CommandLineTest, impact, overrides, read_summary

removed = overrides(material__glass__decohesion__separated='"removed"')


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Removed(CommandLineTest):
    def test_what_has_gone_is_told(self):
        out = self.run_scene("out", *removed)
        summary, rows = read_summary(out), rows_of(out / "removed.csv")
        plate = summary["bodies"]["plate"]
        self.assertGreater(len(rows), 10)
        self.assertEqual({row["body"] for row in rows}, {"plate"})
        self.assertEqual(len({row["particle"] for row in rows}), len(rows))
        self.assertEqual(plate["removed"], len(rows))
        self.assertEqual(plate["removed"], plate["separated"])
        mass = np.array([float(row["mass"]) for row in rows])
        speed = np.array([[float(row["velocity_r"]), float(row["velocity_z"])] for row in rows])
        self.assertAlmostEqual(plate["removed_mass"] / mass.sum(), 1.0, 12)
        self.assertAlmostEqual(summary["energy"]["removed"] / (0.5 * mass @ (speed ** 2).sum(axis=1)), 1.0, 9)
        energy = rows_of(out / "energy.csv")
        self.assertEqual(list(energy[-1])[-1], "removed")
        self.assertEqual(float(energy[-1]["removed"]), summary["energy"]["removed"])
        with h5py.File(out / "result.h5") as result:
            whole = result["particles/mass"][:][result["particles/body"][:] == 0].sum()
            last = list(result["steps"].values())[-1]["particles"]
            for row in rows:  # particles of the first body: their number is their row
                self.assertEqual(list(last["position"][int(row["particle"])]), [float(row["r"]), float(row["z"])])
                self.assertEqual(list(last["velocity"][int(row["particle"])]), [0.0, 0.0])
        self.assertAlmostEqual((plate["mass"] + plate["removed_mass"]) / whole, 1.0, 12)

    def test_nothing_of_it_in_other_scenes(self):
        out = self.run_scene("out")
        self.assertFalse((out / "removed.csv").exists())
        self.assertNotIn("removed", rows_of(out / "energy.csv")[0])
        self.assertNotIn("removed", read_summary(out)["energy"])
        self.assertNotIn("removed", read_summary(out)["bodies"]["plate"])

    def test_same_for_any_threads_and_after_a_resumption(self):
        for method, contact in (('"explicit"', '"single"'), ('"explicit"', '"bodies"'),
                                ('"arkode-explicit"', '"single"'), ('"arkode-implicit"', '"bodies"')):
            with self.subTest(method=method, contact=contact):
                settings = [*removed, *overrides(output__checkpoint_every=7e-6, integrator__method=method, integrator__rtol=1e-2,
                                                 contact__method=contact, time__end=12e-6)]
                name = f"{method[1:-1]} {contact[1:-1]}"
                one, two = (self.run_scene(f"{name} {n}", *settings, "--threads", n) for n in (1, 2))
                self.assertGreater(read_summary(one)["bodies"]["plate"]["removed"], 0)
                self.assert_same_results(one, two)
                self.vitrum("run", impact, "--out", one, *settings, "--resume")  # from 7 us
                self.assert_same_results(one, two)

    def test_friction_of_what_is_gone_is_refused(self):
        told = self.vitrum("run", impact, *removed, *overrides(material__glass__decohesion__friction=0.2), status=2).stderr
        self.assertRegex(told, r"material\.glass\.decohesion\.friction.*nothing else rubs")


if __name__ == "__main__":
    unittest.main()
