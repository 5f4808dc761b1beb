"""Runs under the adaptive methods: what they leave, reproducibility, checkpoints, and steps that collapse."""
import json
import signal
import statistics
import unittest

import h5py
import numpy as np
from support import CommandLineTest, here, impact, overrides, read_summary, told

explicit = overrides(integrator__method='"arkode-explicit"', integrator__rtol=1e-2)
implicit = overrides(integrator__method='"arkode-implicit"', integrator__rtol=1e-2, integrator__order=2)
die = here / "scenes" / "die.toml"
slow_test = here / "scenes" / "disk_on_ring.toml"
methods = {"arkode-explicit": explicit, "arkode-implicit": implicit}
# So many steps that there is time to interrupt.
slow = {"arkode-explicit": [*explicit, *overrides(integrator__max_step=4e-9)],
        "arkode-implicit": [*implicit, *overrides(integrator__max_step=2e-8)]}


# A small tile of glass that breathes: its waves are all of a few cells.
swinging = """
[space]
geometry = "plane-strain"
cell = 1.0e-3
shape_functions = "gimp"
[time]
end = 60.0e-6
[integrator]
method = "arkode-explicit"
[[body]]
name = "tile"
material = "glass"
box = {min = [0.0, 0.0], max = [0.003, 0.003]}
particles_per_cell = 4
velocity_gradient = [[2000.0, 0.0], [0.0, 2000.0]]
[material.glass]
density = 2500.0
young = 72e9
poisson = 0.25
"""


class Results(CommandLineTest):
    def lost(self, name, scene, *settings):
        """Percent of the energy that a run loses, and what it says."""
        answer = self.vitrum("run", scene, "--out", self.folder / name, "--quiet", *settings)
        return 100.0 * read_summary(self.folder / name)["energy"]["relative_residual"], answer.stderr

    def localised(self, solver, percent):
        """Particles that a slow test localises, with the tolerance changed by some percent."""
        output = self.run_scene(f"{solver} {percent}", *overrides(integrator__linear_solver=f'"{solver}"', integrator__rtol=1e-3 * (1.0 + percent / 100.0)), scene=slow_test)
        return read_summary(output)["failure"]["localised"]

    def test_linear_solvers_crack_the_same_particles(self):
        """Not for every tolerance, since failure is a matter of chance then: in the median over tolerances that are all but the same."""
        direct, krylov = (statistics.median(self.localised(solver, percent) for percent in (-1.0, -0.5, 0.0, 0.5, 1.0)) for solver in ("klu", "gmres"))
        self.assertEqual(direct, krylov)

    def test_advice_after_a_loss_helps(self):
        tile = self.folder / "tile.toml"
        tile.write_text(swinging)
        sparse = self.folder / "sparse.toml"
        sparse.write_text(die.read_text().replace("particles_per_cell = 4", "particles_per_cell = 1"))
        pressed = overrides(integrator__method='"arkode-implicit"', integrator__remap_travel=0.25, space__shape_functions='"gimp"')
        for scene, settings, said, advice in ((tile, [], "try integrator.order = 4, or", "integrator.order=4"),
                                              (sparse, pressed, "in slow scenes more particles a cell or integrator.remap_travel = 0.05", "body.0.particles_per_cell=4")):
            with self.subTest(advice):
                lost, words = self.lost("before " + advice, scene, *settings)
                self.assertIn(said, words)
                self.assertLess(self.lost("after " + advice, scene, *settings, "--set", advice)[0], 0.5 * lost)

    def test_what_a_run_tells(self):
        for method, settings in methods.items():
            with self.subTest(method):
                out = self.folder / method
                answer = self.vitrum("run", impact, "--out", out, *settings)
                for line in told(answer.stderr):  # and nothing of SUNDIALS' own
                    self.assertRegex(line, r"^(t = |warning: )")
                self.assertIn("estimated error of integration", answer.stdout)
                summary = read_summary(out)
                self.assertEqual(summary["status"], "complete")
                integrator = summary["integrator"]
                self.assertEqual(integrator["method"], method)
                self.assertEqual(sum(integrator["limited_by"].values()), integrator["steps"])
                self.assertGreater(integrator["rhs_evaluations"], 2 * integrator["steps"])
                self.assertGreater(integrator["limited_by"]["accuracy"], 0)
                self.assertGreater(integrator["error_estimate"]["velocity"], 0.0)
                self.assertLess(integrator["step_min"], integrator["step_max"])
                newton = method == "arkode-implicit"
                self.assertEqual(integrator["newton_iterations"] > 0, newton)
                self.assertEqual(integrator["factorisations"] > 0, newton)
                self.assertEqual(integrator["phases"] > 0, newton)
                self.assertLess(abs(integrator["remap_loss"]), 1e-12 * summary["energy"]["initial"])
                self.assertLess(summary["energy"]["max_growth"], 1.01)
                with h5py.File(out / "result.h5") as result:
                    for name in ("error_estimate", "error_position", "error_velocity", "error_strain"):
                        sums = result["series"][name][:]
                        self.assertTrue(np.all(np.isfinite(sums)), name)
                        self.assertTrue(np.all(np.diff(sums) >= 0.0), name)
                    self.assertEqual(result["series/error_estimate"][-1], integrator["error_estimate"]["total"])
                    times = result["series/time"][:]
                np.testing.assert_allclose(times, np.arange(11) * 2e-6, rtol=0, atol=1e-20)

    def test_fixed_steps_make_no_estimate(self):
        out = self.run_scene("out", *explicit, *overrides(integrator__fixed_step=4e-8))
        summary = read_summary(out)
        self.assertEqual(summary["integrator"]["steps"], 500)
        self.assertIsNone(summary["integrator"]["error_estimate"])

    def test_check_tells_scales_and_no_step(self):
        facts = json.loads(self.vitrum("check", impact, "--json", *explicit).stdout)
        self.assertIsNone(facts["step"])
        self.assertEqual(facts["scales"]["velocity"], 200.0)
        self.assertAlmostEqual(facts["scales"]["strain"], 43e6 / 72e9)
        text = self.vitrum("check", impact, *implicit).stdout
        self.assertIn("tolerances relative to: velocity 200 m/s", text)

    def test_local_methods(self):
        for method in ("substep", "cvode"):
            with self.subTest(method):
                out = self.run_scene(method, *explicit, *overrides(constitutive__method=f'"{method}"', time__end=2e-6))
                self.assertEqual(read_summary(out)["constitutive"]["method"], method)


class Reproducible(CommandLineTest):
    def test_threads(self):
        for method, settings in methods.items():
            with self.subTest(method):
                one, two = (self.run_scene(f"{method}{n}", *settings, "--threads", n) for n in (1, 2))
                self.assert_same_results(one, two)

    def test_interrupted_and_resumed(self):
        for method, settings in slow.items():
            with self.subTest(method):
                whole = read_summary(self.run_scene(f"whole {method}", *settings))
                out = self.folder / f"out {method}"
                process = self.start("run", impact, "--out", out, *settings)
                lines = 0
                while lines < 3:
                    line = process.stderr.readline()
                    self.assertTrue(line)
                    lines += line.startswith("t = ")
                process.send_signal(signal.SIGINT)
                process.stderr.read()
                self.assertEqual(process.wait(), 130)
                self.assertEqual(read_summary(out)["status"], "interrupted")
                self.run_scene(out.name, *settings, "--resume")
                resumed = read_summary(out)
                # The steps (and phases) differ by where the run was cut; the results by the tolerance, of the energy put in.
                for key in ("kinetic", "plastic", "residual"):
                    self.assertAlmostEqual(resumed["energy"][key], whole["energy"][key], delta=0.02 * whole["energy"]["initial"], msg=key)


class Collapse(CommandLineTest):
    def test_the_message_names_the_component(self):
        unreachable = overrides(integrator__rtol=1e-7, integrator__min_step=2e-8)
        for method, settings, where in (("arkode-explicit", explicit, r"of body '(plate|cylinder)', particle \d+ at \(\S+, \S+\) m"),
                                        ("arkode-implicit", implicit, r"of the node at \(\S+, \S+\) m, mass \S+ of the mean")):
            with self.subTest(method):
                out = self.folder / method
                answer = self.vitrum("run", impact, "--out", out, "--quiet", *settings, *unreachable, status=3)
                message = next(line for line in answer.stderr.splitlines() if line.startswith("error: "))
                self.assertRegex(message, r"t = \S+ s, step \d+: the step would have to fall below integrator\.min_step = 2e-08 s")
                self.assertRegex(message, r"largest weighted \w+: \w+ \w+ " + where)
                self.assertRegex(message, r"try a larger integrator\.rtol")
                summary = read_summary(out)
                self.assertEqual(summary["status"], "failed")
                with h5py.File(out / "result.h5") as result:
                    last = result["steps"][sorted(result["steps"])[-1]]
                    self.assertEqual(last.attrs["time"], summary["time"])
                    self.assertTrue(np.all(np.isfinite(last["particles/stress"])))


if __name__ == "__main__":
    unittest.main()
