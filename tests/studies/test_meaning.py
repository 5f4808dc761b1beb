"""What a study says of its runs, of runs that are made up: scales, rungs that are a reference, runs that were stopped, what they failed of."""
import json
import pathlib
import tempfile
import types
import unittest
from unittest import mock

from support import blocks, source
from own import page
from study import bars, ladders, outcome, plan, results
from study.case import Case
from study.file import Quantity
from study.tables import read_csv


class Told(results.Study):
    """A study whose runs are told: name -> (case, value of `q`, what else its summary has); None: failed."""

    def __init__(self, runs, quantity=Quantity("q", "q.x")):
        self.plan = {"quantities": [vars(quantity)], "converged": 0.01, "points": []}
        self.cases = {name: {"run": name, **case} for name, (case, _) in runs.items()}
        self.told = {name: value for name, (_, value) in runs.items()}

    def outcome(self, name):
        failed = self.told[name] is None
        return types.SimpleNamespace(complete=not failed, status="failed" if failed else "complete", message="warning: x\nerror: max_growth is exceeded" if failed else "", repeats=lambda: [])

    def summary(self, name):
        value, speed = self.told[name] if isinstance(self.told[name], tuple) else (self.told[name], 50.0)
        if value is None:
            return None
        integrator = {"steps": 10, "method": "arkode-explicit", "error_estimate": None, "rejected": 0, "rhs_evaluations": 30, "limited_by": {"stability": 4}}
        return {"q": {"x": value}, "speed": speed, "wall_seconds": 1.0, "energy": {"initial": 1.0, "external": 0.0, "relative_residual": 0.0}, "integrator": integrator}

    def scene_of(self, name):
        return {"time": {"start": 0.0, "end": 1.0}, "body": [{"velocity": [0.0, self.summary(name)["speed"]]}]}

    def field_difference(self, name, other):
        return None


class Scales(unittest.TestCase):
    def test_what_is_zero_in_a_run_is_measured_by_the_largest_of_all(self):
        study = Told({"base": ({"role": "base"}, 0.0), "other": ({"role": "refined"}, -4.0), "more": ({"role": "refined"}, 1.0)})
        quantity = study.quantities[0]
        self.assertEqual(study.scale("base", quantity), 4.0)
        self.assertEqual(study.difference("more", "base", quantity), 0.25)
        self.assertEqual(study.scale("more", quantity), 1.0)

    def test_a_point_has_its_own_scale(self):
        study = Told({"slow": ({"role": "point"}, (1.0, 20.0)), "fast": ({"role": "point"}, (1.0, 80.0))}, Quantity("q", "q.x", unit="m/s"))
        self.assertEqual([study.scale(name, study.quantities[0]) for name in ("slow", "fast")], [20.0, 80.0])


class Trade(unittest.TestCase):
    def test_a_rung_that_is_the_reference_is_measured_against_the_other(self):
        study = Told({"first": ({"role": "reference"}, 1.0), "second": ({"role": "reference"}, 1.1), "loose": ({"role": "ladder", "method": "m", "setting": "0", "rung": 0}, 1.5),
                      "tight": ({"role": "ladder", "method": "m", "setting": "1", "rung": 1, "run": "first"}, 1.0)})
        found = {row["rung"]: row for row in ladders.trade_rows(study) if row["quantity"] == "q"}
        self.assertAlmostEqual(found[0]["error"], 0.5)
        self.assertAlmostEqual(found[1]["error"], 0.1 / 1.1)


class ErrorBars(unittest.TestCase):
    def test_runs_that_failed_are_told(self):
        runs = {"base": ({"role": "base"}, 1.0), "cell": ({"role": "refined", "effort": "half the cell", "kind": "space"}, None), "m1": ({"role": "member"}, 1.0), "m2": ({"role": "member"}, None)}
        (_, row), = bars.bar_rows(Told(runs))
        self.assertEqual(row["verdict"], "half the cell failed: error: max_growth is exceeded (and 1 more)")

    def test_an_idle_tolerance_is_told(self):
        study = Told({"base": ({"role": "base"}, 1.0), "finer": ({"role": "refined", "effort": "a tenth of the tolerance", "kind": "time"}, 1.0)})
        self.assertEqual(list(page._idle(study)), [f"{what}: the tolerance was idle in 40 % of the steps, which stability limited" for what in ("the scene as it is", "a tenth of the tolerance")])


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_outputs_are_those_of_the_scene_and_the_second_ensemble_has_members_of_its_own(self):
        path = self.folder / "study.toml"
        path.write_text(f'scene = "{blocks}"\n[report]\nkinds = ["error-bars"]\n')
        made = {"key": "", **plan.make(path, True)}
        self.assertNotIn("output.every", plan.case(made, "base").settings)
        seeds = [case["settings"]["body.0.perturbation"]["seed"] for case in made["cases"].values() if case["role"] == "member"]
        self.assertEqual(len(set(seeds)), 8)

    def test_a_run_that_was_stopped_is_made_again_when_it_may_take_longer(self):
        with mock.patch.object(outcome, "_stamp", lambda case: {}):
            (self.folder / "slow").mkdir()
            (self.folder / "slow/outcome.json").write_text(json.dumps({"status": "too-long", "message": "", "seconds": 10.1}))
            self.assertIsNotNone(outcome.kept(Case("slow", "x.toml", longest=10.0), self.folder))
            self.assertIsNone(outcome.kept(Case("slow", "x.toml", longest=20.0), self.folder))

    def test_units_and_the_command_stand_beside_numbers_and_in_pictures(self):
        study = Told({"base": ({"role": "base"}, 1.0)}, Quantity("q", "q.x", unit="J"))
        study.out, study.plan = self.folder, {**study.plan, "key": "", "file": "/mine/mine.toml"}
        sheet = page.Sheet(study, True, True)
        page._units(sheet)
        self.assertEqual([row["unit"] for row in read_csv(self.folder / "tables/units.csv") if row["column"] == "q"], ["J"])
        sheet.figure("f", lambda: page.plt.figure())
        from vitrum.plot import stamp
        self.assertEqual(stamp.read(self.folder / "figures/f.png")["vitrum-command"], "vitrum-study /mine/mine.toml --quick")


class Package(unittest.TestCase):
    def test_the_report_comes_with_the_package(self):
        import vitrum
        self.assertTrue(callable(vitrum.report.page))
        self.assertEqual(pathlib.Path(vitrum.__file__).resolve().parent, source / "studies/vitrum")


if __name__ == "__main__":
    unittest.main()
