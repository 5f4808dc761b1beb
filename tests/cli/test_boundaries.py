"""Driven boundaries: what a run with a die tells, and that it resumes where the die then is."""
import unittest

import h5py
from support import CommandLineTest, here, overrides, read_summary

die = here / "scenes" / "die.toml"
methods = {**{scheme: overrides(integrator__scheme=f'"{scheme}"') for scheme in ("usf", "usl", "musl")},
           **{method: overrides(integrator__method=f'"{method}"') for method in ("arkode-explicit", "arkode-implicit")}}


class Die(CommandLineTest):
    def test_presses_by_its_way_and_does_the_work_that_the_block_gets(self):
        for method, settings in methods.items():
            with self.subTest(method):
                out = self.run_scene(method, *settings, scene=die)
                energy = read_summary(out)["energy"]
                self.assertLess(abs(energy["relative_residual"]), 0.01)
                self.assertGreater(energy["external"], 8e4)  # J/m
                with h5py.File(out / "result.h5") as result:
                    last = sorted(result["steps"])[-1]
                    y = result["steps"][last]["particles/position"][:, 1]
                # Outermost particles are a quarter of a cell, pressed like all, from the block's faces.
                self.assertAlmostEqual((y.max() - y.min()) * 10.0 / 9.5, 8e-3, delta=0.15e-3)
                # From the checkpoint at 50 us, when the die has gone 1.4 mm and holds one row more than at the start.
                resumed = self.run_scene(f"again {method}", *settings, scene=die)
                self.run_scene(resumed.name, *settings, "--resume", scene=die)
                self.assert_same_results(resumed, out)

    def test_closes_its_account_with_the_default_functions(self):
        for method, settings in methods.items():
            if method == "usl":  # unstable where the edge of a body leaves a node nearly empty
                continue
            with self.subTest(method):
                settings = (*settings, *overrides(space__shape_functions="none"))
                energy = read_summary(self.run_scene(method, *settings, scene=die))["energy"]
                self.assertLess(abs(energy["residual"]), 0.01 * energy["external"])

    def test_a_box_that_stays_lets_go(self):
        out = self.run_scene("out", "--set", "boundary.1.moves=false", scene=die)
        self.assertLess(read_summary(out)["energy"]["elastic"], 7e4)

    def test_boundaries_that_meet(self):
        message = self.vitrum("check", die, *overrides(time__end=1e-3), status=2).stderr
        self.assertRegex(message, r"die\.toml:36:12: key 'boundary\.1\.velocity': found \[0\.0, -20\.0\] m/s for nodes that boundary 'table' "
                                  r"holds at \[0\.0, 0\.0\] m/s \(they meet at t = 0\.000455 s\)")
        self.vitrum("check", die, *overrides(time__end=1e-3), "--set", "boundary.1.priority=1")


if __name__ == "__main__":
    unittest.main()
