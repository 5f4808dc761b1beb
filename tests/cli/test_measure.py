"""studies/adaptive/measure.py leaves its tables and its picture, with orders and signs as theory demands."""
import csv
import os
import subprocess
import sys
import unittest

from support import CommandLineTest, program, source


class Measure(CommandLineTest):
    def test_quick(self):
        done = subprocess.run([sys.executable, source / "studies/adaptive/measure.py", os.path.abspath(program), "--quick",
                               "--out", self.folder / "out"], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.folder / "out"
        self.assertTrue((out / "tolerance.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("## smooth", (out / "measure.md").read_text())
        with open(out / "measure.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        found = {(r["case"], r["method"], r["setting"]): r for r in rows}
        for case in ("smooth", "reference"):
            self.assertLess(float(found[case, "arkode-explicit 3", "0.01"]["error"]), 0.02)
        own = [float(found["smooth", "arkode-implicit 3", rtol]["own_error"]) for rtol in ("0.01", "0.0001")]
        self.assertLess(own[1], 0.2 * own[0])
        self.assertGreater(int(found["smooth", "arkode-implicit 3", "0.0001"]["factorisations"]), 0)


if __name__ == "__main__":
    unittest.main()
