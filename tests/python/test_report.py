"""vitrum-report: one page that needs nothing else, says first what the run is worth, and works in a browser."""
import base64
import json
import os
import re
import signal
import subprocess
import time
import unittest

import browser
import numpy as np
from support import PackageTest, blocks, impact, source

import vitrum
from vitrum import report
from vitrum.report import frames, verdict

title = '</title><script>document.body.remove()</script> & "glass" <b>'


def summary(**more):
    """Of a run that nothing speaks against."""
    energy = {"relative_residual": 1e-4, "residual": 1e-4, "initial": 1.0, "max_growth": 1.0}
    integrator = {"method": "arkode-explicit", "steps": 100, "rejected": 2, "limited_by": {"stability": 0, "accuracy": 99, "output": 1},
                  "error_estimate": {"total": 1e-3, "position": 1e-4, "velocity": 1e-3, "strain": None}}
    found = {"status": "complete", "message": None, "warnings": [], "energy": energy, "integrator": integrator}
    for key, value in more.items():
        for table in (found, energy, integrator):
            if key in table:
                table[key] = value
    return found


class Verdict(unittest.TestCase):
    def facts(self, **more):
        run = type("", (), {"summary": summary(**more)})()
        return verdict.facts(run)

    def test_grades(self):
        for more, grade, part in (({}, "good", "closes within 0.01 %"), ({"relative_residual": 0.03}, "mind", "lost 3 %"),
                                  ({"relative_residual": -0.2}, "bad", "made 20 %"), ({"max_growth": 1.3}, "bad", "1.3 times"),
                                  ({"error_estimate": {"total": 3.0}}, "bad", "add up to 3 "), ({"warnings": ["the ball flies"]}, "mind", "the ball flies"),
                                  ({"status": "failed", "message": "step collapsed"}, "bad", "step collapsed"), ({"status": "interrupted"}, "mind", "interrupted"),
                                  ({"limited_by": {"stability": 80, "accuracy": 20}}, "mind", "idle in 80 %"),
                                  ({"error_estimate": None}, "good", "estimates no errors"), ({"limited_by": {"accuracy": 100}}, "good", "2 rejected")):
            with self.subTest(more=more):
                facts = self.facts(**more)
                self.assertEqual(verdict.headline(facts).grade, grade)
                self.assertTrue(any(part in fact.text for fact in facts), facts)


class Page(PackageTest):
    def assert_says(self, page, *parts):
        self.assertEqual([part for part in parts if part not in page], [])

    @classmethod
    def setUpClass(cls):
        cls.results = vitrum.run(impact, {"title": title, "output.every": 1e-6, "output.history_every": 1e-6})
        cls.page = report.page(cls.results)

    def test_needs_nothing_else(self):
        self.assertFalse(re.findall(r"(?:src|href)=\"(?!#)|@import|url\((?!#)|https?://(?!www\.w3\.org/)", self.page))
        self.assertFalse("{{" in self.page)

    def test_text_is_text(self):
        """What a scene says is shown, not obeyed."""
        self.assertEqual(self.page.count("<script"), 2)
        self.assert_says(self.page, "&lt;script&gt;document.body.remove()")

    def test_verdict_comes_first(self):
        order = [self.page.index(f'id="{part}"') for part in ("verdict", "snapshots", "energy", "histories", "events", "fragments", "provenance", "scene")]
        self.assertEqual(order, sorted(order))

    def test_positions_and_fields_are_those_of_the_run(self):
        run, player = self.results, frames.packed(self.results)
        places = np.frombuffer(base64.b64decode(player["places"]), "<u2").reshape(len(run.frames), -1, 2) / 65535.0
        shown = np.array(player["low"]) + places * np.array(player["size"])
        true = np.array([frame.position for frame in run.frames])
        inside = np.all((true > player["low"]) & (true < np.add(player["low"], player["size"])), axis=-1)
        self.assertGreater(inside.mean(), 0.95)
        self.assertLess(np.abs(shown - true)[inside].max(), 1e-5 * max(player["size"]))
        fields = {field["key"]: field for field in player["fields"]}
        self.assertEqual(list(fields), ["bodies", "pieces", "damage", "opening", "speed"])
        codes = {key: np.frombuffer(base64.b64decode(field["data"]), np.uint8).reshape(len(run.frames), -1) for key, field in fields.items()}
        speed = np.linalg.norm(run.fields("velocity"), axis=2)
        np.testing.assert_allclose(codes["speed"] / 254.0 * fields["speed"]["high"], speed, atol=0.0021 * speed.max())
        damage = run.fields("damage")
        np.testing.assert_array_equal(codes["damage"] == frames.nothing, np.isnan(damage))
        np.testing.assert_array_equal(codes["bodies"] == 1, np.nan_to_num(run.fields("decohesion")) >= 1.0)
        np.testing.assert_array_equal((codes["pieces"] == 7), np.nan_to_num(run.fields("decohesion")) >= 1.0)

    def test_a_large_run_is_thinned_and_says_so(self):
        keep = frames.budget, frames.most_frames
        try:
            frames.budget, frames.most_frames = 1000, 5
            player = frames.packed(self.results)
            self.assertLessEqual(player["count"] * len(player["times"]), 1200)
            self.assertEqual(player["times"][-1], self.results.frames[-1].time)
            page = report.page(self.results)
        finally:
            frames.budget, frames.most_frames = keep
        self.assert_says(page, f"One particle of {player['stride']} is drawn", f"{len(player['times'])} of 21 outputs are shown")

    def test_what_a_run_lacks_the_page_lacks(self):
        bare = report.page(vitrum.run(impact, {"time.end": 1e-6}, fields=False))
        self.assertFalse("<canvas" in bare)
        self.assert_says(bare, "The run is complete")
        elastic = report.page(vitrum.run(blocks, {"time.end": 1e-6}))
        self.assertFalse('id="fragments"' in elastic)
        self.assert_says(elastic, "Nothing happened")

    def test_a_failed_run_has_a_page(self):
        with self.assertRaises(vitrum.ComputationError) as failed:
            vitrum.run(impact, {"integrator.step": 1e-6})
        page = report.page(failed.exception.run)
        self.assert_says(page, "Not to be trusted")
        self.assert_says(page, "The run failed: ")


class Command(PackageTest):
    def command(self, *words, status=0):
        done = subprocess.run([source / "studies/vitrum-report", *words], capture_output=True, text=True, timeout=60, cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def test_writes_beside_the_run_or_where_it_is_told(self):
        vitrum.run(impact, {"time.end": 2e-6, "output.every": 1e-6}, self.folder / "a run")
        self.assertEqual(self.command("a run").stdout, "a run/report.html\n")
        self.command("a run", "--out", "there.html")
        self.assertEqual((self.folder / "there.html").read_text(), (self.folder / "a run/report.html").read_text())
        self.assertIn("error: nowhere/result.h5: no such file", self.command("nowhere", status=2).stderr)
        self.assertIn("No such file or directory", self.command("a run", "--out", "no/where.html", status=4).stderr)

    def test_watch_follows_a_run_to_its_end(self):
        out = self.folder / "out"
        watcher = subprocess.Popen([source / "studies/vitrum-report", out, "--watch", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(watcher.stdout.close)
        self.addCleanup(watcher.stderr.close)
        self.addCleanup(watcher.kill)
        run = subprocess.Popen([os.environ["VITRUM"], "run", impact, "--out", out, "--quiet", "--threads", "1", "--set", "output.every=1e-6", "--set", "integrator.step=1e-10"])
        self.addCleanup(run.kill)
        page = out / "report.html"
        deadline = time.monotonic() + 60
        while not page.exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        text = page.read_text()
        if run.poll() is None:
            self.assertIn('http-equiv="refresh" content="1"', text)
            self.assertIn("Under way", text)
            self.assertIn("<progress", text)
        run.send_signal(signal.SIGINT)
        run.wait(60)
        self.assertEqual(watcher.wait(60), 0, watcher.stderr.read())
        self.assertNotIn("http-equiv", page.read_text())
        self.assertIn("The run was interrupted", page.read_text())


@browser.needed
class Browser(PackageTest):
    @classmethod
    def setUpClass(cls):
        cls.results = vitrum.run(impact, {"title": title, "output.every": 1e-6, "output.history_every": 1e-6})
        cls.path = report.write(cls.results)
        cls.driver = browser.start()
        cls.addClassCleanup(cls.driver.quit)

    def open(self, width=1000, height=800, scheme="light"):
        browser.look(self.driver, width, height, scheme)
        self.driver.get(f"file://{self.path}")
        self.driver.execute_script("sessionStorage.clear()")
        self.driver.get(f"file://{self.path}")

    def picture(self):
        return self.driver.execute_script("return document.getElementById('stage').toDataURL()")

    def ask(self, script):
        return self.driver.execute_script(f"return {script}")

    def move_to(self, frame):
        self.driver.execute_script("const slider = document.getElementById('frame'); slider.value = arguments[0]; slider.dispatchEvent(new Event('input'))", frame)

    def test_loads_without_complaints_and_without_the_network(self):
        self.open()
        self.assertEqual(browser.complaints(self.driver), [])
        self.assertEqual(self.ask("performance.getEntriesByType('resource').map(entry => entry.name)"), [])
        self.assertEqual(self.ask("document.querySelector('h1').textContent"), title)
        text = self.ask("document.body.innerText")
        for part in ("To be read with care", "The energy account closes", "it will be instantaneous", "Snapshots", "separation", "Fragments", "scene_sha256"):
            self.assertIn(part, text)
        self.assertGreaterEqual(self.ask("document.querySelectorAll('figure svg').length"), 6)
        self.assertEqual(self.ask("[...document.querySelectorAll('svg')].filter(each => each.getBoundingClientRect().height < 80).length"), 0)

    def test_the_slider_moves_the_frame(self):
        self.open()
        self.assertEqual(self.ask("document.getElementById('stage').dataset.frame"), "20")
        seen = set()
        for frame in (0, 5, 10, 20):
            self.move_to(frame)
            self.assertEqual(self.ask("document.getElementById('stage').dataset.frame"), str(frame))
            self.assertAlmostEqual(float(self.ask("document.getElementById('time').textContent").split()[0]), frame, delta=0.02)
            seen.add(self.picture())
        self.assertEqual(len(seen), 4)

    def test_every_field_has_a_picture_and_a_legend(self):
        self.open()
        seen = set()
        for key in ("bodies", "pieces", "damage", "opening", "speed"):
            self.driver.execute_script(f"document.querySelector('.fields button[data-key={key}]').click()")
            self.assertEqual(self.ask("document.querySelector('.fields [aria-pressed=true]').dataset.key"), key)
            self.assertTrue(self.ask("document.querySelector('.keys').childElementCount > 0 || !document.querySelector('.scale').hidden"))
            seen.add(self.picture())
        self.assertEqual(len(seen), 5)
        self.assertEqual(browser.complaints(self.driver), [])

    def test_play_runs_to_the_end_and_zoom_changes_the_view(self):
        self.open()
        self.move_to(17)
        self.driver.execute_script("document.getElementById('play').click()")
        deadline = time.monotonic() + 10
        while self.ask("document.getElementById('stage').dataset.frame") != "20" and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(self.ask("document.getElementById('stage').dataset.frame"), "20")
        before = self.picture()
        self.driver.execute_script("document.getElementById('stage').dispatchEvent(new WheelEvent('wheel', {deltaY: -300, clientX: 300, clientY: 400, cancelable: true}))")
        self.assertNotEqual(self.picture(), before)
        self.driver.execute_script("document.getElementById('stage').dispatchEvent(new MouseEvent('dblclick'))")
        self.assertEqual(self.picture(), before)

    def test_a_phone(self):
        self.open(360, 740)
        self.assertLessEqual(self.ask("document.documentElement.scrollWidth"), 360)
        self.assertEqual(self.ask("[...document.querySelectorAll('button')].filter(each => each.getBoundingClientRect().height < 36).length"), 0)
        # The smallest letters of the charts, as they stand on the screen.
        least = self.ask("Math.min(...[...document.querySelectorAll('figure text')].map(each => each.getBoundingClientRect().height))")
        self.assertGreater(least, 8.0)

    def test_dark_and_light(self):
        def luminance(colour):
            return sum(float(part) for part in re.findall(r"[\d.]+", colour)[:3]) / 765.0

        pictures = set()
        for scheme, paper in (("light", 1.0), ("dark", 0.0)):
            self.open(scheme=scheme)
            self.driver.execute_script("document.querySelector('.fields button[data-key=speed]').click()")
            self.assertLess(abs(luminance(self.ask("getComputedStyle(document.body).backgroundColor")) - paper), 0.15)
            for element in ("body", "figure text"):
                ink = self.ask(f"getComputedStyle(document.querySelector('{element}'))." + ("fill" if "text" in element else "color"))
                self.assertGreater(abs(luminance(ink) - paper), 0.7, element)
            pictures.add(self.picture())
        self.assertEqual(len(pictures), 2)

    def test_reading_again_keeps_the_place(self):
        self.open()
        self.move_to(7)
        self.driver.execute_script("document.querySelector('.fields button[data-key=damage]').click()")
        self.driver.refresh()
        self.assertEqual(self.ask("[document.getElementById('stage').dataset.frame, document.querySelector('.fields [aria-pressed=true]').dataset.key]"), ["7", "damage"])


if __name__ == "__main__":
    unittest.main()
