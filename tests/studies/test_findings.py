"""The quick findings: what they state of the reference case, and what README.md would say."""
import unittest

from support import StudyTest, png_text


class Findings(StudyTest):
    study = "findings"

    def test_files(self):
        self.assert_figures("reference_case", "damage", "cracks", "fragments", "fragment-masses", "paper_step", "paper_step_energy", "side_by_side", "material_curves")
        self.assert_page("Where the instability goes", "The laws, one point at a time",
                         "A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method")
        self.assert_page_does_not_state("None", "of 0 runs", "1e-8")

    def test_steps(self):
        rows = {row["case"]: row for row in self.table("steps", ["case", "status", "until", "max_growth", "residual", "cylinder"])}
        for scheme in ("usf", "musl"):
            self.assertLess(abs(rows[f"{scheme} 5e-08"]["residual"]), 0.005)
            self.assertLess(rows[f"{scheme} 2e-07"]["residual"], -0.05)

    def test_blocks_of_the_front_page(self):
        text = (self.out / "blocks-of-README.md").read_text()
        self.assertNotIn("{{", text)
        for part in ("1.7 times the critical one", "of the impact's energy made by the numerics", "closes the account within", "`study findings` at "):
            self.assertIn(part, text)

    def test_pictures_of_the_front_page_are_drawn_and_published(self):
        from findings import study
        from study.page import pictures_of_blocks
        names = pictures_of_blocks({"README.md": (self.out / "blocks-of-README.md").read_text()}, study.pictures)
        self.assertEqual(len(names), 1)
        self.assertTrue((self.out / "figures" / names[0]).exists(), names)

    def test_picture_carries_its_scene(self):
        text = png_text(self.out / "figures" / "reference_case.png")
        self.assertIn('scheme = "musl"', text["vitrum-scene"])
        self.assertIn("step = 2.5e-08", text["vitrum-scene"])
        self.assertIn("-dirty" if "-dirty" in text["vitrum-commit"] else text["vitrum-commit"], (self.out / "page.md").read_text())


if __name__ == "__main__":
    unittest.main()
