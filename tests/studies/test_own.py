"""Studies of one's own scene: tables and page of a small one, a kill, runs that fail, and the error bars of a known answer."""
import os
import pathlib
import signal
import subprocess
import time
import unittest

import numpy as np

from support import Folder, assert_page_works, blocks, source

hertz = pathlib.Path(__file__).resolve().parent / "scenes/hertz.toml"


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

        deadline = time.monotonic() + 900
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


class Swapped(Folder):
    def test_a_run_is_made_anew_when_a_file_that_its_scene_names_has_changed(self):
        """Of two points only the one whose table is another."""
        (self.folder / "scene.toml").write_text(blocks.read_text())
        for name in ("a", "b"):
            (self.folder / f"{name}.csv").write_text("0,-1e6\n1,-1e6\n")
        path = self.write("""
scene = "scene.toml"
set = {"time.end" = 4e-7, "body.1.velocity" = [0.0, 0.0]}
[vary]
"gravity.acceleration" = [[0.0, {csv = "a.csv"}], [0.0, {csv = "b.csv"}]]
[[quantity]]
name = "momentum"
from = "bodies.target.momentum.1"
[report]
kinds = ["sweep"]
""")

        def made():
            self.command(path)
            return [((self.folder / f"out/runs/point-{n}/outcome.json").stat().st_mtime_ns, self.table("sweep")[n]["momentum"]) for n in range(2)]

        first = made()
        self.assertLess(first[0][1], 0.0)
        self.assertEqual(first[1][1], first[0][1])
        self.assertEqual(made(), first)
        (self.folder / "b.csv").write_text("0,-2e6\n1,-2e6\n")
        again = made()
        self.assertEqual(again[0], first[0])
        self.assertAlmostEqual(again[1][1] / first[1][1], 2.0, delta=1e-3)


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
