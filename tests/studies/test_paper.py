"""The quick study of the paper's cases: files, columns, and what a resolved step must show beside the paper's."""
import sys
import types
import unittest

import numpy as np
from support import StudyTest, source

sys.path.insert(0, str(source / "studies"))
from paper.history import History  # noqa: E402


class Paper(StudyTest):
    study = "paper"

    def test_files(self):
        self.assert_figures("space-time-R200-v200", "energy-R200-v200", "fronts", "R200-v200-b-snapshots", "R200-v200-b-damage", "R200-v200-b-cracks", "R200-v200-b-fragments", "R200-v200-b-fragment-masses",
                            "R200-v200-alternative-b-snapshots", "R200-v200-alternative-b-damage", "R200-v200-alternative-b-opening", "R200-v200-alternative-b-cracks")
        self.assert_page("no fragmentation occurs at time t = 50", "Sentence by sentence", "Two readings side by side", "material.glass.drucker_prager.flow", "They end at 60 µs", "up to 60 µs", "2 of its nine cases",
                         "A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method")
        self.assert_page_does_not_state("600 µs.", "R = 400 mm", "The nine cases", "CVODE")

    def test_cases(self):
        rows = {(row["speed"], row["treatment"]): row for row in
                self.table("cases", ["radius_mm", "status", "max_growth", "residual", "first_decohesion_us", "front_speed", "perforated"])}
        self.assertEqual(len(rows), 18)  # five treatments of the reference reading and four of the alternative, at two speeds
        for speed in (200.0, 800.0):
            for resolved in ("b", "c-1e-2"):
                row = rows[speed, resolved]
                self.assertEqual(row["status"], "complete")
                self.assertLess(abs(row["residual"]), 0.02)
                self.assertLess(row["max_growth"], 1.01)
                # The plate breaks as soon as it is hit, not after 70 us.
                self.assertLess(abs(row["first_decohesion_us"]), 3.0)
                # The step of 0.2 us makes energy; what resolves the wave does not.
                for unresolved in ("a-usf", "a-musl"):
                    self.assertGreater(abs(rows[speed, unresolved]["residual"]), 5.0 * abs(row["residual"]))
                    self.assertGreater(rows[speed, unresolved]["max_growth"], row["max_growth"])
            self.assertLess(rows[speed, "b"]["front_speed"], 5543.0)
        self.assertEqual(rows[800.0, "b"]["perforated"], "True")

    def test_sentences(self):
        rows = {row["sentence"]: row for row in self.table("sentences", ["sentence", "text", "criterion", "a-usf", "b", "b found", "b energy made", "overall"])}
        self.assertEqual(len(rows), 25)  # twenty, five of them in two readings
        self.assertEqual(rows["S1"]["overall"], "not reproduced")  # there are fragments at 50 us
        self.assertEqual(rows["S9"]["b"], "yes")  # perforation at 800 m/s
        self.assertEqual(rows["S15"]["overall"], "undecided")  # R = 400 mm is not in the quick study
        self.assertEqual(rows["S15"]["turns with"], "\u2013")
        self.assertEqual(rows["S9"]["alternative-b"], "yes")
        self.assertEqual(rows["S9"]["turns with"], "undecided")  # cells are not in the quick study


class Fronts(unittest.TestCase):
    def test_one_crack_is_severe_in_cells_of_any_size(self):
        for cell in (1e-3, 0.5e-3, 0.25e-3):
            x, y = (values.ravel() for values in np.meshgrid(np.arange(0.5 * cell, 0.05, cell), np.arange(0.5 * cell, 5e-3, cell)))
            for columns, reached in ((1, 0.025), (0, 0.0)):
                cracked = np.abs(x - 0.0223) < (0.5 * cell if columns else -1.0)
                frame = types.SimpleNamespace(time=0.0, position=np.stack([x, y], axis=1), separated=lambda cracked=cracked: cracked,
                                              field=lambda name, cracked=cracked: np.where(cracked, 0.2, 0.0), opening=lambda: None)
                run = types.SimpleNamespace(body=np.zeros(x.size, int), bodies=["plate"], frames=[frame], cell=cell)
                history = History(types.SimpleNamespace(results=run))
                self.assertEqual(history.outermost_severe(0.0), reached)
                self.assertEqual(history.damage_front[-1], reached)


if __name__ == "__main__":
    unittest.main()
