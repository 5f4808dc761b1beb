"""studies/plot_run.py draws the pictures of a run; what stands in them can be read and told apart."""
import importlib.util
import subprocess
import sys
import unittest

import h5py
from support import CommandLineTest, overrides, plane_strain, read_summary, source

sys.path.insert(0, str(source / "studies"))


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
        self.assert_pictures(self.folder / "pictures ü", ["snapshots", "damage", "opening", "cracks", "fragments", "fragment-masses", "failure", "energy"])

    def test_pictures_carry_their_origin(self):
        from PIL import Image
        out = self.run_scene("out")
        self.plot(out)
        with Image.open(out / "pictures" / "snapshots.png") as picture:
            text = dict(picture.text)
        with h5py.File(out / "result.h5") as result:
            made = dict(result["provenance"].attrs)
            self.assertEqual((text["vitrum-commit"], text["vitrum-command"]), (made["git"], made["command"]))
            self.assertEqual(text["vitrum-scene"], result["scene/resolved"][()].decode())

    def test_without_fields(self):
        """What the series hold is drawn."""
        bare = self.run_scene("bare", "--no-fields")
        answer = self.plot(bare)
        for skipped in ("snapshots", "damage", "opening", "cracks", "fragments", "fragment-masses"):
            self.assertIn(f"{skipped}: not drawn: the run was made with --no-fields", answer.stdout)
        self.assert_pictures(bare / "pictures", ["failure", "energy"])

    def test_plane_strain_without_damage(self):
        answer = self.plot(self.run_scene("out", scene=plane_strain))
        for skipped in ("damage", "opening", "cracks", "fragments", "fragment-masses", "failure"):
            self.assertRegex(answer.stdout, f"{skipped}: not drawn: .")
        self.assert_pictures(self.folder / "out" / "pictures", ["snapshots", "energy"])

    def test_wrong_input(self):
        out = self.run_scene("out")
        foreign = self.folder / "foreign"
        foreign.mkdir()
        (foreign / "result.h5").write_text("no HDF5")
        for arguments, expected in (
            (["missing"], "no such file"),
            ([foreign], "cannot be read"),
            ([out, "--times", "1"], "outside the run"),
            ([out, "--times", "nan"], "outside the run"),
            ([out, "--out", out / "energy.csv" / "pictures"], "cannot be made"),
        ):
            with self.subTest(expected=expected):
                answer = self.plot(*arguments, status=2)
                self.assertRegex(answer.stderr, "^error: .*" + expected)
                self.assertEqual(answer.stderr.count("\n"), 1)
        self.plot(out, "--times", "noon", status=2)

    def figures(self, run, frames):
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
        self.addCleanup(pyplot.close, "all")
        from vitrum.plot import crack_figures, particle_figures
        return {draw.__name__: draw(run, frames) for draw in (particle_figures.snapshots, particle_figures.damage, particle_figures.opening,
                                                              crack_figures.cracks, crack_figures.fragments)}

    def test_nothing_is_cut_off(self):
        """Titles, legends and scales lie within the figure, however few panels it has."""
        from vitrum import load
        run = load(self.run_scene("out", *overrides(title='"A title that is longer than a single panel of the narrowest figure is wide, and then some"')))
        for count in (1, 2, 3):
            for name, figure in self.figures(run, run.frames[-count:]).items():
                figure.draw_without_rendering()
                renderer = figure.canvas.get_renderer()
                texts = [*figure.texts, *figure.legends, figure._suptitle, *[axes.yaxis.label for axes in figure.axes], *[axes.xaxis.label for axes in figure.axes]]
                for text in texts:
                    box = text.get_window_extent(renderer)
                    self.assertTrue(figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1 and figure.bbox.y0 <= box.y0 and box.y1 <= figure.bbox.y1,
                                    f"{name} of {count} panels: {text} {box}")
                for legend in figure.legends:
                    self.assertFalse(any(legend.get_window_extent(renderer).overlaps(axes.get_tightbbox(renderer)) for axes in figure.axes), name)

    def test_same_scales(self):
        """Damage and opening have one scale in all figures, and the worse the darker."""
        from vitrum.plot import looks
        from vitrum import load
        weak, strong = (load(self.run_scene(name, *overrides(material__glass__damage__toughness=value))) for name, value in (("weak", 0.7e6), ("strong", 0.9e6)))
        for kind in ("damage", "opening"):
            ticks = [[label.get_text() for label in self.figures(run, run.frames[-2:])[kind].axes[-1].get_yticklabels()] for run in (weak, strong)]
            self.assertEqual(ticks[0], ticks[1])
        for scale in (looks.damage_scale, looks.opening_scale(1e-3)):
            shades = [luminance(looks.worse(scale.norm(bound * 1.001))) for bound in scale.bounds]
            self.assertEqual(shades, sorted(shades, reverse=True))
            self.assertLess(shades[-1], 0.1 * shades[0])

    def test_bodies_and_what_separates_of_them_are_told_apart(self):
        """By all kinds of colour vision (matrices of Machado, Oliveira and Fernandes, 2009, severity 1)."""
        import numpy as np
        from matplotlib.colors import to_rgb
        from vitrum.plot import looks
        kinds = {"all": np.eye(3),
                 "without red": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
                 "without green": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
                 "without blue": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]])}
        for kind, matrix in kinds.items():
            seen = [np.clip(matrix @ to_rgb(looks.body_look(body, separated)), 0.0, 1.0) for body in (0, 1) for separated in (False, True)]
            for n, one in enumerate(seen):
                for other in seen[:n]:
                    self.assertGreater(np.linalg.norm(one - other), 0.15, (kind, one, other))

    def test_pieces_are_those_of_the_summary(self):
        from vitrum.plot.pieces import piece_masses
        from vitrum import load
        out = self.run_scene("out")
        run = load(out)
        counted = read_summary(out)["failure"]["fragments"]
        masses = sorted((mass for each in piece_masses(run, run.frames[-1]).values() for mass in each), reverse=True)
        self.assertEqual(len(masses), counted["count"])
        for ours, theirs in zip(masses, sorted((piece["mass"] for piece in counted["list"]), reverse=True)):
            self.assertAlmostEqual(ours, theirs, delta=1e-12 * theirs)


def luminance(colour):
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]


if __name__ == "__main__":
    unittest.main()
