"""`vitrum check` of scenes that are valid."""
import json
import math
import resource
import tomllib
import unittest

from support import CommandLineTest, impact, overrides, plane_strain, source, told


class Check(CommandLineTest):
    def resolved(self, scene, *arguments):
        return tomllib.loads(self.vitrum("check", scene, *arguments).stdout)

    def test_the_answer_is_a_scene(self):
        scene = tomllib.loads(impact.read_text())
        resolved = self.resolved(impact)
        self.assertEqual(resolved["title"], scene["title"])
        self.assertEqual([body["name"] for body in resolved["body"]], ["plate", "cylinder"])
        self.assertEqual(resolved["integrator"]["max_growth"], 1.5)  # a default is filled in

    def test_the_answer_resolves_to_itself(self):
        for scene in (impact, plane_strain, source / "studies" / "paper" / "reference.toml"):
            text = self.vitrum("check", scene).stdout
            again = self.folder / "again.toml"
            again.write_text(text)
            self.assertEqual(self.resolved(scene), self.resolved(again))

    def test_overrides(self):
        changed = self.resolved(impact, *overrides(space__cell=5e-4, body__1__velocity__1=-50.0, title='"a=b"',
                                                   integrator__courant=0.2))
        self.assertEqual(changed["space"]["cell"], 5e-4)
        self.assertEqual(changed["body"][1]["velocity"], [0.0, -50.0])
        self.assertEqual(changed["title"], "a=b")
        self.assertEqual(changed["integrator"]["courant"], 0.2)
        self.assertNotIn("step", changed["integrator"])
        back = self.resolved(impact, *overrides(integrator__courant=0.2, integrator__step=1e-8))
        self.assertEqual(back["integrator"]["step"], 1e-8)
        self.assertNotIn("courant", back["integrator"])

    def test_json(self):
        facts = json.loads(self.vitrum("check", impact, "--json").stdout)
        self.assertEqual(facts["particles"], 200)
        self.assertEqual(facts["steps"], 1000)
        self.assertEqual(facts["bodies"]["plate"]["particles"], 100)
        self.assertAlmostEqual(facts["bodies"]["plate"]["mass"], 2500 * 3.14159265 * 0.02**2 * 0.005, delta=1e-8)
        # Wave speed of a P wave: sqrt(young (1 - nu) / (density (1 + nu) (1 - 2 nu))).
        self.assertAlmostEqual(facts["bodies"]["cylinder"]["wave_speed"], 5477.2256, delta=1e-3)
        self.assertAlmostEqual(facts["step_to_critical"], facts["step"] / facts["critical_step"])
        self.assertIsInstance(facts["warnings"], list)
        self.assertEqual(tomllib.loads(facts["resolved"]), self.resolved(impact))

    def test_mass_is_that_of_the_shape(self):
        for shape, volume in (("disk={centre=[0,0.0071],radius=0.0009}", 4 / 3 * math.pi * 0.0009**3),
                              ("disk={centre=[0,0.0113],radius=0.005}", 4 / 3 * math.pi * 0.005**3),
                              ("ring={centre=[0.0052,0.0102],inner=0.0021,outer=0.0038}",
                               2 * math.pi * 0.0052 * math.pi * (0.0038**2 - 0.0021**2)),
                              ("polygon=[[0,0.0061],[0.0043,0.0061],[0,0.0124]]", math.pi / 3 * 0.0043**2 * 0.0063)):
            for per_cell in (1, 4, 9, 16):
                table = f"{{name='c',material='steel',{shape},particles_per_cell={per_cell}}}"
                facts = json.loads(self.vitrum("check", impact, "--json", "--set", f"body.1={table}").stdout)["bodies"]["c"]
                for mass in (facts["mass"], facts["exact_mass"]):
                    self.assertAlmostEqual(mass / (7800 * volume), 1, delta=1e-6, msg=shape)

    def test_a_step_beyond_the_critical_one_is_warned_of(self):
        answer = self.vitrum("check", impact, *overrides(integrator__step=2e-7))
        self.assertRegex(answer.stderr, r"warning: --set 1: key 'integrator\.step': 2e-07 s is 1\.\d+ times the critical step")
        self.assertNotIn("integrator.step", self.vitrum("check", impact).stderr)
        facts = json.loads(self.vitrum("check", impact, "--json", *overrides(integrator__step=2e-7)).stdout)
        self.assertEqual([f"warning: {line}" for line in facts["warnings"]], told(answer.stderr))
        courant = self.vitrum("check", impact, *overrides(integrator__courant=5.0))
        self.assertRegex(courant.stderr, r"warning: --set 1: key 'integrator\.courant': .* is 5 times the critical step")

    def test_boxes_without_a_node_are_warned_of(self):
        for command in ("check", "run"):
            out = ("--out", self.folder / "out") if command == "run" else ()
            answer = self.vitrum(command, impact, *out, "--set", 'boundary=[{name="die", fix=["z"], box={min=[0, 0.0051], max=[1, 0.0054]}}]')
            self.assertRegex(answer.stderr, r"warning: --set 1: key .boundary\.0\.box.: boundary 'die' holds no node: .* nearest is at z = 0\.005")
        self.assertNotIn("holds no node", self.vitrum("check", impact).stderr)

    def test_error_controlled_local_methods_take_longer(self):
        """What a run takes lies between the two figures; processor seconds, whatever else the machine does, and half a one to begin and end in."""
        for method, slower in (("closed-form", 1.0), ("substep", 3.0), ("cvode", 10.0)):
            with self.subTest(method):
                settings = overrides(constitutive__method=f'"{method}"')
                facts = json.loads(self.vitrum("check", impact, *settings, "--json").stdout)
                before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
                self.run_scene("out", *settings, *overrides(output__every="none"), "--threads", 1, "--force")
                took = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
                self.assertGreaterEqual(facts["seconds_most"], slower * facts["seconds"])
                self.assertGreater(took, 0.2 * facts["seconds"])
                self.assertLess(took, 2.0 * facts["seconds_most"] + 0.5)
                text = self.vitrum("check", impact, *settings).stdout
                self.assertEqual("measured now" in text, method != "closed-form")

    def test_a_decohesion_that_nothing_begins_is_warned_of(self):
        path = self.folder / "steel.toml"
        path.write_text(plane_strain.read_text() + "\n[material.steel.decohesion]\nopening = 5e-6\nmode_ratio = 1.0\n")
        for softening, warned in ((0.0, True), (1e9, False)):
            for arguments in (("check", path), ("run", path, "--out", self.folder / str(warned))):
                answer = self.vitrum(*arguments, *overrides(material__steel__von_mises__softening=softening))
                self.assertEqual("material.steel.decohesion: it can never begin" in answer.stderr, warned)
        self.assertNotIn("can never begin", self.vitrum("check", impact).stderr)

    def test_nothing_is_written(self):
        self.vitrum("check", impact)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
