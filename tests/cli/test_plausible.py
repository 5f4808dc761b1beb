"""What is valid but hardly meant is warned of, before a run and at its end; what is meant is not."""
import json
import re
import unittest

from support import CommandLineTest, here, impact, overrides, read_summary, source

rods = here / "scenes" / "rods.toml"


class Plausible(CommandLineTest):
    def warnings(self, scene=rods, **values):
        return json.loads(self.vitrum("check", scene, "--json", *overrides(**values)).stdout)["warnings"]

    def assert_warns(self, pattern, scene=rods, **values):
        self.assertRegex("\n".join(self.warnings(scene, **values)), pattern)

    def test_usual_scenes(self):
        self.assertEqual(self.warnings(), [])
        for scene in (impact, source / "studies" / "paper" / "reference.toml"):
            self.assertEqual([line for line in self.warnings(scene, space__shape_functions='"gimp"')
                              if "snaps back" not in line and "critical step" not in line], [])

    def test_linear_functions_and_travel(self):
        told = r"key 'space\.shape_functions': body 'comes' travels through (\S+) cells"
        self.assert_warns(told, space__shape_functions='"linear"', time__end=0.4e-3)  # 10 m/s, cells of 1 mm
        (found,) = re.findall(told, "\n".join(self.warnings(space__shape_functions='"linear"', time__end=0.4e-3)))
        self.assertEqual(float(found), 4.0)
        for values in (dict(time__end=0.2e-3), dict(time__end=0.4e-3, space__shape_functions='"bspline2"')):
            self.assertFalse(re.search(told, "\n".join(self.warnings(**{"space__shape_functions": '"linear"', **values}))), values)
        die = here / "scenes" / "die.toml"
        self.assert_warns("boundary 'die' travels through 4 cells", die, space__shape_functions='"linear"', boundary__1__velocity__1=-40.0)

    def test_domains_of_one_particle_a_cell(self):
        told = r"key 'space\.shape_functions': body 'comes' has one particle a cell"
        counts = {f"body__{n}__particles_per_cell": 1 for n in range(2)}
        self.assert_warns(told, space__shape_functions='"cpgimp"', **counts)
        for values in (dict(space__shape_functions='"gimp"', **counts), dict(space__shape_functions='"cpgimp"', **dict.fromkeys(counts, 4))):
            self.assertFalse(re.search(told, "\n".join(self.warnings(**values))), values)

    def test_wave_speed(self):
        self.assert_warns(r"--set 1: key 'material\.m\.young': waves travel at 0\.17\d+ m/s .*; "
                          r"young = 72: did you mean 72e9\?", material__m__young=72)
        self.assert_warns(r"young = 72000: did you mean 72000e6\?", material__m__young=72000)
        self.assert_warns(r"density = 2\.5: did you mean 2\.5e3\?", material__m__density=2.5)
        point = self.folder / "point.toml"
        point.write_text("[material.m]\ndensity=2500\nyoung=72\npoisson=0.2\n[path]\ntime=[0,1]\nstrain=[[0,0,0,0],[1e-6,0,0,0]]\n"
                         "size=1e-3\nsamples=2\n")
        self.assertRegex(self.vitrum("point", point).stderr, r"warning: \S+point\.toml:3:7: key 'material\.m\.young': .*72e9")

    def test_speeds(self):
        self.assert_warns(r"key 'body\.0\.velocity': bodies 'comes' and 'waits' move at 6000 m/s .* faster than waves in 'comes'",
                          body__0__velocity__0=6000.0)
        self.assert_warns("key 'body': nothing moves in this scene", body__0__velocity__0=0.0)
        self.assertEqual(self.warnings(body__0__velocity__0=0.0, gravity="{acceleration=[0,-9.81]}"), [])

    def test_a_disk_off_the_axis(self):
        torus = {"space__geometry": '"axisymmetric"', "body__0": "{name='t',material='m',disk={centre=[0.03,0],radius=0.005}}"}
        self.assert_warns(r"key 'body\.0\.disk': found a centre at r = 0\.03 m: about the axis it is a torus", **torus)
        torus["body__0"] = torus["body__0"].replace("[0.03,0]", "[0,-0.01]")
        self.assertFalse(any("torus" in line for line in self.warnings(**torus)))

    def test_bodies_that_meet_nothing(self):
        miss = r"body 'comes' flies with \(-?\d+, 0\) m/s and meets no other body and no boundary before time\.end"
        self.assert_warns(miss, body__0__velocity__0=-10.0, body__0__box="{min=[-0.005,0],max=[0.005,0.01]}")
        away = {"body__0__box": "{min=[-0.1,0],max=[-0.09,0.01]}"}
        self.assert_warns(miss, **away)
        self.assertEqual(self.warnings(time__end=11e-3, **away), [])
        self.assertEqual(self.warnings(body__0__velocity__0=-10.0, body__0__box="{min=[-0.005,0],max=[0.005,0.01]}",
                                       boundary="[{box={min=[-0.1,-1],max=[-0.0051,1]},fix=['x']}]"), [])

    def test_boundaries_that_no_body_is_at(self):
        idle = r"key .boundary\.0\.box.: boundary .* holds no node of a body, and no body heads for it"
        walls = 'boundary=[{{fix=["z"], box={{min=[{0}, {1}], max=[{2}, {3}]}}}}]'
        for box, expected in (((0.5, -1, 0.6, 1), True), ((0, -0.5, 1, -0.4), True), ((0, -1, 1, 0), False), ((0, 0.1, 1, 0.2), True)):
            for command in ("check", "run"):
                out = ("--out", self.folder / "out", "--force", "--set", "time.end=1e-7") if command == "run" else ()
                answer = self.vitrum(command, impact, *out, "--set", walls.format(*box)).stderr
                (self.assertRegex if expected else self.assertNotRegex)(answer, idle, box)

    def test_gaps_and_nodes(self):
        for functions, joins in (("linear", 0.75e-3), ("gimp", 1e-3), ("bspline2", 2e-3)):
            for gap in (0.0, 0.4e-3, 0.9e-3, 3.2e-3):
                box = f"{{min=[{-gap},0],max=[{0.01 - gap},0.01]}}"
                settings = {"space__shape_functions": f'"{functions}"', "body__0__box": box}
                facts = json.loads(self.vitrum("check", rods, "--json", *overrides(**settings)).stdout)
                (found,) = facts["gaps"]
                self.assertEqual(found["bodies"], ["comes", "waits"])
                self.assertAlmostEqual(found["gap"], gap, delta=1e-12)
                self.assertAlmostEqual(found["particle_gap"], gap + 0.5e-3, delta=1e-12)
                self.assertEqual(found["common_nodes"] > 0, gap < joins)
                told = [line for line in facts["warnings"] if "joins them from the start" in line]
                self.assertEqual(bool(told), 0.0 < gap < joins, (functions, gap))
        wall = overrides(boundary="[{box={min=[-1,-1],max=[1,0.0005]},fix=['y']},{box={min=[0.0203,-1],max=[1,1]},fix=['x']}]")
        facts = json.loads(self.vitrum("check", rods, "--json", *wall).stdout)
        self.assertEqual(facts["boundary_nodes"], [21, 0])
        self.assertIn("# boundary 'boundary.0': 21 nodes with mass\n", self.vitrum("check", rods, *wall).stdout)

    def test_a_tolerance_that_is_idle(self):
        idle = {"integrator__method": '"arkode-explicit"', "integrator__rtol": 0.1, "time__end": 40e-6}
        done = self.vitrum("run", rods, "--out", "out", "--no-fields", *overrides(**idle))
        (told,) = [line for line in read_summary(self.folder / "out")["warnings"] if "rtol" in line]
        self.assertRegex(told, r"key 'integrator\.rtol': rtol does not act: \d+ % of the steps are limited by stability")
        self.assertIn(told, done.stderr)
        for active in ({"integrator__rtol": 1e-5}, {"integrator__fixed_step": 1e-7}):
            self.vitrum("run", rods, "--out", "out", "--force", "--no-fields", *overrides(**{**idle, **active}))
            self.assertFalse(any("rtol" in line for line in read_summary(self.folder / "out")["warnings"]), active)


if __name__ == "__main__":
    unittest.main()
