"""The quick study of space: settings differ by more than rounding, and what it says of convergence holds of sequences whose limit is known."""
import sys
import unittest

from support import StudyTest, source


class Space(StudyTest):
    study = "space"

    def test_files(self):
        self.assert_figures("contact", "particles")
        self.assert_page("Particles a cell", "Over the cells", "to 4 µs")
        self.assert_page_does_not_state("Richardson", "60 µs")

    def test_members(self):
        rows = self.table("members", ["setting", "cell", "member", "first_time", "crack_area", "localised_volume", "fracture", "cylinder_velocity", "residual"])
        self.assertEqual({row["setting"] for row in rows}, {"single", "base", "per-cell-4"})
        first = {setting: [row["first_time"] for row in rows if row["setting"] == setting] for setting in ("single", "base")}
        # One field joins the bodies before they touch; fields of their own do not.
        self.assertLess(max(first["single"]), 0.0)
        self.assertGreater(min(first["base"]), 0.0)
        for row in rows:
            self.assertGreater(row["crack_area"], 0.0)
            self.assertLess(abs(row["residual"]), 0.02)

    def test_convergence(self):
        sys.path.insert(0, str(source / "studies"))
        from space.measures import convergence, statistics
        of = [statistics([value]) for value in (3.0, 2.25, 2.0625)]  # 2 + h^2
        order, limit, verdict = convergence(of)
        self.assertEqual((order, limit, verdict), (2.0, 2.0, "converges"))
        self.assertEqual(convergence([statistics([value]) for value in (1.0, 2.0, 4.0)])[2], "no limit seen")
        falling = [statistics([value]) for value in (6.0, 3.0, 1.1)]
        self.assertEqual(convergence(falling)[2], "converges")
        self.assertEqual(convergence(falling, signed=False), (None, 0.0, "vanishes"))
        self.assertEqual(convergence([statistics([1.0, 1.2]), statistics([1.0, 1.3]), statistics([0.9, 1.2])])[2], "within its scatter")
        self.assertEqual(convergence(of[:2])[2], "–")


if __name__ == "__main__":
    unittest.main()
