"""The quick stability study: limits as theory says, growth in travel, energy, extremes that end well or say why."""
import unittest

from support import StudyTest


class Stability(StudyTest):
    study = "stability"

    def test_files(self):
        self.assert_figures("limits", "growth", "energy")
        self.assert_page("Largest stable step", "Extremes", "to 30 µs")
        self.assert_page_does_not_state("gimp", "bspline2", "Runs with USL", "quick study)")

    def test_limits(self):
        rows = self.table("limits", ["scheme", "shape", "particles_per_cell", "offset", "theory", "measured", "deviation"])
        found = {(row["scheme"], row["offset"]): row for row in rows}
        self.assertEqual(len(found), 6)
        for key, row in found.items():
            self.assertLess(abs(row["deviation"]), 0.01, key)
        for scheme, offset, limit in (("usf", 0.5, 2.0), ("musl", 0.1, 1.25), ("usl", 0.5, 0.7071)):
            self.assertAlmostEqual(found[scheme, offset]["theory"], limit, delta=1e-3)

    def test_growth(self):
        rows = self.table("travel", ["scheme", "speed", "step_us", "theory", "measured"])
        growth = {(row["speed"], round(row["step_us"], 3)): row for row in rows}
        for speed in {row["speed"] for row in rows}:
            theory, measured = ([growth[speed, step][which] for step in (0.05, 0.1, 0.2)] for which in ("theory", "measured"))
            self.assertTrue(1.0 < theory[0] < theory[1] < theory[2])
            self.assertTrue(1.0 < measured[0] < measured[1] < measured[2])
            # The worst wave of an endless row bounds a short one, but for the scatter of a fit.
            for one, bound in zip(measured, theory):
                self.assertLess(one, 1.2 * bound)

    def test_energy(self):
        made = {(row["scheme"], row["setting"]): row["made"] for row in self.table("energy", ["scheme", "setting", "status", "max_growth", "made"])}
        for scheme in ("usf", "musl"):
            self.assertGreater(made[scheme, 2e-7], 0.05)
            self.assertLess(abs(made[scheme, 5e-8]), 0.005)
        self.assertLess(abs(made["erk3", 1e-2]), 0.01)

    def test_extremes(self):
        rows = {row["extreme"]: row for row in self.table("extremes", ["extreme", "status", "message"])}
        unstable = rows.pop("three times the critical step")
        self.assertEqual(unstable["status"], "failed")
        self.assertIn("integrator.max_growth", unstable["message"])
        for what, row in rows.items():
            self.assertEqual(row["status"], "complete", what)


if __name__ == "__main__":
    unittest.main()
