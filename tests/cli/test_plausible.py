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

    def test_viscous_start_that_is_not_unique(self):
        told = r"material\.m\.decohesion\.q: with 0\.5, below 1, the traction falls infinitely fast at first"
        damage, keys = "{toughness=1e6, k=1e20, m=6}", "opening=1e-6, mode_ratio=1.0"
        self.assert_warns(told, material__m__damage=damage, material__m__decohesion=f"{{{keys}, q=0.5, viscosity=1e-7}}")
        for more in ("q=1.0, viscosity=1e-7", "q=0.5"):
            self.assertFalse(re.search(told, "\n".join(self.warnings(material__m__damage=damage, material__m__decohesion=f"{{{keys}, {more}}}"))), more)

    def test_a_duration_in_other_units(self):
        def told(**values):
            return [line for line in self.warnings(**values) if "key 'time.end'" in line]

        implicit = {"integrator": '{method = "arkode-implicit"}'}
        (found,) = told(time__end=10.0)  # rods of 10 mm in which waves travel at 5.66 km/s
        self.assertRegex(found, r"in 10 s a wave passes 5\.7e\+06 times through the largest body \(0\.01 m\); end = 10: did you mean 10e-6\?")
        (found,) = told(time__end=10.0, **implicit)
        self.assertRegex(found, r"what moves at 10 m/s goes 100 m, and the largest body has 0\.01 m; end = 10: did you mean 10e-6\?")
        for values in (dict(time__end=1e-2), dict(time__end=100.0, body__0__velocity__0=1e-4, **implicit)):
            self.assertEqual(told(**values), [])

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

    def assert_told(self, key, words, **values):
        """One warning of the key, with its words; none: of no key."""
        told = [line for line in self.warnings(**values) if words in line]
        self.assertEqual(len(told), 1 if key else 0, (values, told))
        self.assertTrue(all(f": key '{key}': " in line for line in told), told)

    def test_parts_that_add_nothing(self):
        """Within another, within two together, cut out, and the second of two that are the same; not one that reaches out."""
        idle = "found it adding nothing"

        def told(key, *parts, hole=()):
            values = {"body__0__box": "none", "body__0__union": f"[{', '.join(parts)}]", **({"body__0__hole": hole} if hole else {})}
            self.assert_told(key, idle, **values)

        def box(x, y, X, Y):
            return f"{{box = {{min = [{x}, {y}], max = [{X}, {Y}]}}}}"

        disk = "{disk = {centre = [0.004, 0.005], radius = 0.001}}"
        whole = box(0, 0, 0.01, 0.01)
        told("body.0.union.1.disk", whole, disk)
        told("body.0.union.0.disk", disk, whole)
        told("body.0.union.2.disk", box(0, 0, 0.004, 0.01), box(0.0035, 0, 0.01, 0.01), disk)
        told("body.0.union.1.box", whole, whole)
        told("body.0.union.1.disk", box(0.006, 0, 0.01, 0.01), disk, hole="{disk = {centre = [0.004, 0.005], radius = 0.0015}}")
        told("body.0.union.0.box", box(0.002, 0.002, 0.004, 0.004)[:-1] + ", hole = {disk = {centre = [0.003, 0.003], radius = 0.0029}}}", box(0, 0, 0.002, 0.002))
        told("", box(0, 0, 0.0045, 0.01), disk)
        told("", whole, disk.replace("0.005]", "0.01]"))

    def test_holes_that_cut_nothing_out(self):
        def told(key, words, *holes):
            self.assert_told(key, words, body__0__hole=f"[{', '.join(holes)}]")

        def disk(x, radius):
            return f"{{disk = {{centre = [{x}, 0.005], radius = {radius}}}}}"

        told("body.0.hole.0.disk", "found it outside 'body.0.box'", disk(0.03, 0.001))
        told("body.0.hole.0.disk", "found it outside 'body.0.box'", disk(-0.001, 0.001))  # touches it
        told("body.0.hole.1.disk", "found it within other holes", disk(0.005, 0.002), disk(0.005, 0.0015))
        told("body.0.hole.1.disk", "found it within other holes", disk(0.005, 0.002), disk(0.005, 0.002))
        told("body.0.hole.1.disk", "found it within other holes", disk(0.004, 0.002), disk(0.005, 0.0015), disk(0.006, 0.002))
        told("body.0.hole.0.disk", "found it 6e-08 m wide, less than a cell", disk(0.005, 3e-8))  # 3e-11 of the body
        told("body.0.hole.0.disk", "found it 2e-10 m wide, less than a cell", disk(0.005, 1e-10))
        told("body.0.hole.0.disk", "found it outside", disk(0.03, 3e-8))
        told("body.0.hole.0.disk", "found it 0.0008 m wide, less than a cell (0.001 m)", disk(0.005, 0.0004))
        for words in ("less than a cell", "outside", "within other holes"):
            told("", words, disk(0.005, 0.0006))
            told("", words, disk(-0.0019, 0.002))  # a notch
            told("", words, disk(0.004, 0.0012), disk(0.006, 0.0012))  # which overlap

    def test_holes_of_bodies_of_parts(self):
        """Seen from a hole, the parts that it does not touch are not there."""
        def told(key, words, *holes, parts=("min = [0, 0], max = [0.004, 0.01]", "min = [0.004, 0], max = [0.01, 0.01]")):
            union = ", ".join(f"{{box = {{{part}}}}}" for part in parts)
            self.assert_told(key, words, body__0__box="none", body__0__union=f"[{union}]", body__0__hole=f"[{', '.join(holes)}]")

        disk = "{{disk = {{centre = [{}, 0.005], radius = {}}}}}".format
        told("body.0.hole.0.disk", "found it outside 'body.0.union'", disk(0.03, 0.001))
        told("body.0.hole.1.disk", "found it within other holes", disk(0.004, 0.002), disk(0.005, 0.0009))
        told("", "expected it to cut something out", disk(0.002, 0.001), disk(0.004, 0.0015), disk(0.008, 0.001))

    def test_many_holes(self):
        """What is told of some does not depend on how many there are, nor do others become idle by it; 400 of 20 by 20, of which each tenth is there twice."""
        centres = [((n % 20 + 0.5) * 5e-4, (n // 20 + 0.5) * 5e-4) for n in range(400)]
        holes = ", ".join(f"{{disk = {{centre = [{x:.6g}, {y:.6g}], radius = 2e-4}}}}" for x, y in centres + centres[::10])
        scene = self.folder / "holes.toml"
        scene.write_text(rods.read_text().replace("[[body]]", f"[[body]]\nhole = [{holes}]", 1))
        found = [int(number) for line in self.warnings(scene) for number in re.findall(r"body\.0\.hole\.(\d+)\.disk': found it within other holes", line)]
        self.assertEqual(found, list(range(400, 440)))
        self.assertFalse(any("found it outside" in line for line in self.warnings(scene)))

    def test_loads_that_never_come(self):
        loaded = here / "scenes" / "loaded.toml"
        pulse, idle = "traction__1__friedlander", "nothing of it acts"
        for key, words, values in (
                ("traction.1.friedlander", idle, {f"{pulse}__arrival": 12e-6}), ("traction.1.friedlander", idle, {f"{pulse}__arrival": -9e-6}), ("", idle, {f"{pulse}__arrival": 11.9e-6}),
                ("traction.1.blast", "the pulse arrives at", {pulse: "none", "traction__1__blast": "{charge = 1, standoff = 5}"}),
                ("", idle, {pulse: "none", "traction__1__blast": "{charge = 1, standoff = 5, arrival = 0}"}),
                ("traction.0.pressure", "it is 0 from the start", {"traction__0__pressure": "{table = [[0, 0], [1, 0]]}"}),
                ("traction.0.pressure", "it is 0 at all of the 1001 times that were tried from the start", {"traction__0__pressure": '"=p*(t > 12.1*us)"'}),
                ("traction.0.pressure", "it is 0 at all of the 1001 times", {"traction__0__pressure": '"=p*(t > 5.005*us && t < 5.015*us)"'}),  # it acts: 10 ns between two of them
                ("", "it is 0", {"traction__0__pressure": '"=p*(t > 11.99*us)"'}), ("", "it is 0", {"traction__0__pressure": '"=p*t*(r < 0.1*mm)"'}),
                ("boundary.0.velocity.1", "it is 0 from the start", {"boundary__0__velocity": "[0, {table = [[0, 0], [1, 0]]}]"}),
                ("", "it is 0", {"boundary__0__velocity": "[0, {table = [[1e-9, 0], [2e-9, 1], [3e-9, 0]]}]"}),
                ("gravity.acceleration.1", "its table is of 2e-05 to 1 s and the run of 0 to 1.2e-05 s: it stays -3", {"gravity__acceleration": "[0, {table = [[20e-6, -3], [1, 0]]}]"}),
                ("", "its table is of", {"gravity__acceleration": "[0, {table = [[11e-6, -3], [1, 0]]}]"})):
            with self.subTest(values):
                self.assert_told(key, words, scene=loaded, **values)
        self.assertFalse(any(words in line for words in (idle, "it is 0", "its table") for line in self.warnings(loaded)))

    def test_flaws_beyond_all_measure(self):
        """Of a hundred particles the strongest but one over the weakest but one: (ln 0.01 / ln 0.99)^(1 / modulus)."""
        key = "material.m.damage.scatter"

        def flaws(modulus, volume=1e-7):
            return {"material__m__damage": f"{{toughness = 0.83e6, k = 5.0e26, m = 6, scatter = {{modulus = {modulus}, volume = {volume}}}}}", "body__1__material": '"n"',
                    "material__n": "{density = 2500.0, young = 72e9, poisson = 0.2}"}

        self.assert_told(key, "with modulus = 1.3 one particle in a hundred of body 'comes' bears 111 times what", **flaws(1.3))
        self.assert_told("", "particle", **flaws(1.4))
        self.assert_told(key, "half of the particles of body 'comes' bear more than 44.5 times the law's strength: that is of a volume of 0.5 m^3, and a particle has 2.5e-07 m^3", **flaws(3.725, 0.5))
        self.assert_told(key, "bear less than 0.0303 times", **flaws(3.0, 1e-11))

    def test_units_that_slipped(self):
        def told(key, words, **values):
            self.assert_told(key, words, **values)

        thin = {"body__0__box": "{min=[0,0],max=[0.01,0.00099]}"}
        told("space.cell", "body 'comes' is 0.00099 m wide, less than a cell (0.001 m)", **thin)
        told("", "less than a cell", **{"body__0__box": "{min=[0,0],max=[0.01,0.001]}"})
        told("output.every", "1e+07 outputs take about ", output__every=1e-12)
        told("", "outputs take", output__every=1e-9)
        for key in ("every", "history_every", "checkpoint_every"):
            told(f"output.{key}", "1.1 s is longer than the run (0.01 s)", time__end=0.01, body__0__velocity__0=1.0, **{f"output__{key}": 1.1})
            told("", "is longer than the run", time__end=0.01, body__0__velocity__0=1.0, **{f"output__{key}": 0.9})
        told("body.0.stress", "-7.3e+09 Pa is more than a tenth of the modulus of body 'comes' (7.2e+10 Pa)", body__0__stress="[1e6, 0, -7.3e9, 0]")
        told("", "a tenth of the modulus", body__0__stress="[1e6, 0, -7.1e9, 0]")
        for load, key in (("pressure = -1e10", "pressure"), ("vector = [0, 1e10]", "vector"), ("friedlander = {pressure = 1e10, duration = 1e-6, decay = 1}", "friedlander")):
            told(f"traction.0.{key}", "1e+10 Pa is more than a tenth of the modulus", traction=f"[{{body='waits', side='right', {load}}}]")
        told("gravity.acceleration.1", "the run takes 1e-05 s, 1e-05 of the 1 s of its table", gravity="{acceleration = [0, {table = [[0, 1], [1, 2]]}]}")
        told("", "of its table", gravity="{acceleration = [0, {table = [[0, 1], [9e-3, 2]]}]}")
        told("material.m.damage.toughness", "did you mean 0.83e6?", material__m__damage="{toughness = 0.83, k = 5.0e26, m = 6}")
        told("material.m.von_mises.yield", "found 300 Pa, expected 7.2e+04 to 1.44e+10; did you mean 300e6?", material__m__von_mises="{yield = 300, peak = 300, hardening = 0, softening = 0}")
        told("material.m.drucker_prager.yield", "did you mean 300e6?", material__m__drucker_prager="{yield = 300, beta = 1.8}")
        for cohesionless in (1e-3, 1.0, 7.0, 7e4):
            told("", "drucker_prager.yield", material__m__drucker_prager=f"{{yield = {cohesionless}, beta = 1.8}}")
        told("material.m.drucker_prager.yield", "found 2e+10 Pa", material__m__drucker_prager="{yield = 2e10, beta = 1.8}")
        told("material.m.poisson", "waves travel at 2.191e+06 m/s", material__m__poisson=0.499999)
        told("material.m.poisson", "waves travel at 2.191e+05 m/s in this material, expected 100 to 20000 m/s", material__m__poisson=0.4999)
        told("", "did you mean", material__m__poisson=0.4999)

    def test_a_tolerance_that_is_idle(self):
        idle = {"integrator__method": '"arkode-explicit"', "integrator__rtol": 0.1, "time__end": 40e-6}
        done = self.vitrum("run", rods, "--out", "out", "--no-fields", *overrides(**idle))
        (told,) = [line for line in read_summary(self.folder / "out")["warnings"] if "rtol" in line]
        self.assertRegex(told, r"key 'integrator\.rtol': rtol does not act: \d+ % of the steps are limited by stability")
        self.assertIn(told, done.stderr)
        for active in ({"integrator__rtol": 1e-5}, {"integrator__fixed_step": 1e-7}):
            self.vitrum("run", rods, "--out", "out", "--force", "--no-fields", *overrides(**{**idle, **active}))
            self.assertFalse(any("rtol" in line for line in read_summary(self.folder / "out")["warnings"]), active)

    def test_factors_of_many_unknowns(self):
        told = r"key 'integrator\.linear_solver': KLU takes most of a step with (\d+) unknowns; .*\"gmres\" .*\"diagonal\""
        bar = source / "studies" / "performance" / "elastic_bar.toml"
        waves = {"integrator__method": '"arkode-implicit"', "space__cell": 0.1e-3}
        self.assert_warns(told, bar, **waves)
        (unknowns,) = re.findall(told, "\n".join(self.warnings(bar, **waves)))
        self.assertEqual(int(unknowns), 2 * 51 * 251)  # nodes of 50 x 250 cells
        self.assertIn('elastic_bar.toml:13:1: key', self.vitrum("check", bar, *overrides(**waves)).stderr)
        fewer = {"space__cell": 0.125e-3}  # 2 x 41 x 201 unknowns
        slow = {"body__0__velocity__1": -7.0}  # a wave of the strain scale moves particles at 5.9 m/s
        for change in (fewer, slow, {"integrator__linear_solver": '"gmres"'}, {"integrator__fixed_step": 1e-6}, {"integrator__method": '"explicit"'}):
            self.assertFalse(re.search(told, "\n".join(self.warnings(bar, **{**waves, **change}))), change)


if __name__ == "__main__":
    unittest.main()
