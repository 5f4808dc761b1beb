"""studies/plot_run.py draws the pictures of a run."""
import importlib.util
import subprocess
import sys
import unittest

from support import CommandLineTest, plane_strain, source


@unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "matplotlib is not installed")
class PlotRun(CommandLineTest):
    def plot(self, *arguments, status=0):
        done = subprocess.run([sys.executable, source / "studies" / "plot_run.py", *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True, encoding="utf-8", timeout=120)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def assert_pictures(self, folder, names):
        from matplotlib.image import imread
        self.assertEqual(sorted(path.name for path in folder.iterdir()),
                         sorted(f"{name}.{suffix}" for name in names for suffix in ("png", "pdf")))
        for name in names:
            picture = imread(folder / f"{name}.png")
            self.assertGreater(min(picture.shape[:2]), 300, name)
            self.assertGreater(picture.std(), 0.05, f"{name} is nearly blank")
            pdf = (folder / f"{name}.pdf").read_bytes()
            self.assertTrue(pdf.startswith(b"%PDF") and len(pdf) > 5000, name)

    def test_every_picture(self):
        out = self.run_scene("out")
        answer = self.plot(out, "--out", "pictures ü", "--times", "0", "2e-5")
        self.assertEqual(answer.stderr, "")
        self.assert_pictures(self.folder / "pictures ü", ["snapshots", "damage", "opening", "energy"])

    def test_plane_strain_without_damage(self):
        answer = self.plot(self.run_scene("out", scene=plane_strain))
        for skipped in ("damage", "opening"):
            self.assertRegex(answer.stdout, f"{skipped}: not drawn: .")
        self.assert_pictures(self.folder / "out" / "pictures", ["snapshots", "energy"])

    def test_wrong_input(self):
        out, bare = self.run_scene("out"), self.run_scene("bare", "--no-fields")
        foreign = self.folder / "foreign"
        foreign.mkdir()
        (foreign / "result.h5").write_text("no HDF5")
        for arguments, expected in (
            (["missing"], "no such file"),
            ([foreign], "cannot be read"),
            ([bare], "--no-fields"),
            ([out, "--times", "1"], "outside the run"),
            ([out, "--times", "nan"], "outside the run"),
            ([out, "--out", out / "energy.csv" / "pictures"], "cannot be made"),
        ):
            with self.subTest(expected=expected):
                answer = self.plot(*arguments, status=2)
                self.assertRegex(answer.stderr, "^error: .*" + expected)
                self.assertEqual(answer.stderr.count("\n"), 1)
        self.plot(out, "--times", "noon", status=2)


if __name__ == "__main__":
    unittest.main()
