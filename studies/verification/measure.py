#!/usr/bin/python3
"""How near each test comes to the bound that it asserts, from the assertions themselves:

    studies/verification/measure.py BUILD [--out FILE]

BUILD is a build tree with the Catch2 executables of tests (cmake --preset release && cmake --build --preset release). Writes
docs/reports/verification-measured.md: for every test of tests/verification and tests/stability its assertion that came nearest to its bound.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import xml.etree.ElementTree

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from assertions import comparison  # noqa: E402
from study.page import measured_by, paper_title  # noqa: E402

root = here.parent.parent
programs = ("verification", "stability")


class Test:
    """A test case: its name, its file, how many assertions it made, and the comparison that came nearest to its bound."""

    def __init__(self, name, file):
        self.name, self.file, self.assertions, self.nearest = name, file, 0, None

    def add(self, original, expanded):
        self.assertions += 1
        compared = comparison(original, expanded)
        if compared and (self.nearest is None or compared.share > self.nearest.share):
            self.nearest = compared


def tests_of(program):
    """Every test of a Catch2 executable, run with a report of all assertions. Ends the script if one fails."""
    process = subprocess.Popen([program, "--success", "--reporter", "xml"], stdout=subprocess.PIPE)
    tests, failed = [], 0
    for event, element in xml.etree.ElementTree.iterparse(process.stdout, events=("start", "end")):
        if event == "start" and element.tag == "TestCase":
            tests.append(Test(element.get("name"), pathlib.Path(element.get("filename")).name))
        if event == "end" and element.tag == "Expression":
            failed += element.get("success") != "true"
            tests[-1].add(element.findtext("Original", ""), element.findtext("Expanded", ""))
        if event == "end" and element.tag in ("Expression", "Info", "Section"):
            element.clear()
    if process.wait() != 0 or failed:
        sys.exit(f"{program}: {failed} assertions failed")
    return tests


def cell(text, most=90):
    """Text that a table's cell can hold."""
    text = text if len(text) <= most else text[:most - 1] + "…"
    return text.replace("|", "\\|")


def table(tests):
    rows = ["| test | assertion that came nearest | measured | bound | share of the bound | assertions |", "|---|---|---|---|---|---|"]
    for test in tests:
        near = test.nearest
        shown = (f"`{cell(near.text)}`", near.measured, near.bound, f"{near.share:.2g}") if near else ("none with a bound", "", "", "")
        rows.append("| " + " | ".join([cell(test.name, 160), *shown, f"{test.assertions:,}"]) + " |")
    return "\n".join(rows)


def by_file(tests):
    files = {}
    for test in tests:
        files.setdefault(test.file, []).append(test)
    return files


def page(measured):
    """Text of the page; measured: tests by program."""
    tests = [test for program in programs for test in measured[program]]
    shares = sorted(test.nearest.share for test in tests if test.nearest)
    near = [test for test in tests if test.nearest and test.nearest.share > 0.9]
    text = (f"# Verification: how near each test comes to its bound\n\n{measured_by('studies/verification/measure.py')}\n\n"
            "A test asserts a bound. How much of it does the program use up?\n\n"
            f"**Answer.** {len(tests)} tests make {sum(test.assertions for test in tests):,} assertions, and {len(shares)} of the tests compare values with a bound. "
            f"Half of these use less than {statistics.median(shares):.2g} of it at their nearest assertion. {len(near)} use more than 0.9.\n\n"
            f"What each test is about: [verification](verification.md). The paper in their names is *{paper_title}*. Only the nearest assertion of a test is shown. Of a property test it is the worst of all random states. "
            "Share: measured over an upper bound, a lower bound over measured, or the distance from a value over what is allowed. "
            "A property that is stated as a distance of ends (an order between 1.8 and 2.4) is nearest at one of its ends. Counts and truths have no share.\n")
    for program in programs:
        text += f"\n## tests/{program}\n"
        for file, some in by_file(measured[program]).items():
            text += f"\n### {file}\n\n{table(some)}\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=root / "docs/reports/verification-measured.md")
    arguments = parser.parse_args()
    os.environ["VITRUM"] = str((arguments.build / "src/app/vitrum").resolve())
    measured = {program: tests_of((arguments.build / f"tests/tests_{program}").resolve()) for program in programs}
    arguments.out.write_text(page(measured))


if __name__ == "__main__":
    main()
