"""vitrum compare: differences between two results, checked against numpy on the same files."""
import json
import math
import unittest

import h5py
import numpy as np

from support import CommandLineTest, plane_strain


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
