"""The quick trade: orders, errors that fall with tolerances, references that agree where they can."""
import math
import unittest

from support import StudyTest


class Trade(StudyTest):
    study = "trade"

    def setUp(self):
        rows = self.table("work-precision", ["problem", "shape", "family", "tightness", "local", "seconds", "rhs", "velocity", "own velocity",
                                             "time of first localisation", "kinetic energy of the plate"])
        self.rows = {(row["problem"], row["family"], row["tightness"]): row for row in rows if row["local"] == "closed-form"}
        self.local = [row for row in rows if row["local"] != "closed-form"]

    def test_files(self):
        self.assert_figures("work-precision-impact", "work-precision-onset", "quantities-onset", "quantities-failure", "tolerance", "divergence", "local")
        self.assert_page("Recommendations", "How far the references agree", "reference case to 2 µs", "one run each")
        self.assert_page_does_not_state("150 µs", "median of", "gimp", "at never")

    def test_fixed_steps_are_of_order_one(self):
        for scheme in ("usf", "musl"):
            errors = [self.rows["impact", scheme, step]["velocity"] for step in (1.25e-8, 6.25e-9)]
            self.assertAlmostEqual(math.log2(errors[0] / errors[1]), 1.0, delta=0.2)

    def test_errors_fall_with_the_tolerance(self):
        for order in (3, 4):
            errors = [self.rows["impact", f"erk{order}", rtol]["velocity"] for rtol in (1e-2, 1e-4, 1e-6)]
            self.assertTrue(errors[0] > 2 * errors[1] > 8 * errors[2], errors)
            rhs = [self.rows["impact", f"erk{order}", rtol]["rhs"] for rtol in (1e-2, 1e-4, 1e-6)]
            self.assertTrue(rhs[0] <= rhs[1] < rhs[2], rhs)
        own = [self.rows["impact", "dirk3", rtol]["own velocity"] for rtol in (1e-2, 1e-4)]
        self.assertLess(own[1], 0.2 * own[0])

    def test_adaptive_beats_fixed_steps_on_smooth_motion(self):
        fixed = min(row["velocity"] for key, row in self.rows.items() if key[0] == "impact" and key[1] in ("usf", "musl"))
        self.assertLess(self.rows["impact", "erk4", 1e-6]["velocity"], 0.01 * fixed)

    def test_references(self):
        rows = {(row["problem"], row["quantity"]): row["difference"] for row in self.table("references", ["problem", "shape", "quantity", "difference"])}
        self.assertLess(rows["impact", "velocity"], 1e-6)
        self.assertLess(rows["onset", "velocity"], 1e-3)
        # Fragmentation: two references part.
        self.assertGreater(rows["failure", "velocity"], rows["onset", "velocity"])

    def test_local_tolerance_finds_localisation(self):
        substep = next(row for row in self.local if row["problem"] == "onset")
        self.assertLess(substep["time of first localisation"], self.rows["onset", "musl", 5e-8]["time of first localisation"])

    def test_recommendations(self):
        rows = self.table("recommendations", ["problem", "quantity", "level", "cheapest", "achieved", "cheapest fixed step"])
        for row in rows:
            if row["achieved"] is not None:
                self.assertLessEqual(row["achieved"], row["level"])
        tight = next(row for row in rows if row["problem"].startswith("Smooth") and row["quantity"] == "velocity" and row["level"] == 0.001)
        self.assertIn("ERK", tight["cheapest"])


if __name__ == "__main__":
    unittest.main()
