"""Scenes of very small and very large numbers: the same verdict as of a usual size, or a refusal with its reason."""
import re
import unittest

from support import CommandLineTest, here, overrides, read_summary

rods = here / "scenes" / "rods.toml"


class Energies(CommandLineTest):
    def verdict(self, velocity, *arguments):
        """Status and warnings without their numbers, and the growth."""
        done = self.vitrum("run", rods, "--out", self.folder / "out", "--force", "--no-fields", "--quiet",
                           *overrides(body__0__velocity__0=velocity), *arguments, status=None)
        summary = read_summary(self.folder / "out")
        told = [re.sub(r"[\d.]+ %", "%", line)[:60] for line in done.stderr.splitlines() if line.startswith("warning: ") and "key " not in line]
        return done.returncode, summary["status"], told, summary["energy"]["max_growth"] > 1.05

    def test_a_factor_of_all_energies_changes_no_verdict(self):
        for method in ({}, {"integrator__scheme": '"musl"'}, {"integrator__courant": 1.9, "integrator__max_growth": "inf"},
                       {"integrator__courant": 1.9}, {"integrator__method": '"arkode-explicit"'},
                       {"integrator__method": '"arkode-explicit"', "integrator__fixed_step": 2.5e-7},
                       {"integrator__method": '"arkode-implicit"'}):
            def verdict(velocity):
                scales = {"integrator__velocity_scale": velocity, "integrator__strain_scale": velocity / 5000}
                return self.verdict(velocity, *overrides(**method, **scales))
            usual = verdict(10.0)
            for tiny in (1e-9, 1e-19):  # energies smaller by 1e-20 and 1e-40
                self.assertEqual(verdict(tiny), usual, method)

    def test_energies_below_the_tolerance_are_not_judged(self):
        for method in ("arkode-explicit", "arkode-implicit"):
            status, _, told, _ = self.verdict(1e-17, *overrides(integrator__method=f'"{method}"', integrator__rtol=0.1))
            self.assertEqual((status, told), (0, []), method)


class Range(CommandLineTest):
    def refused(self, reason, **values):
        for command in ("check", "run"):
            message = self.vitrum(command, rods, *overrides(**values), status=2).stderr
            self.assertRegex(message, rf"error: .+: key '\S+': .*{reason}")
        self.assertEqual(list(self.folder.iterdir()), [])

    def scaled(self, factor):
        """The scene with all lengths and times multiplied."""
        return {"space__cell": 1e-3 * factor, "time__end": 1e-5 * factor,
                "body__0__box": f"{{min=[0,0],max=[{0.01 * factor},{0.01 * factor}]}}",
                "body__1__box": f"{{min=[{0.01 * factor},0],max=[{0.02 * factor},{0.01 * factor}]}}"}

    def test_what_leaves_the_range_of_numbers(self):
        self.refused("found mass = 4.94e-324 kg of a particle", material__m__density=1e-317, material__m__young=1e-307)
        self.refused("found 1[.0-9]*e-163, expected a number in .1e-140, 1e.140. .m", **self.scaled(1e-160))
        self.refused("found mass = 0 kg of a particle", space__geometry='"axisymmetric"', **self.scaled(1e-110))
        self.refused("found energy at the speed of a wave = 2.78e.293 J", material__m__density=1e150, material__m__young=1e300)
        self.refused("found kinetic energy = 6.25e-304 J", body__0__velocity__0=1e-150)
        self.refused("found kinetic energy = inf J", body__0__velocity__0=1e160)
        self.refused("apart as numbers, and steps of", time__start=1e9, time__end=1000000000.5)

    def test_what_does_not(self):
        for values in (self.scaled(1e-60), self.scaled(1e60), {"material__m__density": 2.5e-200, "material__m__young": 7.2e-193},
                       {"time__start": 1e3, "time__end": 1000.00001}):
            summary = read_summary(self.run_scene("out", "--force", *overrides(**values), scene=rods))
            self.assertEqual(summary["status"], "complete")
            self.assertGreater(summary["energy"]["elastic"], 0.1 * summary["energy"]["initial"])
            self.assertLess(abs(summary["energy"]["relative_residual"]), 0.02)


if __name__ == "__main__":
    unittest.main()
