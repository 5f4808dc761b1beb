"""result.h5 and result.xdmf; what runs print; runs that must be equal."""
import json
import resource
import shutil
import tomllib
import unittest

import h5py
import numpy as np
from support import CommandLineTest, file_names, impact, output_count, overrides, plane_strain, read_result, read_summary, told

fields = {"position": 2, "velocity": 2, "stress": 4, "damage": 1, "crack_density": 1, "max_rate": 1, "plastic_strain": 1,
          "decohesion": 1, "opening_n": 1, "opening_t": 1, "normal_r": 1, "normal_z": 1, "dissipated": 1}


one_particle = """
title = "One particle that flies"
[space]
geometry = "plane-strain"
cell = 1.0e-3
[time]
end = 1.0e-5
[integrator]
method = "explicit"
step = 1.0e-7
[output]
every = 1.0e-7
[[body]]
name = "particle"
material = "rubber"
box = {min = [0, 0], max = [1.0e-3, 1.0e-3]}
velocity = [1.0, 0.0]
[material.rubber]
density = 1000.0
young = 1.0e9
poisson = 0.25
"""


class ResultFile(CommandLineTest):
    in_memory = True

    def test_layout(self):
        out = self.run_scene("out", *overrides(title='"changed"'))
        with h5py.File(out / "result.h5") as result:
            steps = result["steps"]
            self.assertEqual(sorted(steps), [f"{n:05d}" for n in range(11)])
            for n, step in enumerate(steps.values()):
                self.assertAlmostEqual(step.attrs["time"], n * 2e-6, delta=1e-15)
                self.assertEqual(step.attrs["step_index"], 100 * n)
                for name, components in fields.items():
                    shape = step["particles"][name].shape
                    self.assertEqual(shape, (200,) if components == 1 else (200, components), name)
            for group in (result["series"], result["particles"], *(step["particles"] for step in steps.values())):
                for name, data in group.items():
                    self.assertTrue(data.attrs["unit"], name)
                    self.assertTrue(data.attrs["description"], name)
            for name, series in result["series"].items():
                self.assertEqual(series.shape, (11,), name)
            np.testing.assert_array_equal(result["series/time"], [step.attrs["time"] for step in steps.values()])
            self.assertEqual(result["scene/verbatim"][()].decode(), impact.read_text())
            self.assertEqual(tomllib.loads(result["scene/resolved"][()].decode())["title"], "changed")
            attributes = dict(result["provenance"].attrs)
            shown = {name: text for name, text in attributes.items() if not name.startswith(".")}
            self.assertEqual(shown, read_summary(out)["provenance"])
            self.assertEqual(shown, {name[1:]: text.decode() for name, text in attributes.items() if name.startswith(".")})
            self.assertEqual([name.decode() for name in result["bodies"]], ["plate", "cylinder"])
            self.assertEqual(np.bincount(result["particles/body"]).tolist(), [100, 100])

    def test_values(self):
        out = self.run_scene("out")
        summary = read_summary(out)
        with h5py.File(out / "result.h5") as result:
            body, mass = result["particles/body"][()], result["particles/mass"][()]
            last = result["steps/00010/particles"]
            speed = np.hypot(*last["velocity"][()].T)
            self.assertAlmostEqual(0.5 * np.sum(mass * speed**2), summary["energy"]["kinetic"], delta=1e-9)
            self.assertTrue(np.all(np.isnan(last["damage"][body == 1])), "steel has no damage")
            damage = last["damage"][body == 0]
            self.assertTrue(np.all((damage >= 0.0) & (damage < 1.0)) and np.max(damage) > 0.1)
            self.assertEqual(np.sum(last["decohesion"][()] >= 1.0), summary["failure"]["separated"])
            for share in ("kinetic", "elastic", "plastic", "damage", "fracture", "contact", "friction", "external", "residual"):
                self.assertEqual(result[f"series/{share}"][-1], summary["energy"][share], share)

    def test_outputs_fall_on_multiples(self):
        """t = 0 is an output whatever the start, so that runs with different starts have times in common."""
        out = self.run_scene("out", *overrides(time__start=-3e-6, time__end=4.5e-6))
        with h5py.File(out / "result.h5") as result:
            times = [result["steps"][step].attrs["time"] for step in sorted(result["steps"])]
        np.testing.assert_allclose(times, [-3e-6, -2e-6, 0.0, 2e-6, 4e-6, 4.5e-6], atol=1e-18)

    def test_an_output_is_a_file(self):
        """It can be read on its own, and result.h5 leads to it wherever the folder goes."""
        out = self.run_scene("out")
        with h5py.File(out / "result.h5") as result:
            for n in range(11):
                self.assertEqual(result["steps"].get(f"{n:05d}", getlink=True).filename, f"steps/{n:05d}.h5")
                with h5py.File(out / "steps" / f"{n:05d}.h5") as step:
                    self.assertEqual(step.attrs["time"], result["series/time"][n])
        (self.folder / "deep").mkdir()
        moved = out.rename(self.folder / "deep" / "moved")
        copied = self.folder / "copied"
        shutil.copytree(moved, copied)
        self.assert_same_results(moved, copied)
        self.assertIn("outputs", self.vitrum("info", moved).stdout)
        self.assertEqual(json.loads(self.vitrum("compare", moved, copied, "--json").stdout)["times"][10]["fields"]["stress"]["largest"], 0.0)
        shutil.rmtree(copied / "steps")
        self.assertRegex(self.vitrum("info", copied, status=4).stderr, "error: .*copied/steps/")

    def test_thousands_of_outputs(self):
        """What an output costs does not depend on how many there are."""
        scene = self.folder / "one.toml"
        scene.write_text(one_particle)
        spent = {}
        for outputs in (500, 2000):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            out = self.run_scene(f"out{outputs}", *overrides(time__end=outputs * 1e-7), scene=scene)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            spent[outputs] = after.ru_utime - before.ru_utime
            self.assertEqual(output_count(out), outputs + 1)
        self.assertLess(spent[2000], 8.0 * spent[500], spent)

    def test_chosen_fields_and_only_the_last_state(self):
        out = self.run_scene("out", *overrides(output__fields='["damage", "elastic_strain"]', output__every=1.0))
        with h5py.File(out / "result.h5") as result:
            self.assertEqual(sorted(result["steps/00001/particles"]), ["damage", "elastic_strain", "position"])
        scene = self.folder / "last.toml"
        scene.write_text(impact.read_text().replace("every = 2.0e-6", ""))
        self.assertEqual(output_count(self.run_scene("last", scene=scene)), 1)

    def test_no_fields(self):
        with_fields, without = self.run_scene("with"), self.run_scene("out", "--no-fields")
        self.assertFalse((without / "result.xdmf").exists())
        self.assertEqual((without / "energy.csv").read_text(), (with_fields / "energy.csv").read_text())
        found, full = read_result(without), read_result(with_fields)
        self.assertFalse([name for name in found if name.startswith("steps/") and "particles" in name])
        for name in (name for name in full if name.startswith("series/")):
            self.assertEqual(found[name].tobytes(), full[name].tobytes(), name)

    def test_a_second_run_takes_the_place_of_the_first(self):
        fresh = self.run_scene("fresh", "--no-fields")
        out = self.run_scene("out", *overrides(output__checkpoint_every=4e-6))
        self.assertTrue((out / "checkpoint.h5").exists())
        self.run_scene("out", "--no-fields", "--force")
        self.assertEqual(file_names(out), file_names(fresh))


class Answers(CommandLineTest):
    def test_one_line_an_output(self):
        answer = self.vitrum("run", impact, "--out", "out")
        self.assertEqual(len([line for line in answer.stderr.splitlines() if line.startswith("t = ")]), 11)
        self.assertIn("results in out", answer.stdout)

    def test_quiet(self):
        answer = self.vitrum("run", impact, "--out", "out", "--quiet")
        self.assertEqual(answer.stdout, "")
        for line in told(answer.stderr):
            self.assertRegex(line, "^warning: ")

    def test_without_out(self):
        self.vitrum("run", impact, "--quiet")
        self.assertTrue((self.folder / "out" / "impact" / "summary.json").exists())


class EqualRuns(CommandLineTest):
    def test_twice(self):
        self.assert_same_results(self.run_scene("one"), self.run_scene("two"))

    def test_threads(self):
        one, two = self.run_scene("one", "--threads", 1), self.run_scene("two", "--threads", 2)
        self.assertEqual((read_summary(one)["threads"], read_summary(two)["threads"]), (1, 2))
        self.assert_same_results(one, two)

    def test_a_scene_in_plane_strain_twice(self):
        self.assert_same_results(self.run_scene("one", scene=plane_strain), self.run_scene("two", scene=plane_strain))


if __name__ == "__main__":
    unittest.main()
