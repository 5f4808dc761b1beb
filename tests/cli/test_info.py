"""`vitrum info`."""
import json
import unittest

import h5py
from support import CommandLineTest, impact, overrides, read_summary


class Info(CommandLineTest):
    def test_folder_and_file(self):
        out = self.run_scene("out")
        text = self.vitrum("info", out).stdout
        for expected in ("Steel cylinder on a small glass plate", "complete", "plate", "100 particles", "outputs (11)", "damage"):
            self.assertIn(expected, text)
        self.assertIn("outputs (11)", self.vitrum("info", out / "result.h5").stdout)

    def test_outputs_are_summed_up(self):
        regular = self.vitrum("info", self.run_scene("regular")).stdout
        self.assertIn("  00000 .. 00010  t = 0.0 .. 2e-05 s, steps 0 .. 1000\n  every 2e-06 s\n", regular)
        self.assertNotIn("00005", regular)
        irregular = self.vitrum("info", self.run_scene("irregular", *overrides(output__every=3e-6))).stdout
        self.assertIn("  2e-06 to 3e-06 s apart\n", irregular)
        many = self.vitrum("info", self.run_scene("many", *overrides(output__every=2e-8))).stdout
        self.assertIn("outputs (1001)", many)
        self.assertLess(len(many.splitlines()), 70)

    def test_json(self):
        out = self.run_scene("out")
        info = json.loads(self.vitrum("info", out, "--json").stdout)
        self.assertEqual(info["summary"], {"status": "complete", "message": None})
        self.assertEqual(info["bodies"], {"plate": 100, "cylinder": 100})
        self.assertEqual([step["step_index"] for step in info["outputs"]], list(range(0, 1001, 100)))
        self.assertEqual(info["fields"]["stress"]["components"], 4)
        self.assertEqual(info["fields"]["stress"]["unit"], "Pa")
        self.assertEqual(info["provenance"], read_summary(out)["provenance"])
        self.assertEqual(info["series"]["kinetic"]["last"], read_summary(out)["energy"]["kinetic"])
        self.assertNotIn("summary", json.loads(self.vitrum("info", out / "result.h5", "--json").stdout))

    def test_tables(self):
        """Rows as they stand in the files: a killed run's too."""
        out = self.run_scene("out", *overrides(output__history_every=1e-6))
        tables = json.loads(self.vitrum("info", out, "--json").stdout)["tables"]
        for name in ("energy", "events", "bodies"):
            with self.subTest(table=name):
                rows = len((out / f"{name}.csv").read_text().splitlines()) - 1
                self.assertEqual((tables[name]["file"], tables[name]["rows"]), (f"{name}.csv", rows))
                self.assertRegex(self.vitrum("info", out).stdout, rf"  {name}\.csv +{rows} +\S")
        self.assertEqual(tables["bodies"]["rows"], 2 * 21)
        self.assertNotIn("probes", tables)

    def test_without_fields(self):
        info = json.loads(self.vitrum("info", self.run_scene("out", "--no-fields"), "--json").stdout)
        self.assertEqual((info["fields"], len(info["outputs"])), ({}, 11))

    def test_command_is_told_as_typed(self):
        self.vitrum("run", impact, "--out", "out", "--quiet", *overrides(title='"x y"'))
        self.assertIn("--set 'title=\"x y\"'", json.loads(self.vitrum("info", "out", "--json").stdout)["provenance"]["command"])

    def test_what_is_no_result(self):
        out = self.run_scene("out", *overrides(output__checkpoint_every=10e-6))
        foreign = self.folder / "foreign.h5"
        with h5py.File(foreign, "w") as file:
            file["x"] = 1
        empty, cut = self.folder / "empty.h5", self.folder / "cut.h5"
        empty.touch()
        cut.write_bytes((out / "result.h5").read_bytes()[:20000])
        for path in (impact, foreign, empty, cut, self.folder, self.folder / "missing", out / "energy.csv", out / "checkpoint.h5"):
            with self.subTest(path=path.name):
                answer = self.vitrum("info", path, status=4)
                self.assertRegex(answer.stderr, "^error: .*" + path.name)
                self.assertEqual((answer.stdout, answer.stderr.count("\n")), ("", 1))


if __name__ == "__main__":
    unittest.main()
