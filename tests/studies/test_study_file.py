"""Study files: what is wrong with one and where, which runs it is made of, what quantities are, and what errors mean."""
import doctest
import json
import re
import tomllib
import unittest

import numpy as np

from support import Folder, blocks, source
from own import page
from study import bars, file, ladders, plan, progress, quantities, sweep
from study.file import Quantity
from study.outcome import StudyError


class StudyFile(Folder):
    def test_what_is_wrong_is_said_with_its_place(self):
        scene, laminate = f'scene = "{blocks}"\n', f'scene = "{source}/examples/laminate.toml"\n'
        for text, expected in (
                ("", "key 'scene' is missing"), ('scene = "no.toml"', "study.toml:1: key 'scene': found 'no.toml'"), ("scene = = 1", "line 1, column 9"),
                (scene + "[ensembles]\nmembers = 3", "study.toml:2: key 'ensembles': found an unknown key.*did you mean 'ensemble'"),
                (scene + "[ensemble]\nmembers = 1", "study.toml:3: key 'ensemble.members': found 1"), (scene + "[ensemble]\nmembers = true", "expected an integer"),
                (scene + '[vary]\n"space.cell" = 1e-3', "study.toml:3: key 'vary.space.cell': found 0.001, expected a list"),
                (scene + '[report]\nkinds = ["sweep"]', "found 'sweep', but there is no table"), (scene + '[report]\nkinds = ["bars"]', "found 'bars', expected some of trade"),
                (scene + '[[method]]\nname = "a"\nladder = {"integrator.courant" = 0.1}', "study.toml:4: key 'method.0.ladder': expected lists"),
                (scene + '[[method]]\nname = "a"\nladder = {"integrator.courant" = [0.1]}\n[[method]]\nname = "b"\nladder = {"integrator.courant" = 0.1}', "study.toml:7: key 'method.1.ladder': expected lists"),
                (scene + '[[method]]\nname = "a"\nrung = [{sett = {}}]', "study.toml:4: key 'method.0.sett': found an unknown key.*did you mean 'set'"),
                (scene + '[[method]]\nname = "a"\neach = {"integrator.order" = [2, 3]}', "study.toml:4: key 'method.0.each': .*{} in the method's name"),
                (scene + '[[method]]\nname = "a"\nquick = [1]', "study.toml:4: key 'method.0.quick': found \\[1\\], expected numbers of rungs from 0 to 0"),
                (scene + '[report]\nkinds = ["methods"]', "found 'methods', but there is no"), (scene + '[quick]\nmembers = 2.5', "expected an integer"),
                (scene + '[[method]]\nname = "a"\n[[variant]]\nname = "b"\nset = {"integrator.courant" = 0.1}', r"study.toml:4: key 'variant.0.variant': variants are of another model .*expected report.kinds = \["),
                (scene + '[[method]]\nname = "a"\n[[variant]]\nname = "b"\nset = {}\n[report]\nkinds = ["error-bars"]', "study.toml:4: key 'variant.0.variant': .*no part of other kinds"),
                (scene + '[[method]]\nname = "a"\n[[variant]]\nname = "b"\nset = {}\n[report]\nkinds = ["methods", "trade"]', "study.toml:4: key 'variant.0.variant': "),
                (scene + '[vary]\n"space.cell" = [1e-3]\n[[method]]\nname = "a"\nonly = {"space.cell" = [1e-3]}', "study.toml:6: key 'method.0.only': a trade of the scene as it is has no points, and would leave 'a' out"),
                (scene + '[[method]]\nset = {}', "has no key 'name'"), (scene + '[[method]]\nname = "a"\n[[method]]\nname = "a"', "two methods of one name"),
                (scene + '[[reference]]\nset = {}', "found 1 of \\[\\[reference\\]\\], expected two"),
                (scene + 'set = {"space.celll" = 1}', "study.toml:2: key 'set.space.celll'.*did you mean 'cell'"),
                (laminate + '[vary]\n"parameters.vv" = [1, 2]', "study.toml:3: key 'vary.parameters.vv': the scene has no such parameter, expected one of .*did you mean 'v'"),
                (laminate + '[[method]]\nname = "a"\nladder = {"parameters.w" = [2, 1]}', "study.toml:4: key 'method.0.parameters.w': the scene has no such parameter"),
                (scene + '[[method]]\nname = "a"\nladder = {"integrator.courant" = [0.1, 0.4]}', "study.toml:4: key 'method.0.integrator.courant': found .*expected values that fall"),
                (scene + 2 * '[[reference]]\nset = {"integrator.courant" = 0.1}\n', "study.toml:4: key 'reference.1.reference': found the same settings twice, expected two of different methods"),
                (scene + '[[reference]]\nname = "R"\nset = {}\n[[reference]]\nname = "R"\nset = {"integrator.courant" = 0.1}', "found two references of one name: R"),
                (scene + '[[quantity]]\nname = "a"\nfrom = "time"\nscale = -1.0', "study.toml:5: key 'quantity.0.scale': found -1.0, expected a positive number"),
                (scene + 2 * '[[quantity]]\nname = "a"\nfrom = "time"\n', "study.toml:5: key 'quantity.1.quantity': found two quantities of one name: a"),
                (scene + '[[quantity]]\nname = "steps"\nfrom = "integrator.steps"', "study.toml:3: key 'quantity.0.name': found 'steps', which is a column of the tables"),
                ("longest = 0\n" + scene, "study.toml:1: key 'longest': found 0, expected a positive number"), (scene + "[ensemble]\namplitude = -1.0", "expected a positive number"),
                (scene + "[report]\nrepeats = 0", "study.toml:3: key 'report.repeats': found 0, expected at least 1"), (scene + "[report]\nconverged = -0.1", "expected a positive number"),
                (scene + "[quick]\nmembers = 1", "study.toml:3: key 'quick.members': found 1, expected at least 2"),
                (scene + '[[method]]\nname = "a"\nrung = [{members = 0}]', "found 0, expected at least 1"),
                (scene + "[report]\nkinds = []", "study.toml:3: key 'report.kinds': found an empty list"),
                (scene + "[report]\ntrade_points = true", "study.toml:3: key 'report.trade_points': found true, but there is no table"),
                (scene + '[vary]\n"space.cell" = [1e-3]\n[quick]\nvary = {"space.cel" = [1]}', "study.toml:5: key 'quick.space.cel': found a key that does not vary, expected one of space.cell"),
                (scene + '[[method]]\nname = "a"\nonly = {"space.cell" = [1e-3]}', "study.toml:4: key 'method.0.space.cell': found a key that does not vary, expected one of none"),
                (scene + '[vary]\n"space.cell" = [1e-3]\n[[method]]\nname = "a"\nonly = {"space.cell" = [2e-3]}', "study.toml:6: key 'method.0.space.cell': .*expected a list of some of")):
            with self.subTest(expected=expected):
                with self.assertRaisesRegex(StudyError, "(?s)" + expected):
                    file.read(self.write(text))

    def test_a_quick_study_says_that_no_method_is_left(self):
        for kinds in ('["methods"]', '["trade"]', '["trade", "error-bars"]'):
            path = self.write(f'scene = "{blocks}"\n[[method]]\nname = "a"\nset = {{"integrator.courant" = 0.1}}\nquick = []\n[report]\nkinds = {kinds}')
            self.assertEqual([method.name for method in file.read(path).methods], ["a"])
            with self.assertRaisesRegex(StudyError, r"study\.toml:5: key 'method\.0\.quick': every \[\[method\]\] has quick = \[\]"):
                file.read(path, quick=True)

    def test_only_is_of_a_trade_at_points(self):
        path = self.write(f"""
scene = "{blocks}"
[vary]
"space.cell" = [1e-3, 2e-3]
[[method]]
name = "a"
only = {{"space.cell" = [2e-3]}}
[report]
kinds = ["trade"]
trade_points = true
""")
        self.assertEqual([case["point"] for case in plan.make(path, False)["cases"].values() if case["role"] == "ladder"], [1])

    def test_a_refused_scene_or_quantity_ends_the_study_before_it_starts(self):
        scene = f'scene = "{blocks}"\n'
        for text, expected, status in ((scene + '[vary]\n"integrator.courant" = [0.4, -1.0]\n[report]\nkinds = ["sweep"]', r"study\.toml:3: key 'vary\.integrator\.courant': the program refuses the scene at integrator\.courant = -1\.0: case point-1: exit status 2: error: --set .*integrator.courant", 1),
                               (scene + '[vary]\n"space.cell" = [1e-3]\n"time.start" = [0.0, 1.0]\n[report]\nkinds = ["sweep"]', r"study\.toml:3: key 'vary\.space\.cell': the program refuses the scene at space\.cell = 0\.001, time\.start = 1\.0: case point-1: .*impact\.toml:\d+:\d+: key 'time\.end'", 1),
                               (scene + '[[quantity]]\nname = "speed"\nfrom = "bodies.stricker.kinetic"\n[report]\nkinds = ["error-bars"]', r"study\.toml:4: key 'quantity\.0\.from': quantity 'speed': .*found 'stricker', expected one of target, striker", 1),
                               (scene + '[[reference]]\nset = {"integrator.step" = -1}\n[[reference]]\nset = {"integrator.step" = 1e-8}\n[report]\nkinds = ["trade"]', r"study\.toml:3: key 'reference\.0\.integrator\.step': the program refuses the scene: case reference-reference-1: exit status 2: error: --set .*integrator\.step", 1),
                               (scene + '[[quantity]]\nname = "q"\nfrom = "failure.first_separation.tmie"\n[report]\nkinds = ["error-bars"]', "found 'tmie', expected one of time", 1),
                               (scene + 'set = {"time.end" = -1.0}', "^error: .*time.end", 2), (scene + "nonsense = 1", "^error: .*study.toml:2: key 'nonsense'", 2)):
            with self.subTest(expected=expected):
                self.assertRegex(self.command(self.write(text), status=status).stderr, expected)
                self.assertFalse((self.folder / "out/runs").exists())
        self.command(self.folder / "none.toml", status=2)

    def test_absent_sections_have_defaults(self):
        cases = plan.make(self.write(f'scene = "{blocks}"\n'), False)["cases"]
        roles = [case["role"] for case in cases.values()]
        self.assertEqual([roles.count(role) for role in ("base", "reference", "member", "point")], [1, 2, 20, 0])
        ladders = {case["method"] for case in cases.values() if case["role"] == "ladder"}
        self.assertEqual(ladders, {"MUSL", "ERK 3", "DIRK 3", "MUSL, substep", "MUSL, cvode"})
        self.assertEqual({case["kind"] for case in cases.values() if case["role"] == "refined"}, {"time", "local", "space"})
        self.assertEqual(len({json.dumps(case["settings"]) for case in cases.values()}), len(cases))


    def test_error_bars_of_a_point_refine_what_the_point_has(self):
        cases = plan.make(self.write(f"""
scene = "{blocks}"
[vary]
"space.cell" = [1e-3, 2e-3]
"integrator.step" = [4e-8, 2e-8]
[report]
kinds = ["sweep"]
sweep_bars = ["time", "space"]
"""), False)["cases"]
        points = {case["point"]: case["settings"] for case in cases.values() if case["role"] == "point"}
        self.assertEqual(len(points), 4)
        for number, point in points.items():
            refined = {case["effort"]: case["settings"] for case in cases.values() if case["role"] == "refined" and case["point"] == number}
            self.assertEqual(refined["half the cell"]["space.cell"], 0.5 * point["space.cell"])
            self.assertEqual(refined["half the step"]["integrator.step"], 0.5 * point["integrator.step"])
            self.assertEqual(refined["half the step"]["space.cell"], point["space.cell"])

    def test_variants_repeat_methods_with_other_settings(self):
        text = f"""
scene = "{blocks}"
[[method]]
name = "musl"
title = "MUSL"
set = {{"integrator.scheme" = "musl"}}
[[method]]
name = "usf"
quick = []
[[variant]]
name = "coarse"
set = {{"space.cell" = 2e-3}}
[report]
kinds = ["methods"]
"""
        made = plan.make(self.write(text), False)
        found = {case["method"]: case["settings"] for case in made["cases"].values()}
        self.assertEqual(set(found), {"musl", "usf", "coarse-musl", "coarse-usf"})
        self.assertEqual(found["coarse-musl"], {"integrator.scheme": "musl", "space.cell": 2e-3})
        self.assertEqual(made["titles"]["coarse-musl"], "MUSL, coarse")
        self.assertEqual(made["variants"]["coarse-usf"], {"name": "coarse", "set": {"space.cell": 2e-3}, "of": "usf"})
        self.assertEqual({case["method"] for case in plan.make(self.write(text), True)["cases"].values()}, {"musl", "coarse-musl"})
        with self.assertRaisesRegex(StudyError, "key 'variant.0.methods': found 'mussel', expected some of musl, usf"):
            file.read(self.write(text.replace('name = "coarse"', 'name = "coarse"\nmethods = ["mussel"]')))

    def test_cases_of_the_same_settings_share_a_run(self):
        cases = plan.make(self.write(f"""
scene = "{blocks}"
[[method]]
name = "{{}}"
each = {{"integrator.scheme" = ["musl", "usf"]}}
rung = [{{name = "long", members = 3}}, {{name = "short", set = {{"integrator.step" = 2e-8}}}}]
[[method]]
name = "again"
set = {{"integrator.scheme" = "usf"}}
ladder = {{"integrator.step" = [4e-8, 2e-8]}}
[report]
kinds = ["methods"]
"""), False)["cases"]
        self.assertEqual(len(cases), 2 * (3 + 1) + 2)
        jobs = plan.jobs({"key": "", "cases": cases})
        self.assertEqual(sorted(len(names) for names in jobs.values()), [1, 1, 1, 3, 3])
        self.assertEqual(cases["rung-again-step-2e-08"]["run"], "rung-usf-short")


class Shipped(unittest.TestCase):
    maxDiff = None
    """The four studies that ship are study files, and what only they need."""
    names = ("paper", "trade", "sensitivity", "stability")

    def test_no_body_has_a_name_in_what_studies_share(self):
        scenes = [tomllib.loads(path.read_text()) for folder in ("studies", "examples") for path in (source / folder).rglob("*.toml")]
        bodies = {body["name"] for scene in scenes for body in scene.get("body", [])}
        self.assertTrue({"plate", "cylinder", "ball", "disk"} <= bodies)
        named = re.compile(rf"""["']({'|'.join(map(re.escape, bodies))})["']|bodies\.({'|'.join(map(re.escape, bodies))})\b|\b(plate|cylinder|disk|striker|interlayer)\b""")
        shared = [path for folder in ("study", "own", "vitrum") for path in (source / "studies" / folder).rglob("*") if path.suffix in (".py", ".smk")]
        self.assertGreater(len(shared), 30)
        found = [f"{path.name}:{n}: {line.strip()}" for path in [*shared, source / "studies/run", source / "studies/vitrum-study"]
                 for n, line in enumerate(path.read_text().splitlines(), 1) if named.search(line)]
        self.assertEqual(found, [])

    def test_their_files_are_read_and_share_runs(self):
        for name in self.names:
            with self.subTest(study=name):
                plans = {key: plan.make(path, quick) for quick in (True, False) for key, path in plan.files_of(name).items()}
                self.assertTrue(plans)
                for each in plans.values():
                    runs = [run for names in plan.jobs({**each, "key": ""}).values() for run in names]
                    settings = [json.dumps(each["cases"][run]["settings"], sort_keys=True) for run in runs]
                    self.assertEqual(len(set(settings)), len(settings))


class Quantities(unittest.TestCase):
    summary = {"bodies": {"ball": {"kinetic": 3.0, "first_damage": None, "momentum": [0.0, -2.0]}}, "energy": {"initial": 4.0}, "contacts": [{"duration": 2e-6}]}

    def test_paths_and_formulas(self):
        self.assertEqual(doctest.testmod(quantities).failed, 0)
        for source_text, expected in (("bodies.ball.kinetic", 3.0), ("bodies.ball.momentum.1", -2.0), ("contacts.0.duration * 1e6", 2.0),
                                      ("= sqrt(energy.initial) - 2**-1", 1.5), ("bodies.ball.first_damage.time", None), ("1 / (energy.initial - 4)", None)):
            self.assertEqual(quantities.value(source_text, self.summary), expected, source_text)

    def test_nothing_else_is_obeyed(self):
        for source_text in ("bodies.ball", "bodies.disk.kinetic", "__import__('os').system('true')", "energy.initial if 1 else 2", "kinetic", "energy.initial +", "contacts.1.duration",
                            "bodies.ball.first_damage.tmie", "sin(bodies.ball.first_damage.time)", "bodies.ball.first_damage.time.more"):
            with self.assertRaises(StudyError, msg=source_text):
                quantities.value(source_text, self.summary)


class Meaning(unittest.TestCase):
    def rung(self, method, rung, error, seconds, apart=1e-6):
        return {"point": None, "quantity": "v", "method": method, "setting": str(rung), "rung": rung, "error": error, "seconds": seconds, "references_apart": apart}

    def test_no_lucky_hit_is_recommended(self):
        rows = [self.rung("a", 0, 1e-4, 1.0), self.rung("a", 1, 5e-2, 2.0), self.rung("a", 2, 5e-3, 4.0), self.rung("b", 0, 8e-3, 5.0), self.rung("b", 1, 1e-4, 9.0)]
        advice = {row["level"]: row["advice"] for row in ladders.recommendations(rows)}
        self.assertEqual(advice, {0.1: "a, 0", 0.01: "a, 2", 0.001: "b, 1"})

    def test_below_the_references_nothing_is_decided(self):
        advice = [row["advice"] for row in ladders.recommendations([self.rung("a", 0, 1e-5, 1.0, apart=0.03)])]
        self.assertEqual(advice[0], "a, 0")
        self.assertTrue(all(each.startswith("undecidable") for each in advice[1:]))

    def measured(self, chaos=None, **moved):
        """Bars around 1, each of one effort of its kind; members that spread so that half of 5 to 95 % of them is `chaos`."""
        efforts = {kind: bars.Effort(kind, 1.0 + each, each, 1.0) for kind, each in moved.items()}
        return bars.Bars(Quantity("v", "x"), 1.0, 1.0, efforts, [] if chaos is None else list(1.0 + chaos / 0.9 * np.linspace(-1.0, 1.0, 21)))

    def test_verdicts(self):
        for relative, expected in (({"time": 1e-3, "space": 9e-3}, "converged"), ({"time": 0.03, "space": 0.02}, "needs a tolerance"), ({"local": 0.03}, "needs a tolerance"),
                                   ({"time": 0.02, "space": 0.03}, "needs cells"), ({"space": 0.02, "chaos": 0.03}, "chaotic"),
                                   ({"space": 0.04, "chaos": 0.03}, "chaotic"), ({"space": 0.07, "chaos": 0.03}, "needs cells"), ({"time": 0.02, "chaos": 0.0081}, "needs a tolerance"),
                                   ({"time": 0.011, "chaos": 0.0081}, "converged"), ({}, "not measured")):
            self.assertEqual(bars.verdict(self.measured(**relative), 0.01), expected)
        unsure = self.measured(time=0.0)
        unsure.undecided = True
        self.assertIn("undecided", bars.verdict(unsure, 0.01))
        unsure.failures = ["half the cell failed: error: max_growth", "3 of 10 members failed: error: max_growth"]
        self.assertEqual(bars.verdict(unsure, 0.01), "half the cell failed: error: max_growth (and 1 more)")

    def test_what_is_all_chance_is_chaotic_and_what_is_more_is_not(self):
        """Every run draws from one normal distribution; then refinements of one kind are five standard deviations off."""
        random = np.random.default_rng(3)
        names = {"half the step": "time", "a quarter": "time", "local": "local", "half the cell": "space", "particles": "space", "functions": "space"}

        def drawn(members, shifted=()):
            base, each = random.normal(), {name: random.normal() + (5.0 if name in shifted else 0.0) for name in names}
            return bars.Bars(Quantity("v", "x"), base, 1.0, {name: bars.Effort(kind, each[name], abs(each[name] - base), 1.0) for name, kind in names.items()},
                             list(random.normal(size=members)), list(random.normal(size=members)))

        count = 400
        for members, shifted in ((4, ("half the cell", "particles", "functions")), (10, ("half the cell",)), (20, ("half the cell",))):
            chance, real = [drawn(members) for _ in range(count)], [drawn(members, shifted) for _ in range(count)]
            self.assertGreater(sum(bars.verdict(each, 0.01) == "chaotic" for each in chance), 0.9 * count, members)
            self.assertGreater(sum(bars.best_of_all([each], 0.01) is None for each in chance), 0.9 * count, members)
            self.assertGreater(sum(bars.verdict(each, 0.01) == "needs cells" for each in real), 0.9 * count, members)
            self.assertGreater(sum((bars.best_of_all([each], 0.01) or "").lower().startswith(shifted) for each in real), 0.9 * count, members)

    def test_the_best_effort_is_of_the_largest_bar_and_by_the_second(self):
        found = bars.Bars(Quantity("v", "x"), 1.0, 1.0, {name: bars.Effort(kind, 1.0 + moved, moved, seconds) for name, kind, moved, seconds in (
            ("half the cell", "space", 0.03, 6.0), ("four times the particles", "space", 0.02, 1.0), ("half the step", "time", 0.01, 0.01))})
        self.assertEqual("four times the particles: moves it by 2 % for 1 s more", bars.best_effort(found))
        self.assertIn("of 21 the mean is known to ±4.4 %", bars.best_effort(self.measured(chaos=0.2)))

    def test_two_settings_differ_or_do_not(self):
        random = np.random.default_rng(3)
        one, same, other = random.normal(0, 1, 40), random.normal(0, 1, 40), random.normal(2, 1, 40)
        for finer, differ in ((same, False), (other, True)):
            found = bars.Bars(Quantity("v", "x"), 0.0, 1.0, {}, list(one), list(finer))
            self.assertEqual(found.probability < 0.05, differ)
        few = bars.Bars(Quantity("v", "x"), 0.0, 1.0, {}, [0.0, 1.0, 2.0], [7.0, 8.0, 9.0])
        self.assertAlmostEqual(few.least_probability, 0.1)  # 2 / binomial(6, 3)
        self.assertIn("cannot be told apart by 3 and 3 members", page._compared(few, {"quantity": "v", "unit": "", "mean": 1.0, "same_distribution": few.probability}))

    def test_progress(self):
        for module in (ladders, progress, sweep):
            done = doctest.testmod(module)
            self.assertEqual((done.failed, done.attempted > 0), (0, True))


if __name__ == "__main__":
    unittest.main()
