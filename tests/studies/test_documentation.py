"""What README.md and docs/ show and name is of this tree: the picture has the scene that stands in it, the paper its title."""
import importlib
import os
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

import h5py

from support import png_text, source

sys.path.insert(0, str(source / "studies"))

title = "A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method"
again = "make it anew: ./quickstart study findings"
pages = [source / "README.md", *sorted((source / "docs").rglob("*.md"))]


def flat(table, prefix=""):
    """Dotted key -> value."""
    items = table.items() if isinstance(table, dict) else enumerate(table)
    found = {}
    for key, value in items:
        found |= flat(value, f"{prefix}{key}.") if isinstance(value, (dict, list)) else {f"{prefix}{key}": value}
    return found


class Documentation(unittest.TestCase):
    def test_where_a_study_publishes_is_a_path(self):
        """What a study's module calls `page` or `pictures` is where it publishes: a function of that name ended a full study at its last step."""
        for path in sorted((source / "studies").glob("*/study.py")):
            module = importlib.import_module(f"{path.parent.name}.study")
            for name in ("page", "pictures"):
                self.assertIsInstance(getattr(module, name, ""), str, f"{path}: {name}")

    def test_the_picture_shows_the_scene_that_stands_beside_it(self):
        """The scene that the picture carries, and the one that the program reads today from the same file with the same settings, agree in every key. (A key that
        is new, with its default, is a change of the program, which the commit tells.)"""
        from findings.cases import picture_cases
        from study.case import run_command
        shown = re.search(r'src="(\S+reference_case_in_a_row\.png)"', (source / "README.md").read_text())[1]
        text = png_text(source / shown)
        with tempfile.TemporaryDirectory(prefix="vitrum-") as folder:
            command = run_command(picture_cases(False)["reference"], folder)
            subprocess.run([*command, "--no-fields", "--set", "time.end=-14.9e-6"], check=True, capture_output=True, timeout=120)
            with h5py.File(f"{folder}/result.h5") as result:
                today = flat(tomllib.loads(result["scene/resolved"][()].decode()))
        then = flat(tomllib.loads(text["vitrum-scene"]))
        then["time.end"] = today["time.end"] = None
        changed = {key: (value, today.get(key)) for key, value in then.items() if today.get(key) != value}
        self.assertEqual(changed, {}, f"(picture, scene) differ; {again}")

    def test_every_picture_is_there_and_says_what_made_it(self):
        from PIL import Image
        for page in pages:
            for name in re.findall(r'(?:!\[[^]]*\]\(|<img src=")([^)"]+\.png)', page.read_text()):
                path = page.parent / name
                self.assertTrue(path.exists(), f"{page.name} shows {name}, which is not there")
                with Image.open(path) as picture:
                    self.assertIn("vitrum-commit", picture.text, f"{name}: no stamp")

    def test_every_page_names_the_paper_where_it_first_speaks_of_it(self):
        """By its title; a page of the theory by a link to the page that begins with it."""
        for page in pages:
            paragraphs = page.read_text().split("\n\n")
            first = next((n for n, paragraph in enumerate(paragraphs) if re.search(r"\b[Tt]he paper\b", paragraph)), None)
            if first is not None:
                until = first + (2 if paragraphs[first].startswith("#") else 1)
                so_far = " ".join("\n\n".join(paragraphs[:until]).split())
                self.assertTrue(title in so_far or re.search(r"\[[Tt]he paper\]\((\.\./theory/)?index\.md\)", so_far), f"{page.name}: {paragraphs[first][:200]}")
        self.assertIn(title, (source / "docs/theory/index.md").read_text().split("\n\n")[1].replace("\n", " "))
        self.assertIn(title, (source / "CITATION.cff").read_text())


if __name__ == "__main__":
    unittest.main()
