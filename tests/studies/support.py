"""What the tests of the studies share: running a quick study, and reading what it leaves.

The program's path comes from the environment variable VITRUM.
"""
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

source = pathlib.Path(__file__).resolve().parent.parent.parent
if "VITRUM" not in os.environ:
    sys.exit("set VITRUM to the path of the program")
os.environ["VITRUM"] = os.path.abspath(os.environ["VITRUM"])
sys.path.insert(0, str(source / "studies"))
blocks = source / "studies/trade/impact.toml"  # elastic


def run_study(name, out, *options):
    """As `./quickstart study` does it, from the project's root."""
    return subprocess.run([source / "studies/run", name, out, "1", *options], capture_output=True, text=True, timeout=1500, cwd=source)


def png_text(path):
    """The texts that a PNG carries."""
    from PIL import Image
    with Image.open(path) as picture:
        return dict(picture.text)


class StudyTest(unittest.TestCase):
    """Runs the quick variant of `study` once; its files stand in `out`."""
    study = ""
    options = ()

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-study-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.out = cls.folder / "out"
        done = run_study(cls.study, cls.out, *cls.options)
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
        # Every picture is there and says which command made it, and of what commit.
        shown = re.findall(r"\]\(([^)]+\.png)\)", page)
        self.assertTrue(shown)
        for name in shown:
            text = png_text(self.out / name)
            self.assertEqual(text["vitrum-command"], f"./quickstart study {self.study} --quick")
            self.assertIn(text["vitrum-commit"], page)

    def assert_page_does_not_state(self, *parts):
        """What only the whole study has measured."""
        page = (self.out / "page.md").read_text()
        for part in parts:
            self.assertNotIn(part, page)


class Folder(unittest.TestCase):
    """A test of studies of one's own scene, in a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum study "))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, text):
        path = self.folder / "study.toml"
        path.write_text(text)
        return path

    def command(self, path, *options, status=0):
        done = subprocess.run([source / "studies/vitrum-study", path, "--out", self.folder / "out", *options], capture_output=True, text=True, timeout=1500)
        self.assertEqual(done.returncode, status, done.stdout[-1000:] + done.stderr[-3000:])
        return done

    def table(self, name):
        with open(self.folder / "out/tables" / f"{name}.csv", newline="") as opened:
            return [{key: _value(text) for key, text in row.items()} for row in csv.DictReader(opened)]


def assert_page_works(test, path, parts=()):
    """In a browser, where there is one: its text is there, nothing to complain of, no wider than a phone, in the light and in the dark."""
    sys.path.insert(0, str(source / "tests/python"))
    import browser
    if not browser.there:
        return
    driver = browser.start()
    test.addCleanup(driver.quit)
    papers = []
    for scheme in ("light", "dark"):
        browser.look(driver, 360, 740, scheme)
        driver.get(f"file://{path}")
        test.assertEqual(browser.complaints(driver), [])
        test.assertLessEqual(driver.execute_script("return document.documentElement.scrollWidth"), 360)
        test.assertEqual(driver.execute_script("return [...document.querySelectorAll('figure svg')].filter(each => each.getBoundingClientRect().height < 60).length"), 0)
        text = driver.execute_script("return document.body.innerText")
        test.assertEqual([part for part in parts if part not in text], [])
        papers.append(driver.execute_script("return getComputedStyle(document.body).backgroundColor"))
    test.assertNotEqual(*papers)


def _value(text):
    try:
        return float(text) if text else None
    except ValueError:
        return text
