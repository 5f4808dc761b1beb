"""An initial stress is judged at the start of a run, in every method, whether or not anything moves."""
import itertools
import unittest

from support import CommandLineTest, overrides, read_csv, read_summary

# 72 MPa and 24 MPa: uniaxial strain of 8.3e-4, beyond the onset at 1 /s. Held all round.
scene = """
[space]
geometry = "plane-strain"
cell = 1.0e-3
[time]
end = 1e-6
[integrator]
method = "explicit"
scheme = "musl"
step = 2e-8
[output]
every = 1e-6
[[body]]
name = "plate"
material = "glass"
box = {min = [0.0, 0.0], max = [0.004, 0.004]}
stress = [72e6, 24e6, 24e6, 0.0]
[[boundary]]
box = {min = [-1.0, -1.0], max = [1.0, 1.0]}
fix = ["x", "y"]
[material.glass]
density = 2500.0
young = 72.0e9
poisson = 0.25
[material.glass.damage]
toughness = 0.83e6
k = 5.0e26
m = 6
[material.glass.decohesion]
opening = 5.0e-6
q = 1.0
mode_ratio = 50.0
"""
# What is left of the modulus of uniaxial strain at the onset: D = .2013, eqs. 5, 6 and 8.
bulk, poisson = (1 - 0.2013) * 48e9, 0.25 * (1 - 0.118315)
left = (bulk + 2 * bulk * (1 - 2 * poisson) / (1 + poisson)) / 86.4e9


class InitialState(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "tension.toml"
        self.scene.write_text(scene)

    def test_a_held_tension(self):
        schemes = [overrides(integrator__scheme=f'"{name}"') for name in ("usf", "usl", "musl")]
        adaptive = scene.replace('method = "explicit"\nscheme = "musl"\nstep = 2e-8', 'method = "METHOD"')
        cases = [(self.scene, choice) for choice in schemes]
        for method in ("arkode-explicit", "arkode-implicit"):
            path = self.folder / f"{method}.toml"
            path.write_text(adaptive.replace("METHOD", method))
            cases.append((path, []))
        given = 0.5 * 72e6 * (72e6 / 86.4e9) * 0.004**2  # J/m
        for n, ((path, choice), local) in enumerate(itertools.product(cases, ("closed-form", "substep", "cvode"))):
            with self.subTest(scene=path.name, choice=choice, local=local):
                out = self.run_scene(f"run{n}", *choice, *overrides(constitutive__method=f'"{local}"'), scene=path)
                failure = read_summary(out)["failure"]
                self.assertEqual(failure["localised"], 16)
                self.assertEqual(failure["separated"], 0)
                self.assertEqual(failure["first_damage"]["time"], 0.0)
                self.assertEqual(failure["first_localisation"]["time"], 0.0)
                energy = read_csv(out / "energy.csv")
                for row in (0, -1):
                    self.assertAlmostEqual(energy["elastic"][row], left * given, delta=1e-3 * given)
                    self.assertAlmostEqual(energy["elastic"][row] + energy["damage"][row], given, delta=1e-9 * given)


if __name__ == "__main__":
    unittest.main()
