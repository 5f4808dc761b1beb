"""The quick sensitivity study: members differ by rounding, ensembles by a setting, and both show."""
import unittest

from support import StudyTest


class Sensitivity(StudyTest):
    study = "sensitivity"

    def test_files(self):
        self.assert_figures("step", "nodes", "tolerance", "readings", "fragments", "spread")
        self.assert_page("Robust", "Question by question")

    def test_members(self):
        rows = self.table("members", ["ensemble", "member", "status", "first_time", "separated_mass", "outermost_radius", "cylinder_velocity", "fragments", "perforated"])
        self.assertEqual({row["status"] for row in rows}, {"complete"})
        for ensemble in {row["ensemble"] for row in rows}:
            members = [row for row in rows if row["ensemble"] == ensemble]
            self.assertEqual([row["member"] for row in members], [1.0, 2.0, 3.0])
            # Whatever rounding does, the cylinder hardly slows down and the plate breaks when it is touched.
            for row in members:
                self.assertTrue(-200.0 < row["cylinder_velocity"] < -150.0)
                self.assertLess(abs(row["first_time"]), 3e-6)

    def test_steps_onto_nodes_leave_the_choice_to_rounding(self):
        rows = self.table("spread", ["run", "time", "median", "least", "most"])
        last = {row["run"]: row["median"] for row in rows}
        on, off = last["MUSL 0.05 µs, landing on nodes"], last["MUSL 0.0493 µs"]
        self.assertGreater(on, 1e-3)
        self.assertLess(off, 1e-6)
        self.assertGreater(off, 1e-16)  # the perturbation is there

    def test_statistics(self):
        for row in self.table("ensembles", ["ensemble", "quantity", "n", "median", "p05", "p95", "median_low", "median_high"]):
            if row["n"]:
                self.assertTrue(row["p05"] <= row["median"] <= row["p95"])
                self.assertTrue(row["median_low"] <= row["median"] <= row["median_high"])
        verdicts = {row["prediction"]: row["verdict"] for row in self.table("robustness", ["prediction", "scatter", "resolved", "verdict"])}
        self.assertEqual(verdicts["velocity of the cylinder"], "robust")


if __name__ == "__main__":
    unittest.main()
