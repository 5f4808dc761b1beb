"""`vitrum point`: rows, events, numbers."""
import re
import unittest

from support import CommandLineTest, glass_point, overrides, read_csv

header = "t,e_rr,e_zz,e_tt,e_rz,s_rr,s_zz,s_tt,s_rz"
# The state variables that the interface names, in its order; others may follow them, and `dissipated` ends the row.
variables = ["damage", "crack_density", "max_rate", "plastic_strain", "decohesion", "opening_n", "opening_t", "normal_r",
             "normal_z"]
# Onset of localisation in uniaxial strain at a mean rate of 1e3 /s.
strain, stress = 1.471237e-3, 108.09e6

elastic = """
[material.glass]
density = 2500
young = 72e9
poisson = 0.25
[path]
time = [0.0, 1e-6, 2e-6]
strain = [[0, 0, 0, 0], [1e-4, 2e-4, 0, 3e-5], [0, 0, 0, 0]]
size = 1e-3
samples = 3
"""


def events(text):
    return {name: float(time) for name, time in re.findall(r"^event (\w+) t=(\S+)$", text, re.MULTILINE)}


class Point(CommandLineTest):
    def drive(self, path, *arguments):
        out = self.folder / "point.csv"
        answer = self.vitrum("point", path, "--out", out, *arguments)
        self.assertEqual(answer.stdout, "")
        return read_csv(out), events(answer.stderr)

    def test_header_of_a_material_with_every_model(self):
        names = self.vitrum("point", glass_point).stdout.splitlines()[0].split(",")
        self.assertEqual(names[:9], header.split(","))
        self.assertEqual(names[9:9 + len(variables)], variables)
        self.assertEqual(names[-1], "dissipated")

    def test_elastic_path(self):
        path = self.folder / "elastic.toml"
        path.write_text(elastic)
        lines = self.vitrum("point", path).stdout.splitlines()
        self.assertEqual(lines[0], header + ",dissipated")
        self.assertEqual(len(lines), 1 + 1 + 2 * 3)
        rows, fired = self.drive(path)
        self.assertEqual(fired, {})
        self.assertEqual(rows["t"][[0, 3, 6]].tolist(), [0.0, 1e-6, 2e-6])
        lame, shear = 28.8e9, 28.8e9  # of 72 GPa and 0.25
        for name, e in (("s_rr", 1e-4), ("s_zz", 2e-4), ("s_tt", 0.0)):
            self.assertAlmostEqual(rows[name][3], lame * 3e-4 + 2 * shear * e, delta=1e-6 * 1e7)
        self.assertAlmostEqual(rows["s_rz"][3], 2 * shear * 3e-5, delta=1.0)
        self.assertAlmostEqual(rows["s_rr"][6], 0.0, delta=1e-2)
        self.assertEqual(rows["dissipated"].tolist(), [0.0] * 7)

    def test_glass_localises_where_theory_says(self):
        _, fired = self.drive(glass_point)
        self.assertAlmostEqual(fired["localisation"] * 3e3, strain, delta=1e-9)
        rows, fired = self.drive(glass_point, *overrides(path__time__1=strain / 3e3, path__strain__1__0=strain - 1e-9))
        self.assertNotIn("localisation", fired)
        self.assertAlmostEqual(rows["s_rr"][-1], stress, delta=1e-4 * stress)
        self.assertTrue(all(rows["decohesion"] == 0.0))

    def test_glass_separates_at_the_end(self):
        rows, fired = self.drive(glass_point, *overrides(path__time__1=1e-5, path__strain__1__0=3e-2))
        self.assertEqual(list(fired), sorted(fired, key=fired.get))
        self.assertLess(fired["damage"], fired["localisation"])
        self.assertLess(fired["localisation"], fired["separation"])
        self.assertEqual(rows["decohesion"][-1], 1.0)
        self.assertAlmostEqual(rows["s_rr"][-1], 0.0, delta=1e-3)
        self.assertAlmostEqual(abs(rows["normal_r"][-1]), 1.0, delta=1e-6)
        self.assertGreater(rows["opening_n"][-1], 5e-6)
        self.assertTrue(all(rows["dissipated"][1:] >= rows["dissipated"][:-1] - 1e-9))

    def test_errors(self):
        text = glass_point.read_text()
        for change, expected in (
            (("time = [0.0, 1.0e-6]", "time = [0.0, 0.0]"), r"path\.time.*increasing"),
            (("time = [0.0, 1.0e-6]", "time = [0.0, 1.0e-6, 2.0e-6]"), r"path\.strain"),
            (("[3.0e-3, 0, 0, 0]", "[3.0e-3, 0, 0]"), r"path\.strain.*4"),
            (("size = 1.0e-3", "size = 0.0"), r"path\.size"),
            (("size = 1.0e-3", ""), r"path\.size"),
            (("samples = 400", "samples = 0"), r"path\.samples"),
            (("samples = 400", "sample = 400"), r"did you mean 'samples'"),
            (("[path]", "[space]\ncell = 1\n[path]"), r"space"),
            (("young = 72.0e9", "young = -1.0"), r"material\.glass\.young"),
        ):
            with self.subTest(change=change[1]):
                self.assertIn(change[0], text)
                path = self.folder / "wrong.toml"
                path.write_text(text.replace(*change))
                answer = self.vitrum("point", path, "--out", self.folder / "point.csv", status=2)
                self.assertRegex(answer.stderr, r"error: \S*wrong\.toml(:\d+:\d+)?: .*" + expected)
                self.assertFalse((self.folder / "point.csv").exists())

    def test_a_contradictory_state_is_refused(self):
        plane = {"normal_r": "1.0", "effective_length": "1e-3", "cohesive_strength": "1e8"}
        wrong = (
            (plane | {"normal_r": "2.0"}, r"normal_r': found a normal \(2\.0, 0\.0\) of length 2, expected a unit vector"),
            (plane | {"normal_z": "0.5"}, r"normal_r': found a normal \(1\.0, 0\.5\) of length 1\.118"),
            ({"decohesion": "0.5"}, r"decohesion': found 0\.5, expected 0: the point is not localised"),
            ({"normal_r": "1.0"}, r"normal_r': found 1\.0, expected 0: the point is not localised"),
            ({"opening_n": "1e-6"}, r"opening_n': .* expected 0: the point is not localised"),
            ({"cohesive_strength": "1e8"}, r"cohesive_strength': .* not localised"),
            ({"effective_length": "1e-3", "cohesive_strength": "1e8"}, r"effective_length': found a localised point without a normal"),
            (plane | {"cohesive_strength": "0.0"}, r"cohesive_strength': found 0\.0 on a plane that has not separated"),
            (plane | {"opening_n": "1e-6"}, r"opening_n': .* decohesion is 0"),
            (plane | {"opening_t": "1e-6"}, r"opening_t': .* decohesion is 0"),
            (plane | {"decohesion": "1.0", "opening_n": "-1e-6"}, r"opening_n': .* do not penetrate"),
        )
        for method in ("closed-form", "substep", "cvode"):
            for state, expected in wrong:
                with self.subTest(method=method, expected=expected):
                    lines = "".join(f"{name} = {value}\n" for name, value in state.items())
                    path = self.folder / "state.toml"
                    path.write_text(f"{glass_point.read_text()}[state]\n{lines}[constitutive]\nmethod = \"{method}\"\n")
                    answer = self.vitrum("point", path, status=2)
                    self.assertRegex(answer.stderr, r"error: \S*state\.toml:\d+:\d+: key 'state\." + expected)

    def test_a_state_of_models_that_are_not_there_is_refused(self):
        for name, model in (("crack_density", "damage"), ("plastic_strain", "yield surface"), ("decohesion", "decohesion")):
            path = self.folder / "state.toml"
            path.write_text(f"{elastic}[state]\n{name} = 0.1\n")
            answer = self.vitrum("point", path, status=2)
            self.assertRegex(answer.stderr, rf"error: \S*state\.toml:\d+:\d+: key 'state\.{name}': found 0\.1, "
                                            rf"expected 0: the material has no {model}")

    def test_a_localised_state_is_taken(self):
        path = self.folder / "state.toml"
        path.write_text(f"{glass_point.read_text()}[state]\nnormal_r = 0.6\nnormal_z = -0.8\neffective_length = 1e-3\n"
                        "cohesive_strength = 1e8\ndecohesion = 0.5\nopening_n = 2e-6\n")
        rows, _ = self.drive(path)
        self.assertGreaterEqual(rows["decohesion"][0], 0.5)

    def test_an_initial_tension_is_judged_when_nothing_moves(self):
        # Uniaxial strain of 2e-4 at 1 /s: beyond the onset (1.47e-4), where damage stops at .2013.
        path = self.folder / "hold.toml"
        hold = glass_point.read_text().replace("[3.0e-3, 0, 0, 0]", "[0, 0, 0, 0]")
        for method in ("closed-form", "substep", "cvode"):
            with self.subTest(method=method):
                path.write_text(f"{hold}[state]\nelastic_strain = [2e-4, 0, 0, 0]\n[constitutive]\nmethod = \"{method}\"\n")
                rows, fired = self.drive(path)
                self.assertEqual(fired, {"damage": 0.0, "localisation": 0.0})
                self.assertAlmostEqual(rows["damage"][0], 0.2013, delta=2e-4)
                self.assertEqual(rows["damage"][-1], rows["damage"][0])
                self.assertEqual(rows["decohesion"][-1], 0.0)
                energy = 0.5 * 86.4e9 * 2e-4**2
                self.assertAlmostEqual(rows["dissipated"][0] + 0.5 * rows["s_rr"][0] * 2e-4, energy, delta=1e-9 * energy)

    def test_a_decohesion_that_nothing_begins_is_warned_of(self):
        text = elastic.replace("[path]", "[material.glass.decohesion]\nopening = 5e-6\nmode_ratio = 1\n[path]")
        path = self.folder / "idle.toml"
        path.write_text(text)
        warning = "warning: material.glass.decohesion: it can never begin"
        self.assertIn(warning, self.vitrum("point", path).stderr)
        steel = "[material.glass.von_mises]\nyield = 4e8\npeak = 5e8\nhardening = 1e10\nsoftening = "
        for softening, warned in ((0.0, True), (1e10, False)):
            path.write_text(f"{steel}{softening}\n{text}")
            self.assertEqual(warning in self.vitrum("point", path).stderr, warned)
        path.write_text(text + "[state]\neffective_length = 1e-3\nnormal_r = 1.0\ncohesive_strength = 1e8\n")
        self.assertNotIn("warning", self.vitrum("point", path).stderr)

    def test_unwritable_file(self):
        for path in (self.folder / "missing" / "point.csv", self.folder, "/dev/full"):
            answer = self.vitrum("point", glass_point, "--out", path, status=4)
            self.assertRegex(answer.stderr, "error: .*cannot be written")


if __name__ == "__main__":
    unittest.main()
