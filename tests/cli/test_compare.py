"""vitrum compare: differences between two results, checked against numpy on the same files."""
import json
import math
import unittest

import h5py
import numpy as np

from support import CommandLineTest, overrides, plane_strain


class Compare(CommandLineTest):
    def compared(self, a, b):
        return json.loads(self.vitrum("compare", a, b, "--json").stdout)

    def test_a_result_equals_itself(self):
        a = self.run_scene("a")
        answer = self.compared(a, a / "result.h5")
        self.assertIsNone(answer["remark"])
        self.assertEqual(len(answer["times"]), answer["outputs"]["a"])
        self.assertTrue(answer["quantities"])
        for name, quantity in answer["quantities"].items():
            if quantity["a"] is not None:
                self.assertEqual(quantity["difference"], 0.0, name)
        for time in answer["times"]:
            for name, field in time["fields"].items():
                self.assertEqual((field["largest"], field["relative"], field["only_one"]), (0.0, 0.0, 0), name)

    def test_differences_are_those_of_the_files(self):
        a, b = self.run_scene("a"), self.run_scene("b", "--set", "body.1.velocity.1=-101.0")
        answer = self.compared(a, b)
        with h5py.File(a / "result.h5") as x, h5py.File(b / "result.h5") as y:
            self.assertEqual(len(answer["times"]), len(x["steps"]))
            for step, time in zip(sorted(x["steps"]), answer["times"]):
                self.assertAlmostEqual(time["time"], x["steps"][step].attrs["time"], delta=1e-15)
                for name, field in time["fields"].items():
                    p, q = (f["steps"][step]["particles"][name][()] for f in (x, y))
                    gap = np.abs(q - p)
                    self.assertEqual(field["largest"], np.nanmax(gap, initial=0.0), name)
                    if field["largest"] > 0.0 and gap.ndim == 1:
                        self.assertEqual(gap[field["particle"]], field["largest"], name)
                    norm = math.sqrt(np.nansum(p[~np.isnan(gap)] ** 2))
                    if norm > 0.0:
                        self.assertAlmostEqual(field["relative"] * norm, math.sqrt(np.nansum(gap ** 2)),
                                               delta=1e-12 * norm + 1e-300, msg=name)
        summaries = [json.loads((d / "summary.json").read_text()) for d in (a, b)]
        kinetic = answer["quantities"]["energy.kinetic"]
        self.assertEqual((kinetic["a"], kinetic["b"]), tuple(s["energy"]["kinetic"] for s in summaries))
        self.assertNotEqual(kinetic["difference"], 0.0)
        text = self.vitrum("compare", a, b).stdout
        self.assertIn("energy.kinetic", text)
        self.assertIn("position", text)

    def test_the_failure_of_one_body_is_listed_once(self):
        """As that body's. --json has both."""
        a, b = (self.run_scene(name, "--set", f"body.1.velocity.1={speed}") for name, speed in (("a", -100.0), ("b", -140.0)))
        quantities = self.compared(a, b)["quantities"]
        alone = [name for name in quantities if name.startswith("failure.") and quantities[name]["a"] != quantities[name]["b"]
                 and any(other.startswith("bodies.") and other.endswith(name.removeprefix("failure")) and
                         all(quantities[other][side] == quantities[name][side] for side in "ab") for other in quantities)]
        self.assertTrue(alone)
        text = self.vitrum("compare", a, b).stdout
        for name in alone:
            self.assertNotIn(f" {name} ", text)
        self.assertIn(f"{sum(q['a'] != q['b'] for q in quantities.values()) - len(alone)} of {len(quantities)} differ", text)

    def test_root_mean_squares(self):
        a, b = self.run_scene("a"), self.run_scene("b", "--set", "body.1.velocity.1=-101.0")
        with h5py.File(a / "result.h5") as x, h5py.File(b / "result.h5") as y:
            for step, time in zip(sorted(x["steps"]), self.compared(a, b)["times"]):
                for name, field in time["fields"].items():
                    gap = (y["steps"][step]["particles"][name][()] - x["steps"][step]["particles"][name][()]).ravel()
                    gap = gap[~np.isnan(gap)]
                    expected = math.sqrt(np.mean(gap**2)) if gap.size else 0.0
                    self.assertAlmostEqual(field["rms"], expected, delta=1e-12 * expected, msg=name)

    def test_a_page(self):
        a, b = self.run_scene("a"), self.run_scene("b", "--set", "body.1.velocity.1=-101.0")
        text = self.vitrum("compare", a, b).stdout
        self.assertLess(len(text.splitlines()), 45)
        self.assertLess(max(map(len, text.splitlines())), 130)
        last = self.compared(a, b)["times"][-1]["fields"]["velocity"]
        line = next(line.split() for line in text.splitlines() if line.startswith("  velocity"))
        self.assertEqual(line[1], "m/s")
        self.assertEqual(line[2], f"{last['rms']:.3e}")
        self.assertRegex(text, r"(?m)^  failure\.\S+ +(m|s|1) ")
        self.assertRegex(text, r"quantities of the summaries: \d+ of \d+ differ")
        self.assertIn("quantities of the summaries: 0 of", self.vitrum("compare", a, a).stdout)

    def test_what_is_next_to_zero_is_measured_by_the_physics(self):
        """Momentum across an axis of symmetry is rounding: another rounding is no difference, another speed is one."""
        def run(name, seed, *settings):
            moved = [f"body.{body}.perturbation={{amplitude = 1e-9, seed = {seed}}}" for body in (0, 1, 2)]
            return self.run_scene(name, "--no-fields", *(word for setting in (*moved, *settings) for word in ("--set", setting)), scene=plane_strain)

        a, b, c = run("a", 1), run("b", 2), run("c", 1, "body.1.velocity.1=-198.0")
        same, other = self.compared(a, b)["quantities"], self.compared(a, c)["quantities"]
        across = same["bodies.disk.momentum.0"]
        self.assertGreater(abs(across["difference"]), 0.01 * max(abs(across["a"]), abs(across["b"])))
        self.assertLess(max(quantity["relative"] for quantity in same.values()), 1e-5)
        # The momentum of the disk's kinetic energy, which is half of the account: the other disk has as much a mass.
        self.assertGreater(other["bodies.disk.momentum.1"]["relative"], 3e-3)
        self.assertAlmostEqual(other["energy.kinetic"]["relative"], abs(other["energy.kinetic"]["difference"]) / other["energy.initial"]["a"], delta=1e-12)
        self.vitrum("compare", a, b, "--tolerance", 1e-5)
        self.vitrum("compare", a, c, "--tolerance", 1e-3, status=1)
        self.assertNotIn("momentum.0", self.vitrum("compare", a, c).stdout)

    def test_last_and_fields(self):
        a, b = self.run_scene("a"), self.run_scene("b", "--set", "body.1.velocity.1=-101.0")
        whole = self.compared(a, b)
        part = json.loads(self.vitrum("compare", a, b, "--json", "--last", "--fields", "velocity,damage").stdout)
        self.assertEqual(part["times"], [{"time": whole["times"][-1]["time"],
                                          "fields": {name: whole["times"][-1]["fields"][name] for name in ("velocity", "damage")}}])
        answer = self.vitrum("compare", a, b, "--fields", "velocty,damage", status=2)
        self.assertRegex(answer.stderr, 'error: --fields: found "velocty", expected fields of the results: .*velocity')

    def test_several(self):
        a, b, c = self.run_scene("a"), self.run_scene("b", "--set", "body.1.velocity.1=-101.0"), self.run_scene("c", "--threads", 2)
        answer = json.loads(self.vitrum("compare", a, b, c, "--json").stdout)
        self.assertEqual({key: answer[key] for key in answer if key != "others"}, self.compared(a, b))
        self.assertEqual(answer["others"], [self.compared(a, c)])
        text = self.vitrum("compare", a, b, c).stdout
        self.assertIn(f"B  {b}/result.h5 (11 outputs)", text)
        self.assertIn(f"B  {c}/result.h5 (11 outputs)", text)

    def test_tolerance(self):
        a, b = self.run_scene("a"), self.run_scene("b", "--set", "body.1.velocity.1=-100.001")
        worst = max(field["relative"] for time in self.compared(a, b)["times"] for field in time["fields"].values()
                    if field["relative"] is not None)
        self.assertGreater(worst, 0.0)
        self.vitrum("compare", a, a, "--tolerance", 0)
        answer = self.vitrum("compare", a, a, b, "--tolerance", 1e-12, status=1)
        self.assertEqual(answer.stderr, f"{b}/result.h5: differs from {a}/result.h5 by more than 1e-12\n")
        position = max(time["fields"]["position"]["relative"] for time in self.compared(a, b)["times"])
        self.vitrum("compare", a, b, "--fields", "position", "--tolerance", 1.01 * position)
        self.vitrum("compare", a, b, "--fields", "position", "--tolerance", 0.99 * position, status=1)
        without, other = self.run_scene("without", "--no-fields"), self.run_scene("other", "--no-fields", "--set", "body.1.velocity.1=-100.001")
        self.vitrum("compare", without, a, "--tolerance", 0)
        self.vitrum("compare", without, other, "--tolerance", 0, status=1)
        self.vitrum("compare", a, self.run_scene("plane", scene=plane_strain), "--tolerance", 1e9, status=1)
        for wrong in (-1, "nan"):
            self.assertIn(f"found {wrong}, expected 0 or more", self.vitrum("compare", a, b, "--tolerance", wrong, status=2).stderr)
        self.vitrum("compare", a, b, "--tolerance", "inf")

    def test_without_fields(self):
        a, without = self.run_scene("a"), self.run_scene("without", "--no-fields")
        self.assertEqual(self.compared(a, without)["remark"], "B has no fields (--no-fields): fields are not compared")
        self.assertEqual(self.compared(without, a)["remark"], "A has no fields (--no-fields): fields are not compared")
        self.assertEqual(self.compared(without, without)["remark"], "neither result has fields (--no-fields)")

    def test_far_from_time_zero(self):
        """Each output is paired with itself, also where an interval is a billionth of the time."""
        settings = overrides(time__start=1000.0, time__end=1000.00002, output__every=2e-6)
        a, b = self.run_scene("a", *settings), self.run_scene("b", *settings, *overrides(output__every=4e-6))
        answer = self.compared(a, a)
        self.assertEqual(len(answer["times"]), answer["outputs"]["a"])
        self.assertGreater(len(answer["times"]), 9)
        for time in answer["times"]:
            for name, field in time["fields"].items():
                self.assertEqual((field["largest"], field["only_one"]), (0.0, 0), name)
        with h5py.File(a / "result.h5") as x, h5py.File(b / "result.h5") as y:
            times = [f["series/time"][()] for f in (x, y)]
        common = [t for t in times[0] if np.any(np.abs(times[1] - t) < 1e-9)]
        self.assertLess(len(common), len(times[0]))
        np.testing.assert_array_equal([t["time"] for t in self.compared(a, b)["times"]], common)

    def test_common_times_only(self):
        a = self.run_scene("a", "--set", "output.every=5e-6")
        b = self.run_scene("b", "--set", "output.every=2e-6")
        with h5py.File(a / "result.h5") as x, h5py.File(b / "result.h5") as y:
            times = [[f["steps"][s].attrs["time"] for s in sorted(f["steps"])] for f in (x, y)]
        common = [t for t in times[0] if any(abs(t - u) < 1e-12 for u in times[1])]
        self.assertLess(len(common), len(times[0]))
        np.testing.assert_allclose([t["time"] for t in self.compared(a, b)["times"]], common, atol=1e-15)

    def test_other_bodies(self):
        a, b = self.run_scene("a"), self.run_scene("b", scene=plane_strain)
        answer = self.compared(a, b)
        self.assertIn("different bodies", answer["remark"])
        self.assertEqual(answer["times"], [])

    def test_bad_input(self):
        a = self.run_scene("a", "--no-fields")
        (self.folder / "foreign.h5").write_bytes(b"no result" * 100)
        self.vitrum("compare", a, self.folder / "foreign.h5", status=4)
        self.vitrum("compare", a, self.folder / "missing", status=4)
        self.vitrum("compare", a, status=2)


if __name__ == "__main__":
    unittest.main()
