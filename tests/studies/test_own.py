"""Studies of one's own scene: the file and what is wrong with it, tables and page of a small one, a kill, and the error bars of a known answer."""
import csv
import doctest
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest
from types import SimpleNamespace

import numpy as np

from support import _value, source

sys.path.insert(0, str(source / "studies"))

from study import bars, file, ladders, plan, progress, quantities, sweep  # noqa: E402
from study.file import Quantity  # noqa: E402
from study.outcome import StudyError  # noqa: E402

blocks = source / "studies/trade/impact.toml"
hertz = pathlib.Path(__file__).resolve().parent / "scenes/hertz.toml"


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum study "))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, text):
        path = self.folder / "study.toml"
        path.write_text(text)
        return path

    def command(self, path, *options, status=0):
        done = subprocess.run([source / "studies/vitrum-study", path, "--out", self.folder / "out", *options], capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout[-1000:] + done.stderr[-3000:])
        return done

    def table(self, name):
        with open(self.folder / "out/tables" / f"{name}.csv", newline="") as opened:
            return [{key: _value(text) for key, text in row.items()} for row in csv.DictReader(opened)]


class StudyFile(Folder):
    def test_what_is_wrong_is_said_with_its_place(self):
        scene = f'scene = "{blocks}"\n'
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
                (scene + '[[method]]\nset = {}', "has no key 'name'"), (scene + '[[method]]\nname = "a"\n[[method]]\nname = "a"', "two methods of one name"),
                (scene + '[[reference]]\nset = {}', "found 1 of \\[\\[reference\\]\\], expected two"),
                (scene + 'set = {"space.celll" = 1}', "space.celll.*did you mean 'cell'")):
            with self.subTest(expected=expected):
                with self.assertRaisesRegex(StudyError, "(?s)" + expected):
                    file.read(self.write(text))

    def test_a_refused_scene_or_quantity_ends_the_study_before_it_starts(self):
        scene = f'scene = "{blocks}"\n'
        for text, expected, status in ((scene + '[vary]\n"integrator.courant" = [0.4, -1.0]\n[report]\nkinds = ["sweep"]', "case point-1: exit status 2: error: --set .*integrator.courant", 1),
                               (scene + '[[quantity]]\nname = "speed"\nfrom = "bodies.stricker.kinetic"\n[report]\nkinds = ["error-bars"]', "found 'stricker', expected one of target, striker", 1),
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
        for source_text in ("bodies.ball", "bodies.disk.kinetic", "__import__('os').system('true')", "energy.initial if 1 else 2", "kinetic", "energy.initial +", "contacts.1.duration"):
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

    def measured(self, **relative):
        efforts = {"half the cell": ("space", 0.03, 6.0), "four times the particles": ("space", 0.02, 1.0), "half the step": ("time", 0.5, 1.0)}
        return bars.Bars(Quantity("v", "x"), 1.0, 1.0, relative, efforts, [0.9, 1.0, 1.1, 1.0])

    def test_verdicts(self):
        for relative, expected in (({"time": 1e-3, "space": 9e-3}, "converged"), ({"time": 0.03, "space": 0.02}, "needs a tolerance"), ({"local": 0.03}, "needs a tolerance"),
                                   ({"time": 0.02, "space": 0.03}, "needs cells"), ({"space": 0.02, "chaos": 0.03}, "chaotic"),
                                   ({"space": 0.05, "chaos": 0.03}, "chaotic"), ({"space": 0.07, "chaos": 0.03}, "needs cells"), ({"time": 0.02, "chaos": 0.0099}, "needs a tolerance"), ({}, "not measured")):
            self.assertEqual(bars.verdict(self.measured(**relative), 0.01), expected)
        unsure = self.measured(time=0.0)
        unsure.undecided = True
        self.assertIn("undecided", bars.verdict(unsure, 0.01))

    def test_the_best_effort_is_of_the_largest_bar_and_by_the_second(self):
        self.assertIn("four times the particles: moves it by 2 % for 1 s more", bars.best_effort(self.measured(space=0.03, time=0.01)))
        self.assertIn("of 4 the mean is known to ±10 %", bars.best_effort(self.measured(chaos=0.2)))

    def test_two_settings_differ_or_do_not(self):
        random = np.random.default_rng(3)
        one, same, other = random.normal(0, 1, 40), random.normal(0, 1, 40), random.normal(2, 1, 40)
        for finer, differ in ((same, False), (other, True)):
            found = bars.Bars(Quantity("v", "x"), 0.0, 1.0, {}, {}, list(one), list(finer))
            self.assertEqual(found.probability < 0.05, differ)

    def test_progress(self):
        for module in (ladders, progress, sweep):
            done = doctest.testmod(module)
            self.assertEqual((done.failed, done.attempted > 0), (0, True))


class Whole(Folder):
    text = f"""
scene = "{blocks}"
set = {{"time.end" = 4e-6}}
[vary]
"body.striker.velocity" = [[0.0, -1.0], [0.0, -2.0]]
"space.shape_functions" = ["linear", "gimp"]
[[method]]
name = "MUSL"
set = {{"integrator.scheme" = "musl"}}
ladder = {{"integrator.step" = [4e-7, 1e-7, 5e-8]}}
[[method]]
name = "ERK"
set = {{"integrator.method" = "arkode-explicit", "integrator.order" = 3}}
ladder = {{"integrator.rtol" = [1e-2, 1e-5]}}
[[quantity]]
name = "momentum given"
from = "bodies.target.momentum.1"
[[quantity]]
name = "share of the target"
from = "bodies.target.kinetic / energy.initial"
[ensemble]
members = 3
[report]
sweep_bars = ["time"]
"""

    def test_tables_figures_page_and_a_kill(self):
        path = self.write(self.text)
        out = self.folder / "out"
        study = subprocess.Popen([source / "studies/vitrum-study", path, "--out", out], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

        def finished():
            return {each: each.stat().st_mtime_ns for each in out.glob("runs/*/outcome.json")}

        deadline = time.monotonic() + 200
        while len(finished()) < 5 and study.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        os.killpg(study.pid, signal.SIGKILL)
        study.wait()
        before = finished()
        self.assertGreaterEqual(len(before), 5)
        self.assertFalse((out / "report.html").exists())
        said = self.command(path).stderr
        self.assertRegex(said, r"\d+ of \d+ cases done, \d+ running, about \d+ s left")
        self.assertEqual({each: finished()[each] for each in before}, before, "finished runs were made again")

        cases = {row["case"]: row for row in self.table("cases")}
        self.assertEqual(cases["base"]["status"], "complete")
        trade = self.table("trade")
        # A step beyond the critical one fails, which is a result.
        unstable = [row for row in trade if row["method"] == "MUSL" and row["rung"] == 0]
        self.assertEqual({row["status"] for row in unstable}, {"failed"})
        self.assertEqual({row["error"] for row in unstable}, {None})
        for quantity in ("momentum given", "share of the target", "velocity field"):
            errors = {(row["method"], row["rung"]): row["error"] for row in trade if row["quantity"] == quantity}
            self.assertLess(errors["MUSL", 2], 0.7 * errors["MUSL", 1])
            self.assertLess(errors["ERK", 1], errors["MUSL", 2])
            self.assertLess(max(row["references_apart"] for row in trade), 1e-4)
        measured = {row["quantity"]: row for row in self.table("error_bars")}
        self.assertEqual(set(measured), {"momentum given", "share of the target"})
        for row in measured.values():
            self.assertGreater(row["space"], row["chaos"])
            self.assertLess(row["chaos"], 1e-6 * row["scale"])
            self.assertIn(row["verdict"], ("converged", "needs cells", "needs a tolerance"))
        sweep = self.table("sweep")
        self.assertEqual(len(sweep), 4)
        by = {(row["body.striker.velocity"], row["space.shape_functions"]): row for row in sweep}
        for shape in ("linear", "gimp"):
            slow, fast = by["[0.0, -1.0]", shape], by["[0.0, -2.0]", shape]
            # Elastic: twice the speed, twice the momentum.
            self.assertAlmostEqual(fast["momentum given"] / slow["momentum given"], 2.0, delta=0.03)
            self.assertGreater(slow["± momentum given"], 0.0)
        for name in ("trade", "error-bars", "sweep"):
            for suffix in ("png", "pdf"):
                self.assertGreater((out / f"figures/{name}.{suffix}").stat().st_size, 5000)
        page = (out / "report.html").read_text()
        missing = [part for part in ("Error bars", "What an accuracy costs", "Sweep", "MUSL, step 4e-07: failed", "Runs that did not come to their end") if part not in page]
        self.assertEqual(missing, [])
        assert_page_works(self, out / "report.html", ["Error bars", "What an accuracy costs", "Sweep"])


def assert_page_works(test, path, parts=()):
    """In a browser, where there is one: its text is there, nothing to complain of, no wider than a phone, in the light and in the dark."""
    sys.path.insert(0, str(source / "tests/python"))
    import browser
    if not browser.there:
        return
    driver = browser.start()
    test.addCleanup(driver.quit)
    papers = []
    for scheme in ("light", "dark"):
        browser.look(driver, 360, 740, scheme)
        driver.get(f"file://{path}")
        test.assertEqual(browser.complaints(driver), [])
        test.assertLessEqual(driver.execute_script("return document.documentElement.scrollWidth"), 360)
        test.assertEqual(driver.execute_script("return [...document.querySelectorAll('figure svg')].filter(each => each.getBoundingClientRect().height < 60).length"), 0)
        text = driver.execute_script("return document.body.innerText")
        test.assertEqual([part for part in parts if part not in text], [])
        papers.append(driver.execute_script("return getComputedStyle(document.body).backgroundColor"))
    test.assertNotEqual(*papers)


class Failing(Folder):
    def test_runs_that_fail_are_results(self):
        """Beyond the critical step the scene as it is fails, and what is made of it; a reference too."""
        self.command(self.write(f"""
scene = "{blocks}"
set = {{"time.end" = 4e-6, "integrator.step" = 4e-7}}
[vary]
"integrator.scheme" = ["musl", "usf"]
[[method]]
name = "MUSL"
ladder = {{"integrator.step" = [4e-7, 5e-8]}}
[[reference]]
name = "too long"
set = {{"integrator.step" = 5e-7}}
[[reference]]
name = "short"
set = {{"integrator.step" = 2e-8}}
[ensemble]
members = 2
[report]
kinds = ["trade", "error-bars", "sweep", "methods"]
"""))
        cases = {row["case"]: row for row in self.table("cases")}
        self.assertEqual(cases["base"]["status"], "failed")
        self.assertIn("max_growth", cases["base"]["message"])
        self.assertEqual({row["verdict"] for row in self.table("error_bars")} & {"converged"}, set())
        self.assertTrue(all(row["advice"].startswith("undecidable") for row in self.table("recommendations")))
        self.assertEqual({row["status"] for row in self.table("sweep")}, {"failed"})
        self.assertEqual({(row["setting"], row["status"]) for row in self.table("methods")}, {("step 4e-07", "failed"), ("step 5e-08", "complete")})
        page = (self.folder / "out/report.html").read_text()
        self.assertIn("Runs that did not come to their end", page)
        assert_page_works(self, self.folder / "out/report.html")


class Watched(Folder):
    """watch.html, while a study runs, when it is stopped, and when it is done."""
    text = f"""
scene = "{blocks}"
set = {{"time.end" = 4e-6}}
[[method]]
name = "MUSL"
rung = [{{name = "coarse", set = {{"integrator.step" = 1e-7}}, members = 3}}, {{name = "fine", set = {{"integrator.step" = STEP}}}}]
[[quantity]]
name = "momentum given"
from = "bodies.target.momentum.1"
[report]
kinds = ["methods"]
"""

    def start(self, step):
        path = self.write(self.text.replace("STEP", str(step)))
        study = subprocess.Popen([source / "studies/vitrum-study", path, "--out", self.folder / "out", "--watch", "1", "--cores", "1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 start_new_session=True)
        self.addCleanup(study.wait)
        self.addCleanup(lambda: study.poll() is None and os.killpg(study.pid, signal.SIGKILL))
        return study

    def page(self, ready):
        """The page, once it is as wanted."""
        path, deadline = self.folder / "out/watch.html", time.monotonic() + 240
        while time.monotonic() < deadline:
            if path.exists() and ready(text := path.read_text()):
                return text
            time.sleep(0.1)
        raise AssertionError(path.read_text()[-3000:] if path.exists() else "no page")

    def test_a_study_under_way_and_stopped(self):
        # The fine run takes minutes: nobody waits for it.
        study = self.start(1e-12)
        text = self.page(lambda text: "3 of 4 cases done" in text)
        for part in ('http-equiv="refresh" content="1"', "<progress", "Under way", "to come", "Method by method"):
            self.assertIn(part, text)
        copy = self.folder / "copy.html"
        copy.write_text(text.replace('http-equiv="refresh"', ""))
        assert_page_works(self, copy, ["3 of 4 cases done", "coarse", "momentum given"])
        os.killpg(study.pid, signal.SIGINT)
        text = self.page(lambda text: "Stopped" in text)
        self.assertNotIn("http-equiv", text)
        self.assertIn("3 of 4 cases done", text)

    def test_a_study_that_no_file_tells_is_counted(self):
        from own import page
        out = self.folder / "out"
        out.mkdir()
        page.write(out, True, "watch.html", [], {"heading": "Under way", "text": "3 of 9 cases done", "done": 3, "every": 9, "at": "today"}, 7)
        text = (out / "watch.html").read_text()
        self.assertEqual([part for part in ("Study in out", "3 of 9 cases done", 'content="7"', 'max="9" value="3"') if part not in text], [])

    def test_a_study_that_comes_to_its_end(self):
        study = self.start(5e-8)
        self.assertEqual(study.wait(300), 0)
        text = (self.folder / "out/watch.html").read_text()
        self.assertEqual([part for part in ("http-equiv", "<progress", "Under way", "to come") if part in text], [])
        rows = self.table("methods")
        self.assertEqual([(row["setting"], row["members"], row["n"], row["status"]) for row in rows], [("coarse", 3, 3, "complete"), ("fine", 1, 1, "complete")])
        coarse, fine = rows
        self.assertTrue(coarse["p05"] <= coarse["median"] <= coarse["p95"])
        self.assertAlmostEqual(coarse["p95"] / coarse["p05"], 1.0, delta=1e-6)
        self.assertAlmostEqual(coarse["median"] / fine["median"], 1.0, delta=0.05)
        assert_page_works(self, self.folder / "out/report.html", ["coarse", "Method by method"])


class KnownAnswer(Folder):
    def test_error_bars_of_the_elastic_ball_are_as_large_as_its_errors(self):
        """Hertz: two equal balls touch for 2.9432 d / v, with d = (15 m v^2 / (16 r^(1/2) E))^(2/5), and part as fast as they met."""
        self.command(self.write(f"""
scene = "{hertz}"
[[quantity]]
name = "time of contact"
from = "contacts.0.duration"
unit = "s"
[[quantity]]
name = "restitution"
from = "bodies.upper.velocity.1 / 10"
[ensemble]
members = 2
[report]
kinds = ["error-bars"]
"""))
        rows = {row["quantity"]: row for row in self.table("error_bars")}
        radius, speed, young, poisson, density = 5e-3, 20.0, 205e9, 0.29, 7830.0
        mass, stiffness = density * 4.0 / 3.0 * np.pi * radius**3 / 2.0, young / (1.0 - poisson**2) / 2.0
        depth = (15.0 * mass * speed**2 / (16.0 * np.sqrt(radius / 2.0) * stiffness)) ** 0.4
        for name, known in (("time of contact", 2.9432 * depth / speed), ("restitution", 1.0)):
            row = rows[name]
            off = abs(row["value"] - known)
            bar = np.sqrt(sum(row[kind] ** 2 for kind in ("time", "local", "space", "chaos")))
            self.assertGreater(off, 0.02 * known)  # cells of a tenth of the radius do leave an error
            self.assertLess(off, 1.3 * bar, name)
            self.assertGreater(off, 0.3 * bar, name)
            self.assertEqual(row["verdict"], "needs cells")


if __name__ == "__main__":
    unittest.main()
