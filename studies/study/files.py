"""The jobs of a study that is told by files: what `study.command` asks of its module. The plans are those of the study's folder."""
import pathlib
import sys
import tempfile

from study import plan as plans
from study.case import Case, check
from study.reader import Reader
from study.outcome import StudyError, run as compute
from study.quantities import of_run, value

long_run = 3.0  # s: such runs are timed once


def weights(out="."):
    """Job -> how many runs it is: one, or some that belong together."""
    return {job: len(names) for plan in plans.load_all(out).values() for job, names in plans.jobs(plan).items()}


def jobs(quick, out="."):
    return list(weights(out))


def cases(quick, out="."):
    """Every run of every plan. A quantity that is none ends the study here, before hours of runs."""
    found = []
    for plan in plans.load_all(out).values():
        _try_quantities(plan)
        found += [plans.case(plan, name) for names in plans.jobs(plan).values() for name in names]
    return found


def _try_quantities(plan):
    """Quantities are looked up in a run of a moment, if the program takes its scene."""
    case, time = plans.case(plan, next(iter(plan["cases"]))), plan["resolved"]["time"]
    if check(case):
        return  # the check of all cases says so
    settings = {**case.settings, "time.end": time["start"] + 1e-4 * (time["end"] - time["start"])}
    with tempfile.TemporaryDirectory() as folder:
        summary = of_run(compute(Case("try", plan["scene"], settings), folder))
        for number, quantity in enumerate(plan["quantities"] or []):
            try:
                value(quantity["source"], summary)
            except StudyError as error:
                raise Reader(pathlib.Path(plan["file"])).fault(f"quantity.{number}|from", f"quantity {quantity['name']!r}: {error}") from error


def run(job, quick, out):
    """The runs of a job; then, again and again, those that are to be timed more than once."""
    plan, names = next((plan, names) for plan in plans.load_all(out).values() for found, names in plans.jobs(plan).items() if found == job)
    outcomes = {name: compute(plans.case(plan, name), out / "runs") for name in names}
    for number in range(1, plan["repeats"]):
        for name, outcome in outcomes.items():
            if plan["cases"][name]["role"] == "ladder" and outcome.complete and outcome.record["seconds"] <= long_run:
                outcome.repeat(plans.case(plan, name), number)


if __name__ == "__main__":
    from study.command import main
    sys.exit(main(sys.modules["__main__"]))
