"""The drawings of docs/ are what their scripts draw, and every one is shown."""
import re
import sys
import tempfile
import unittest
from pathlib import Path

from support import source

sys.path.insert(0, str(source / "docs/pictures"))
import draw  # noqa: E402
import look  # noqa: E402


class Drawings(unittest.TestCase):
    def test_each_script_draws(self):
        kept = look.folder
        self.addCleanup(setattr, look, "folder", kept)
        with tempfile.TemporaryDirectory(prefix="vitrum-") as folder:
            look.folder = Path(folder)
            for name in draw.drawings:
                __import__(name).draw()
            made = {path.name for path in look.folder.iterdir()}
        self.assertEqual(made, {path.name for path in kept.iterdir()})

    def test_each_is_shown(self):
        pages = " ".join(page.read_text() for page in [source / "README.md", *(source / "docs").rglob("*.md")])
        shown = set(re.findall(r"pictures/drawings/(\w+)\.svg", pages))
        self.assertEqual(shown, set(draw.drawings))


if __name__ == "__main__":
    unittest.main()
