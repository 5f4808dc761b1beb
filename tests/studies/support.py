"""What the tests of the studies share: running a quick study, and reading what it leaves.

The program's path comes from the environment variable VITRUM.
"""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

source = pathlib.Path(__file__).resolve().parent.parent.parent
if "VITRUM" not in os.environ:
    sys.exit("set VITRUM to the path of the program")
os.environ["VITRUM"] = os.path.abspath(os.environ["VITRUM"])


def run_study(name, out, *options, tree=source):
    """As `./quickstart study` does it, from the project's root."""
    return subprocess.run([tree / "studies/run", name, out, "1", *options], capture_output=True, text=True, timeout=600, cwd=tree)


class StudyTest(unittest.TestCase):
    """Runs the quick variant of `study` once; its files stand in `out`. With `place`, from a copy of the studies, and of the program, in a folder of
    that name."""
    study = ""
    options = ()
    place = None

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-study-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        tree, program = source, os.environ["VITRUM"]
        if cls.place is not None:
            tree = cls.folder / cls.place
            shutil.copytree(source / "studies", tree / "studies")
            os.environ["VITRUM"] = str(shutil.copy(program, tree / "the program"))
            cls.addClassCleanup(os.environ.__setitem__, "VITRUM", program)
        cls.out = (cls.folder if cls.place is None else tree) / "what came out"
        done = run_study(cls.study, cls.out, *cls.options, tree=tree)
        if done.returncode != 0:
            raise AssertionError(f"the study failed:\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}")

    def table(self, name, columns):
        """Rows of tables/NAME.csv, which has at least `columns`; numbers as such, None where a cell is empty."""
        with open(self.out / "tables" / f"{name}.csv", newline="") as file:
            reader = csv.DictReader(file)
            rows = list(reader)
        self.assertLessEqual(set(columns), set(reader.fieldnames))
        self.assertTrue(rows, name)
        return [{key: _value(text) for key, text in row.items()} for row in rows]

    def assert_figures(self, *names):
        from matplotlib.image import imread
        for name in names:
            picture = imread(self.out / "figures" / f"{name}.png")
            self.assertGreater(min(picture.shape[:2]), 300, name)
            self.assertGreater(picture.std(), 0.05, f"{name} is nearly blank")
            pdf = (self.out / "figures" / f"{name}.pdf").read_bytes()
            self.assertTrue(pdf.startswith(b"%PDF") and len(pdf) > 5000, name)

    def assert_page(self, *parts):
        page = (self.out / "page.md").read_text()
        self.assertNotIn("{{", page)
        for part in (f"./quickstart study {self.study} --quick", "commit", *parts):
            self.assertIn(part, page)


def _value(text):
    try:
        return float(text) if text else None
    except ValueError:
        return text
