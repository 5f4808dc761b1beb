"""Computations that fail, and folders that cannot be written."""
import os
import unittest

import h5py
import numpy as np
from support import CommandLineTest, here, impact, overrides, read_csv, read_summary

die = here / "scenes" / "die.toml"
unstable = overrides(integrator__step=3e-7)  # 2.5 times the critical step


class Instability(CommandLineTest):
    def test_the_message_says_what_and_what_to_do(self):
        answer = self.vitrum("run", impact, "--out", "out", "--quiet", *unstable, status=3)
        message = next(line for line in answer.stderr.splitlines() if line.startswith("error: "))
        self.assertRegex(message, r"t = \d\.\d+e-06 s, step \d+: ")
        self.assertRegex(message, r"body '(plate|cylinder)', particle \d+ at \(\S+, \S+\) m")
        self.assertRegex(message, r"grown to \d\S* times the energy put in \(bound: integrator\.max_growth = 1\.5\)")
        self.assertRegex(message, r"the step \S+ s is \d\.\d+ times the critical step 1\.2\d+e-07 s")
        self.assertRegex(message, r"try integrator\.step = \S+ or integrator\.courant = 0\.4")
        # And following the advice helps.
        self.run_scene("cured", *overrides(integrator__courant=0.4))

    def test_where_no_step_is_stable_another_scheme_is_advised(self):
        usl = dict(integrator__scheme='"usl"', space__shape_functions='"gimp"')
        answer = self.vitrum("run", die, "--out", "out", "--quiet", *overrides(**usl), status=3)
        self.assertRegex(answer.stderr, r"0\.398 times the critical step .* try integrator\.scheme = \"musl\": a node that is nearly empty")
        # And following the advice helps.
        energy = read_summary(self.run_scene("cured", *overrides(**usl | dict(integrator__scheme='"musl"')), scene=die))["energy"]
        self.assertLess(abs(energy["residual"]), 1e-3 * energy["external"])

    def test_results_so_far_can_be_read(self):
        out = self.run_scene("out", *unstable, status=3)
        summary, rows = read_summary(out), read_csv(out / "energy.csv")
        self.assertEqual(summary["status"], "failed")
        self.assertIn("max_growth", summary["message"])
        self.assertEqual(rows["time"][-1], summary["time"])
        with h5py.File(out / "result.h5") as result:
            last = result["steps"][sorted(result["steps"])[-1]]
            self.assertEqual(last.attrs["time"], summary["time"])
            self.assertTrue(np.all(np.isfinite(last["particles/position"])))
        self.assertIn("failed", self.vitrum("info", out).stdout)

    def test_without_the_watchdog_it_runs_to_the_end(self):
        step = {"integrator__step": 2e-7}
        bound = read_summary(self.run_scene("bounded", *overrides(integrator__max_growth=1.0001, **step), status=3))
        summary = read_summary(self.run_scene("out", *overrides(integrator__max_growth="inf", **step)))
        self.assertEqual((bound["status"], summary["status"]), ("failed", "complete"))
        self.assertEqual(summary["time"], 20e-6)
        self.assertGreater(summary["energy"]["max_growth"], 1.0001)

    def test_values_that_are_not_finite_stop_any_run(self):
        # Nothing yields in this scene, so that nothing bounds the growth.
        scene = self.folder / "elastic.toml"
        text = impact.read_text()
        models = text.index("[material.glass.damage]"), text.index("[material.steel]"), text.index("[material.steel.von_mises]")
        scene.write_text(text[:models[0]] + text[models[1]:models[2]])
        out = self.folder / "out"
        answer = self.vitrum("run", scene, "--out", out, "--quiet", status=3,
                             *overrides(integrator__step=2e-6, integrator__max_growth="inf", time__end=2e-3))
        self.assertRegex(answer.stderr, "error: t = .*step \\d+: ")
        self.assertEqual(read_summary(out)["status"], "failed")


class Unwritable(CommandLineTest):
    def test_folder_below_a_file(self):
        file = self.folder / "file"
        file.write_text("kept")
        for out in (file, file / "out"):
            answer = self.vitrum("run", impact, "--quiet", "--out", out, status=4)
            self.assertRegex(answer.stderr, r"error: \S*file\S*: cannot be made: Not a directory")
        self.assertEqual(file.read_text(), "kept")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_folder_without_permission(self):
        out = self.folder / "out"
        out.mkdir(mode=0o500)
        self.assertRegex(self.vitrum("run", impact, "--quiet", "--out", out, status=4).stderr, "error: .*out")


if __name__ == "__main__":
    unittest.main()
