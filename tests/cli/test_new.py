"""`vitrum new`: templates that are valid, give no cause for a warning, run at once, and follow their own parameters."""
import json
import tomllib
import unittest

import numpy as np
from support import CommandLineTest, read_summary, source

templates = source / "examples"


class New(CommandLineTest):
    def names(self):
        lines = self.vitrum("new", "--list").stdout.splitlines()
        for line in lines:
            self.assertRegex(line, r"^[a-z-]+ +An? \w.*\.$")
        return [line.split()[0] for line in lines]

    def write(self, name):
        path = self.folder / f"{name}.toml"
        self.vitrum("new", name, "--out", path)
        return path

    def test_templates_are_listed_and_come_out_as_they_are(self):
        names = self.names()
        self.assertLessEqual({"impact", "drop-ball", "laminate", "pressed-disk", "blast", "bar"}, set(names))
        for name in names:
            self.assertEqual(self.vitrum("new", name).stdout, (templates / f"{name}.toml").read_text())
        self.assertEqual(self.vitrum("new").stdout, (templates / "impact.toml").read_text())
        for words in ("drop ball", "drop_ball"):
            self.assertEqual(self.vitrum("new", words).stdout, self.vitrum("new", "drop-ball").stdout)

    def test_each_is_valid_and_runs_at_once(self):
        for name in self.names():
            with self.subTest(template=name):
                path = self.write(name)
                checked = json.loads(self.vitrum("check", path, "--json").stdout)
                self.assertEqual(checked["warnings"], [])
                self.assertLess(checked["seconds_most"], 60.0)
                scene = tomllib.loads(path.read_text())
                self.assertGreater(len(scene["parameters"]), 3)
                times = tomllib.loads(checked["resolved"])["time"]
                # A tenth of it, which loads the bodies.
                end = times["start"] + 0.1 * (times["end"] - times["start"])
                out = self.run_scene(f"out-{name}", "--threads", "1", "--set", f"time.end={end!r}", scene=path)
                summary = read_summary(out)
                self.assertEqual((summary["status"], summary["warnings"]), ("complete", []))
                self.assertLess(abs(summary["energy"]["relative_residual"] or 0.0), 0.02)

    def test_parameters_rule(self):
        path = self.write("drop-ball")
        speeds = [json.loads(self.vitrum("check", path, "--json", "--set", f"parameters.height={height}").stdout)["resolved"] for height in (1.0, 4.0)]
        slow, fast = (tomllib.loads(text)["body"][1]["velocity"][1] for text in speeds)
        self.assertAlmostEqual(slow, -(2 * 9.81) ** 0.5, places=9)
        self.assertAlmostEqual(fast / slow, 2.0, places=9)

    def test_bar_is_the_closed_form(self):
        """Behind the front the stress is density * c * v, and twice that behind the front that the held end has sent back."""
        path = self.write("bar")
        out = self.run_scene("out", "--threads", "1", scene=path)
        with open(out / "probes.csv") as file:
            names = file.readline().strip().split(",")
            rows = [line.strip().split(",") for line in file]
        time, stress = (np.array([float(row[names.index(name)]) for row in rows]) for name in ("time", "stress_rr"))
        c = (72e9 / 2500.0) ** 0.5
        expected = 2500.0 * c * 1.0
        for low, high, times in ((0.1, 0.4, 0.0), (0.7, 1.3, 1.0), (1.7, 1.95, 2.0)):
            inside = (time > low * 0.1 / c) & (time < high * 0.1 / c)
            self.assertGreater(inside.sum(), 20)
            self.assertAlmostEqual(np.mean(stress[inside]) / expected, times, delta=0.02)

    def test_what_is_wrong_is_said(self):
        answer = self.vitrum("new", "imapct", status=2).stderr
        self.assertIn("expected one of impact, drop-ball", answer)
        self.assertIn("did you mean 'impact'?", answer)
        path = self.write("bar")
        self.assertIn("is there already", self.vitrum("new", "impact", "--out", path, status=2).stderr)
        self.assertEqual(path.read_text(), (templates / "bar.toml").read_text())
        self.assertIn("No such file", self.vitrum("new", "--out", self.folder / "no/where.toml", status=4).stderr)


if __name__ == "__main__":
    unittest.main()
