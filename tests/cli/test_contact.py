"""Bodies with velocity fields of their own: what a scene says, and what a run keeps of it."""
import csv
import json
import re
import unittest

import h5py
import numpy as np

from support import CommandLineTest, here, overrides, read_csv, read_summary

slide = here / "scenes" / "slide.toml"
rods = here / "scenes" / "rods.toml"
corner = here / "scenes" / "corner.toml"
ends = here / "scenes" / "ends.toml"
impact = here / "scenes" / "impact.toml"


class Contact(CommandLineTest):
    def fields(self, out):
        with h5py.File(out / "result.h5") as result:
            return {f"{step}/{name}": data[()].tobytes() for step in result["steps"]
                    for name, data in result[f"steps/{step}/particles"].items()}

    def test_bits(self):
        """Threads and an interruption change nothing."""
        for method in ("explicit", "arkode-explicit", "arkode-implicit"):
            run = ("--set", f'integrator.method="{method}"', *overrides(time__end=20e-6, output__checkpoint_every=10e-6))
            whole = self.run_scene(f"whole-{method}", *run, "--threads", "1", scene=slide)
            fields, energy = self.fields(whole), read_summary(whole)["energy"]
            shared = self.run_scene(f"shared-{method}", *run, "--threads", "3", scene=slide)
            self.assertEqual(self.fields(shared), fields)
            self.assertEqual(read_summary(shared)["energy"], energy)
            (whole / "summary.json").unlink()
            self.vitrum("run", slide, "--out", whole, *run, "--resume")
            self.assertEqual(self.fields(whole), fields)
            resumed = read_summary(whole)
            self.assertEqual(resumed["energy"], energy)
            self.assertEqual(resumed["contacts"], read_summary(shared)["contacts"])

    def test_fragments(self):
        """Fragments come off at the same step, with the same bits, for any threads and after an interruption."""
        for method in ("explicit", "arkode-explicit", "arkode-implicit"):
            run = ("--set", f'integrator.method="{method}"', "--set", 'contact.method="bodies"',
                   *overrides(contact__self="true", contact__friction=0.2, output__every=6e-6, output__checkpoint_every=6e-6, time__end=12e-6))
            whole = self.run_scene(f"pieces-{method}", *run, "--threads", "1", scene=impact)
            fields, summary = self.fields(whole), read_summary(whole)
            shared = self.run_scene(f"pieces-shared-{method}", *run, "--threads", "3", scene=impact)
            self.assertEqual(self.fields(shared), fields)
            (whole / "summary.json").unlink()
            self.vitrum("run", impact, "--out", whole, *run, "--resume")
            self.assertEqual(self.fields(whole), fields)
            resumed = read_summary(whole)
            self.assertEqual(resumed["energy"], summary["energy"])
            self.assertEqual(resumed["contacts"], summary["contacts"])
            pieces = [pair for pair in summary["contacts"] if pair["bodies"] == ["plate", "plate"]]
            self.assertEqual(len(pieces), 1)
            self.assertEqual(pieces[0]["impulse"], [0.0, 0.0])

    def test_account(self):
        out = self.run_scene("out", scene=slide)
        summary, rows = read_summary(out), read_csv(out / "energy.csv")
        energy, (pair,) = summary["energy"], summary["contacts"]
        self.assertLess(abs(energy["relative_residual"]), 0.01)
        self.assertGreater(energy["friction"], 10.0)
        self.assertGreaterEqual(np.min(np.diff(rows["friction"])), 0.0)
        self.assertGreater(np.max(rows["contact"]), 1.0)
        self.assertEqual(pair["bodies"], ["plate", "block"])
        self.assertAlmostEqual(pair["friction_work"], energy["friction"], delta=1e-9)
        with open(out / "contacts.csv") as file:
            table = list(csv.DictReader(file))
        self.assertEqual([table[-1]["body_a"], table[-1]["body_b"]], pair["bodies"])
        self.assertEqual([float(table[-1][name]) for name in ("impulse_r", "impulse_z", "friction_work", "least_gap")],
                         [*pair["impulse"], pair["friction_work"], pair["least_gap"]])
        # The block's momentum has changed by what it has given to the plate.
        block = summary["bodies"]["block"]
        start = block["mass"] * np.array([60.0, -20.0])
        np.testing.assert_allclose(start - block["momentum"], pair["impulse"], rtol=1e-9, atol=1e-12)
        self.assertLess(-0.25e-3, pair["least_gap"])
        self.assertLess(pair["least_gap"], 0.0)

    def test_warning(self):
        """Who says nothing is told that bodies are welded; who says `single` means it."""
        bare = self.folder / "bare.toml"
        bare.write_text(rods.read_text().replace('[contact]\nmethod = "single"', ""))
        warned = json.loads(self.vitrum("check", bare, "--json").stdout)["warnings"]
        self.assertRegex("\n".join(warned), r"bare\.toml:\d+:\d+: key 'body\.1': bodies 'comes' and 'waits' are welded where they meet: "
                                            r".*contact\.method = \"bodies\"")
        self.assertRegex(self.vitrum("run", bare, "--out", "bare").stderr, "welded")
        for method in ("single", "bodies"):
            said = json.loads(self.vitrum("check", bare, "--json", "--set", f'contact.method="{method}"').stdout)["warnings"]
            self.assertFalse(any("welded" in line for line in said), said)
        apart = json.loads(self.vitrum("check", bare, "--json", *overrides(body__0__velocity__0=-1.0, body__0__box__min__0=-0.02, body__0__box__max__0=-0.01)).stdout)["warnings"]
        self.assertFalse(any("welded" in line for line in apart), apart)

    def test_malformed(self):
        pair = "[{{bodies=[{}], friction=0.1}}]"
        for value, message in (('"plate"', "expected a list of the names of two bodies"), ('"plate","plate"', "expected every entry once"),
                               ('"plate","blok"', 'found "blok", expected one of "plate", "block"; did you mean \'block\'?')):
            answer = self.vitrum("check", slide, "--set", "contact.pair=" + pair.format(value), status=2)
            self.assertIn(message, answer.stderr)
        twice = '[{bodies=["plate","block"],friction=0.1},{bodies=["block","plate"],friction=0.1}]'
        self.assertIn("no other [[contact.pair]]", self.vitrum("check", slide, "--set", "contact.pair=" + twice, status=2).stderr)
        for key, value in (("friction", -0.1), ("stiffness", 0.0), ("depth", 3.0), ("method", '"glue"')):
            self.assertIn(f"contact.{key}", self.vitrum("check", slide, "--set", f"contact.{key}={value}", status=2).stderr)

    def test_pairs(self):
        """A pair's friction is its own."""
        work = {}
        for friction in (0.0, 0.1):
            out = self.run_scene(f"pair-{friction}", "--set",
                                 f'contact.pair=[{{bodies=["block","plate"], friction={friction}}}]', scene=slide)
            work[friction] = read_summary(out)["energy"]["friction"]
        self.assertEqual(work[0.0], 0.0)
        self.assertGreater(work[0.1], 1.0)
        compared = json.loads(self.vitrum("compare", "pair-0.0", "pair-0.1", "--json").stdout)["quantities"]
        rubbed = compared["contacts.0.friction_work"]
        self.assertEqual((rubbed["a"], rubbed["unit"]), (0.0, "J/m"))
        self.assertAlmostEqual(rubbed["b"] / work[0.1], 1.0, places=9)
        self.assertEqual(compared["contacts.0.least_gap"]["unit"], "m")

    def test_fast_bodies_do_not_pass_through_each_other(self):
        """Glass on glass at 0.44 of the speed of waves: the shallow depth that suits slow contact bears less than the impact, and says so."""
        def speeds(name, *more):
            summary = read_summary(self.run_scene(name, *more, scene=here / "scenes" / "fast.toml"))
            return [summary["bodies"][body]["momentum"][1] / summary["bodies"][body]["mass"] for body in "ab"], summary["warnings"]
        for method in ("explicit", "arkode-explicit", "arkode-implicit"):
            with self.subTest(method=method):
                (a, _), warned = speeds(method, "--set", f'integrator.method="{method}"')
                self.assertGreater(a, -0.6 * 2500)
                self.assertFalse([text for text in warned if "give way" in text], warned)
        (a, _), warned = speeds("shallow", "--set", "contact.depth=0.5")
        self.assertLess(a, -0.9 * 2500)
        self.assertTrue([text for text in warned if "give way" in text], warned)


class Loss(CommandLineTest):
    drift = overrides(body__0__velocity__1=126.9, body__1__velocity__1=42.5)

    def told(self, name, *settings, scene):
        summary = read_summary(self.run_scene(name, *settings, scene=scene))
        return summary["energy"]["relative_residual"], [line for line in summary["warnings"] if "the numerics" in line]

    def lost(self, line):
        return float(re.search(r"the numerics lost (\S+) % of the energy that bodies have about their common centre of mass", line)[1])

    def test_no_frame_hides_it(self):
        """A collision that loses a twelfth of its energy says so, however fast both bodies fly the same way."""
        for name, frame, share in (("slow", (), 0.05), ("fast", self.drift, 0.0)):
            with self.subTest(name):
                residual, (line,) = self.told(name, *frame, scene=ends)
                self.assertGreater(residual, share)
                self.assertTrue(5.0 < self.lost(line) < 12.0, line)
                self.assertIn("integrator.order = 4", line)
        self.assertLess(residual, 0.02)  # of what the fast frame has

    def test_what_is_held_has_one_frame(self):
        wall = ("--set", 'boundary=[{box={min=[-inf,-1.0],max=[inf,-0.9]},fix=["z"]}]')
        residual, lines = self.told("held", *self.drift, *wall, scene=ends)
        self.assertLess(residual, 0.02)
        self.assertEqual(lines, [])

    def test_what_is_advised_helps(self):
        residual, lines = self.told("ends", *overrides(integrator__order=4), scene=ends)
        self.assertLess(abs(residual), 0.01)
        self.assertEqual(lines, [])
        residual, (line,) = self.told("remaps", scene=corner)
        self.assertLess(residual, 0.05)  # of what the frame has
        self.assertGreater(self.lost(line), 5.0)
        for key in ("at remaps", "arkode-explicit", "integrator.order = 4"):
            self.assertIn(key, line)
        residual, lines = self.told("steps", "--set", 'integrator.method="arkode-explicit"', *overrides(integrator__order=4), scene=corner)
        self.assertLess(abs(residual), 0.001)
        self.assertEqual(lines, [])


if __name__ == "__main__":
    unittest.main()
