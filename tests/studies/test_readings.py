"""The quick study of readings: every reading of its array runs under two integrations and is judged; what the report says of verdicts holds of verdicts that are made up."""
import json
import pathlib
import re
import sys
import tempfile
import unittest

import numpy as np
from support import StudyTest, source

sys.path.insert(0, str(source / "studies"))
from readings import analysis  # noqa: E402
from readings.cases import cases_of, points, reference, rows_of_design  # noqa: E402
from readings.design import all_pairs, covering_array, pairs_of  # noqa: E402
from readings.factors import by_key, counts, factors  # noqa: E402


class Readings(StudyTest):
    study = "readings"

    def test_files(self):
        self.assert_figures("matrix", "effects")
        self.assert_page("Statement by statement", "The fewest departures", "What the paper would have had to print", "a lead, not a finding")
        self.assert_page_does_not_state("R = 400 mm", "full factorial", "six members")

    def test_verdicts(self):
        rows = self.table("verdicts", ["part", "integration", "statement", "verdict", "found", "made", *[factor.key for factor in factors]])
        # What 40 us tell: first localisation (S2, S10), and the front of any damage up to 30 us (S6b); of every point.
        judged = {row["statement"] for row in rows if row["verdict"] != "\u2013"}
        self.assertLessEqual({"S6b", "S10"}, judged)
        self.assertEqual(len({(row["part"], row["integration"], row["member"], *[row[factor.key] for factor in factors]) for row in rows}), len(points(True)))
        base = {row["statement"]: row for row in rows if row["part"] == "design" and row["integration"] == "resolved"
                and all(row[factor.key] == factor.levels[0].label for factor in factors)}
        self.assertEqual(base["S10"]["verdict"], "yes")
        self.assertEqual(base["S6b"]["verdict"], "yes")
        self.assertLess(abs(base["S10"]["made"]), 0.01)
        # Readings differ in what they say.
        self.assertGreater(len({row["found"] for row in rows if row["statement"] == "S6b" and row["integration"] == "resolved"}), 1)


class Design(unittest.TestCase):
    def test_every_pair_and_balance(self):
        rows = covering_array(counts, rows_of_design)
        self.assertEqual(set().union(*map(pairs_of, rows)), all_pairs(counts))
        self.assertEqual(len(rows), rows_of_design)
        self.assertEqual(rows[0], reference)
        self.assertEqual(rows, covering_array(counts, rows_of_design))
        for factor, count in enumerate(counts):
            used = [sum(row[factor] == level for row in rows) for level in range(count)]
            self.assertLessEqual(max(used) - min(used), 2)

    def test_what_a_separated_point_bears_is_all_that_a_scene_can_say(self):
        choices = re.search(r"^\| `separated` \| one of ([^|]*) \|", (source / "docs/reference/scene.md").read_text(encoding="utf-8"), re.M)[1]
        key = "material.glass.decohesion.separated"
        tried = [dict(level.settings)[key] for level in by_key["separated"].levels if key in dict(level.settings)]
        self.assertEqual(['"faces"', *(f'"{each}"' for each in tried)], choices.split(", "))  # faces: the reference

    def test_points_are_named_once_and_differ(self):
        for quick in (False, True):
            names = [point.name for point in points(quick)]
            self.assertEqual(len(names), len(set(names)))
        settings = [tuple(sorted((key, str(value)) for key, value in case.settings.items() if key != "title")) for point in points(False)
                    if point.part == "design" for case in cases_of(point, False).values()]
        self.assertEqual(len(settings), len(set(settings)))


class Stopped(unittest.TestCase):
    def test_nothing_is_said_of_a_run_that_was_stopped(self):
        from readings import study

        class Outcome:
            summary = None

        keep, study.compute = study.compute, lambda case, runs: Outcome()
        try:
            with tempfile.TemporaryDirectory() as folder:
                point = points(True)[0]
                study.run(point.name, True, pathlib.Path(folder))
                verdicts = json.loads((pathlib.Path(folder) / "verdicts" / f"{point.name}.json").read_text())
        finally:
            study.compute = keep
        self.assertEqual({each["verdict"] for each in verdicts.values()}, {"\u2013"})
        self.assertFalse(any(study.hit(each, True) for each in verdicts.values()))


class Analysis(unittest.TestCase):
    def test_a_planted_effect_is_found_and_noise_is_not(self):
        rows = np.array(covering_array(counts, rows_of_design))
        random = np.random.default_rng(3)
        planted = (rows[:, 3] == 1).astype(float)
        noise = random.integers(0, 2, (4, len(rows))).astype(float)
        effects = analysis.main_effects(np.vstack([planted, noise]), rows)
        self.assertEqual(effects[0, 3]["share"], 1.0)
        self.assertEqual(effects[0, 3]["levels"], [0.0, 1.0])
        found = {key for key, effect in effects.items() if effect["p"] <= 0.05}
        self.assertEqual(found, {(0, 3)})

    def test_shares(self):
        reading = np.array([[1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 0.0]])
        self.assertEqual(analysis.shares(reading, reading[:, 1], 1), {"reading": 1.0, "integration": 0.0, "together": 0.0, "chance": 0.0})
        self.assertEqual(analysis.shares(reading.T, reading.T[:, 1], 1)["integration"], 1.0)
        both = np.array([[1.0, 0.0], [0.0, 1.0]])
        self.assertEqual(analysis.shares(both, both[:, 1], 1)["together"], 1.0)
        self.assertEqual(analysis.shares(both, 1.0 - both[:, 1], 1)["chance"], 1.0)
        self.assertIsNone(analysis.shares(np.zeros((3, 2)), np.zeros(3), 1))

    def test_what_a_hit_among_many_is_worth(self):
        random = np.random.default_rng(5)
        scattered = random.random((20, 100)) < 0.2
        best, expected, chance = analysis.best_by_chance(scattered)
        self.assertLess(abs(best - expected), 3.0)
        self.assertGreater(chance, 0.02)
        gathered = scattered.copy()
        gathered[:, 0] = True
        self.assertLess(analysis.best_by_chance(gathered)[2], 0.01)

    def test_fewest_departures_and_cover(self):
        self.assertEqual(analysis.frontier([(0, 3, "a"), (1, 2, "b"), (1, 5, "c"), (3, 5, "d"), (4, 6, "e")]), [(0, 3, "a"), (1, 5, "c"), (4, 6, "e")])
        hits = np.array([[1, 0, 0], [1, 1, 0], [0, 0, 1], [0, 0, 0]], bool)
        self.assertEqual(analysis.cover(hits), [(0, [0, 1]), (2, [2])])

    def test_doctests(self):
        import doctest
        from readings import design
        for module in (analysis, design):
            self.assertEqual(doctest.testmod(module).failed, 0)


if __name__ == "__main__":
    unittest.main()
