"""README, docs/start, docs/tutorials and what is fenced in docs/howto do what they say: every code block is executed, in a folder of its own, at low resolution."""
import codeop
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

from support import PackageTest, source

sys.path.insert(0, str(source / "docs/site"))
import pages  # noqa: E402

docs = source / "docs"
followed = [source / "README.md", source / "CONTRIBUTING.md", *sorted((docs / "start").glob("*.md")), *sorted((docs / "tutorials").glob("*.md")),
            *(page for page in sorted((docs / "howto").glob("*.md")) if "```" in page.read_text())]


class Pages(unittest.TestCase):
    def test_every_block_works(self):
        for page in followed:
            with self.subTest(page=page.name), tempfile.TemporaryDirectory(prefix="vitrum-") as folder:
                pages.test(page, folder)

    def test_python_may_be_pasted(self):
        """Into an interpreter that reads line by line: a blank line, and nothing else, ends what is indented."""
        for page in followed:
            for block in pages.blocks(page):
                if block.kind == "python":
                    with self.subTest(block=block.place):
                        typed = []
                        for line in [*block.text.splitlines(), ""]:
                            typed.append(line)
                            if codeop.compile_command("\n".join(typed)) is not None:
                                typed = []
                        self.assertEqual(typed, [])

    def test_no_block_hides_from_the_test(self):
        """Fenced blocks are executed; so none is indented."""
        for page in followed:
            outside = pages.fence.sub("", page.read_text())
            self.assertNotRegex(outside, r"(?m)^\n {4}\S", page.name)


class Runner(PackageTest):
    """The runner sees what it is there to see."""

    def stumble(self, text):
        page = self.folder / "page.md"
        page.write_text(textwrap.dedent(text))
        folder = self.folder / "followed"
        folder.mkdir()
        with self.assertRaises(pages.Stumble) as seen:
            pages.test(page, folder)
        return str(seen.exception)

    def test_a_command_that_fails(self):
        self.assertIn("page.md:2: status 1", self.stumble("""\
            ```sh
            false | true
            ```
            """))

    def test_python_that_fails(self):
        self.assertIn("page.md:2: ZeroDivisionError", self.stumble("""\
            ```python
            1 / 0
            ```
            """))

    def test_an_output_that_reads_otherwise(self):
        self.assertIn("not printed: ['# balls']", self.stumble("""\
            ```sh
            echo 3 plates
            ```
            ```text
            3 balls
            ```
            """))

    def test_a_picture_that_nothing_makes(self):
        self.assertIn("none of its blocks made", self.stumble("![](../pictures/pages/none.png)\n"))

    def test_a_block_of_an_unknown_kind(self):
        self.assertIn("excuse it", self.stumble("```ruby\nputs 1\n```\n"))

    def test_a_block_without_a_kind(self):
        self.assertIn("without a kind", self.stumble("```\nfalse\n```\n"))


if __name__ == "__main__":
    unittest.main()
