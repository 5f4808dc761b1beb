"""A study of one's own scene: what an accuracy costs, how large each quantity's errors are, and how it varies."""
import pathlib
import sys

from study.command import main
from study.files import cases, jobs, run  # noqa: F401

name = "own"


def report(quick, out):
    """Writes tables, figures and report.html itself."""
    from own import page
    page.write(pathlib.Path(out), quick)


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
