"""A study of one's own scene: what an accuracy costs, how large each quantity's errors are, and how it varies."""
import pathlib
import sys
import tempfile

from study.case import Case
from study.command import main
from study.outcome import StudyError
from study.outcome import run as compute

from own import plan as plans

name = "own"


def jobs(quick):
    """A job for each case, so that what is done can be counted."""
    return list(plans.load(".")["cases"])


def cases(quick):
    plan = plans.load(".")
    _try_quantities(plan)
    return [plans.case(plan, each) for each in plan["cases"]]


def _try_quantities(plan):
    """Quantities are looked up in a run of a moment, before hours of others: a path that is none ends the study here."""
    from own.quantities import of_run, value
    time = plan["resolved"]["time"]
    with tempfile.TemporaryDirectory() as folder:
        outcome = compute(Case("try", plan["scene"], {**plans.case(plan, "base").settings, "time.end": time["start"] + 1e-4 * (time["end"] - time["start"])}), folder)
        summary = of_run(outcome)
        for quantity in plan["quantities"] or []:
            try:
                value(quantity["source"], summary)
            except StudyError as error:
                raise StudyError(f"{plan['file']}: quantity {quantity['name']!r}: {error}") from error


def run(job, quick, out):
    compute(plans.case(plans.load(out), job), out / "runs")


def report(quick, out):
    """Writes tables, figures and report.html itself."""
    from own import page
    page.write(pathlib.Path(out), quick)


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
