"""events.csv and the histories: complete, in order, the same for any number of threads and after a resumption."""
import csv
import unittest

import h5py
import numpy as np
from support import CommandLineTest, file_names, impact, overrides, plane_strain, read_summary


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Events(CommandLineTest):
    def test_every_event_in_order_of_time(self):
        out = self.run_scene("out")
        rows, summary = rows_of(out / "events.csv"), read_summary(out)
        self.assertEqual(len(rows), summary["constitutive"]["events"])
        self.assertEqual(list(rows[0]), ["time", "body", "particle", "kind", "r", "z", "value"])
        times = [float(row["time"]) for row in rows]
        self.assertEqual(times, sorted(times))
        order = [(float(row["time"]), ("plate", "cylinder").index(row["body"]), int(row["particle"])) for row in rows]
        self.assertEqual([key for key in order if key[0] > 0.0], sorted(key for key in order if key[0] > 0.0))
        self.assertTrue(0.0 <= times[0] and times[-1] <= 20e-6)
        for kind in ("localisation", "separation"):
            first = next(row for row in rows if row["kind"] == kind)
            told = summary["failure"][f"first_{kind}"]
            self.assertEqual([float(first["time"]), first["body"], float(first["r"]), float(first["z"])],
                             [told["time"], told["body"], told["r"], told["z"]])
        # A particle localises once at most, and separates only then.
        localised = [(row["body"], row["particle"]) for row in rows if row["kind"] == "localisation"]
        separated = [(row["body"], row["particle"]) for row in rows if row["kind"] == "separation"]
        self.assertEqual(len(localised), len(set(localised)))
        self.assertEqual(len(localised), summary["failure"]["localised"])
        self.assertEqual(len(separated), summary["failure"]["separated"])
        self.assertLessEqual(set(separated), set(localised))

    def test_particles_are_those_of_the_fields(self):
        out = self.run_scene("out")
        with h5py.File(out / "result.h5") as result:
            last = list(result["steps"].values())[-1]
            of_body, opened = result["particles/body"][:], last["particles/decohesion"][:] >= 1.0
            for number, body in enumerate(("plate", "cylinder")):
                separated = {int(row["particle"]) for row in rows_of(out / "events.csv")
                             if row["body"] == body and row["kind"] == "separation"}
                self.assertEqual(separated, set(np.flatnonzero(opened[of_body == number])))

    def test_value_at_localisation_is_the_strength(self):
        """The largest principal stress is the traction on the plane, or more where the hoop direction bears more."""
        out = self.run_scene("out")
        with h5py.File(out / "result.h5") as result:
            strength = list(result["steps"].values())[-1]["particles/cohesive_strength"][:]
            strength = strength[result["particles/body"][:] == 0]
        rows = [row for row in rows_of(out / "events.csv") if row["kind"] == "localisation" and row["body"] == "plate"]
        ratios = np.array([float(row["value"]) / strength[int(row["particle"])] for row in rows])
        self.assertTrue(np.all(ratios > 1.0 - 1e-9), ratios.min())
        self.assertGreater(np.mean(ratios < 1.0 + 1e-9), 0.3)

    def test_the_same_in_the_result(self):
        out = self.run_scene("out")
        rows = rows_of(out / "events.csv")
        with h5py.File(out / "result.h5") as result:
            for group in (result["events"], result["tables/events"]):
                for name in ("time", "particle", "r", "z", "value"):
                    self.assertEqual(list(group[name][:]), [float(row[name]) for row in rows])
                for name in ("body", "kind"):
                    names = group[f"{name}_names"].asstr()[:]
                    self.assertEqual(list(names[group[name][:]]), [row[name] for row in rows])
                self.assertEqual(group["r"].attrs["unit"], "m")
            self.assertEqual(len(result["tables/energy/time"]), len(rows_of(out / "energy.csv")))

    def test_kinds_by_choice(self):
        every = rows_of(self.run_scene("all") / "events.csv")
        some = rows_of(self.run_scene("some", "--set", 'output.events=["localisation", "peak"]', "--no-fields") / "events.csv")
        self.assertEqual(some, [row for row in every if row["kind"] in ("localisation", "peak")])
        self.assertNotEqual(some, [])
        told = self.vitrum("run", impact, "--set", 'output.events=["yields"]', status=2).stderr
        self.assertIn("output.events", told)
        self.assertIn('"yield"', told)

    def test_same_for_any_threads_and_after_a_resumption(self):
        settings = overrides(output__checkpoint_every=7e-6, output__history_every=1e-7)
        whole = self.run_scene("whole", *settings)
        self.assert_same_results(self.run_scene("three", *settings, "--threads", 3), whole)
        for method in ('"explicit"', '"arkode-explicit"', '"arkode-implicit"'):
            settings = [*settings[:4], *overrides(integrator__method=method, integrator__rtol=1e-2, time__end=8e-6)]
            one, two = (self.run_scene(f"{method[1:-1]} {n}", *settings, "--threads", n) for n in (1, 2))
            self.assertEqual((one / "events.csv").read_text(), (two / "events.csv").read_text())
            self.vitrum("run", impact, "--out", one, *settings, "--resume")  # from 7 us
            self.assert_same_results(one, two)

    def test_names_of_places_follow_the_geometry(self):
        out = self.run_scene("out", scene=plane_strain)
        self.assertEqual((out / "events.csv").read_text().splitlines()[0], "time,body,particle,kind,x,y,value")

    def test_a_folder_of_tables(self):
        out = self.run_scene("out")
        before = file_names(out)
        (out / "events.csv").write_text("mine\n")
        (out / "result.h5").unlink(), (out / "summary.json").unlink()
        self.assertIn("events.csv, which is not a run's", self.vitrum("run", impact, "--out", out, status=2).stderr)
        self.run_scene("out", "--force")
        self.assertEqual(file_names(out), before)

probes = """
[[probe]]
name = "back"
body = "plate"
point = [0.0, 0.0]
[[probe]]
name = "face, along"
body = "plate"
line = {from = [0.0005, 0.0045], to = [0.0195, 0.0045], count = 20}
[[probe]]
name = "nose"
body = "cylinder"
box = {min = [0.0, 0.006], max = [0.005, 0.008]}
"""


class Histories(CommandLineTest):
    def probed(self, text=probes):
        scene = self.folder / "probed.toml"
        scene.write_text(impact.read_text() + text)
        return scene

    def test_bodies_are_those_of_the_summary(self):
        out = self.run_scene("out", "--no-fields")
        rows, summary = rows_of(out / "bodies.csv"), read_summary(out)
        self.assertEqual(len(rows), 2 * 11)  # at every output
        for row in rows[-2:]:
            told = summary["bodies"][row["body"]]
            for name, value in (("momentum_r", told["momentum"][0]), ("momentum_z", told["momentum"][1]),
                                ("centre_r", told["centre"][0]), ("centre_z", told["centre"][1]), ("kinetic", told["kinetic"]),
                                ("localised", told["localised"]), ("separated", told["separated"]), ("fragments", told["fragments"]),
                                ("crack_area", told["crack_area"]), ("localised_volume", told["localised_volume"])):
                self.assertEqual(float(row[name]), value, name)
        self.assertGreater(float(rows[-2]["crack_area"]), 0.0)
        largest = max(float(row["largest_fragment"]) for row in rows[-2:])
        self.assertAlmostEqual(largest / summary["failure"]["fragments"]["largest_mass"], 1.0, 12)
        self.assertAlmostEqual(sum(float(row["elastic"]) for row in rows[-2:]) / summary["energy"]["elastic"], 1.0, 9)
        first = rows[0]
        self.assertEqual([first["fragments"], first["time"]], ["1", "0"])
        self.assertAlmostEqual(float(first["largest_fragment"]) / summary["bodies"]["plate"]["mass"], 1.0, 12)

    def test_histories_change_no_bit(self):
        """Rows stand at ends of steps, at or after the multiples of their interval: no step is cut for them."""
        for method in ('"explicit"', '"arkode-explicit"', '"arkode-implicit"'):
            settings = overrides(integrator__method=method, integrator__rtol=1e-2, time__end=4e-6)
            plain = self.run_scene(f"plain {method[1:-1]}", *settings)
            told = self.run_scene(f"told {method[1:-1]}", *settings, *overrides(output__history_every=3.7e-8), scene=self.probed())
            self.assertEqual((plain / "energy.csv").read_text(), (told / "energy.csv").read_text())
            with h5py.File(plain / "result.h5") as one, h5py.File(told / "result.h5") as other:
                for step in one["steps"]:
                    for field, values in one["steps"][step]["particles"].items():
                        self.assertEqual(values[()].tobytes(), other["steps"][step]["particles"][field][()].tobytes())
            times = sorted({float(row["time"]) for row in rows_of(told / "bodies.csv")})
            self.assertEqual([times[0], times[-1]], [0.0, 4e-6])
            if method != '"arkode-implicit"':  # whose rows wait for the end of a phase
                steps = np.array([float(row["time"]) for row in rows_of(told / "energy.csv")])
                self.assertLessEqual(np.diff(times).max(), 3.7e-8 + 2.0 * np.diff(steps).max())

    def test_impulses_are_changes_of_momentum(self):
        """Of the whole: what the plate's rim is held by. (The sum over radial components is changed by hoop stress too.)"""
        for method in ('"explicit"', '"arkode-explicit"', '"arkode-implicit"'):
            out = self.run_scene(method[1:-1], *overrides(integrator__method=method, integrator__rtol=1e-2, time__end=12e-6,
                                                          output__history_every=1e-6))
            momenta = {}
            for row in rows_of(out / "bodies.csv"):
                momenta[row["time"]] = momenta.get(row["time"], 0.0) + float(row["momentum_z"])
            start = momenta["0"]
            rows = rows_of(out / "reactions.csv")
            self.assertEqual(list(rows[0]), ["time", "boundary", "impulse_r", "impulse_z"])
            self.assertEqual({row["boundary"] for row in rows}, {"boundary.0"})
            for row in rows:
                self.assertAlmostEqual(float(row["impulse_z"]), momenta[row["time"]] - start, delta=1e-11 * abs(start))
            self.assertGreater(abs(float(rows[-1]["impulse_z"])), 1e-5 * abs(start))
            self.assertLess(float(rows[-1]["impulse_r"]), 0.0)  # the rim is held against the wave that pushes it out

    def test_probes_are_the_fields_of_their_particles(self):
        out = self.run_scene("out", scene=self.probed())
        rows = rows_of(out / "probes.csv")
        self.assertEqual(len(rows), 11 * 22)
        with h5py.File(out / "result.h5") as result:
            body, mass = result["particles/body"][:], result["particles/mass"][:]
            start = result["steps/00000/particles/position"][:]

            def nearest(number, point):
                return np.argmin(np.where(body == number, np.hypot(*(start - point).T), np.inf))

            places = [np.linspace(0.0005, 0.0195, 20)[k] for k in range(20)]
            chosen = [[nearest(0, (0.0, 0.0))], *([nearest(0, (x, 0.0045))] for x in places),
                      np.flatnonzero((body == 1) & (start[:, 1] <= 0.008))]
            for n, step in enumerate(result["steps"].values()):
                fields = step["particles"]
                for row, particles in zip(rows[22 * n:22 * n + 22], chosen, strict=True):
                    weights = mass[particles] / mass[particles].sum()
                    self.assertEqual(float(row["time"]), step.attrs["time"])
                    self.assertEqual(int(row["particles"]), len(particles))
                    self.assertAlmostEqual(float(row["mass"]) / mass[particles].sum(), 1.0, 12)
                    for field, names in (("position", ("r", "z")), ("velocity", ("velocity_r", "velocity_z")),
                                         ("stress", ("stress_rr", "stress_zz", "stress_tt", "stress_rz"))):
                        expected = weights @ fields[field][:][particles]
                        found = np.array([float(row[name]) for name in names])
                        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12 * np.abs(fields[field][:]).max())
            self.assertEqual([row["probe"] for row in rows[:3]], ["back", "face, along", "face, along"])
            self.assertEqual([row["point"] for row in rows[1:21]], [str(k) for k in range(20)])
            names = result["tables/probes/probe_names"].asstr()[:]
            self.assertEqual(list(names), ["back", "face, along", "nose"])

    def test_probes_that_see_nothing(self):
        for text, message in (('body = "plte"\npoint = [0, 0]', "did you mean 'plate'?"),
                              ('body = "plate"', "found no place, expected exactly one of point, line, box"),
                              ('body = "plate"\npoint = [0, 0]\nbox = {min = [0, 0], max = [1, 1]}', "expected exactly one of"),
                              ('body = "plate"\nline = {from = [0, 0], to = [1, 0], count = 1}', "an integer from 2 to 10000"),
                              ('body = "plate"\nbox = {min = [1, 1], max = [2, 2]}', "found a box without a particle of body 'plate'")):
            told = self.vitrum("check", self.probed(f'[[probe]]\nname = "a"\n{text}\n'), status=2).stderr
            self.assertIn("probed.toml:", told)
            self.assertIn(message, told)
        twice = 2 * '[[probe]]\nname = "a"\nbody = "plate"\npoint = [0, 0]\n'
        self.assertIn("a name that no other probe has", self.vitrum("check", self.probed(twice), status=2).stderr)
        far = '[[probe]]\nname = "a"\nbody = "plate"\npoint = [0.03, 0]\n'
        self.assertIn("'probe.0.point': the nearest particle of body 'plate' is 0.0105 m away",
                      self.vitrum("check", self.probed(far)).stderr)


if __name__ == "__main__":
    unittest.main()
