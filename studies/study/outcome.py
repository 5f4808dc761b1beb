"""Running a case, and reading what it left."""
import json
import pathlib
import subprocess
import time
from functools import cached_property

from vitrum.results import load

from study.case import digest, program, run_command, studies

# Exit statuses: done, and computation failed (instability, tolerance not reachable), which is a result too.
results = (0, 3)


class StudyError(Exception):
    """A run that gave no result; the message says which and why."""


class Outcome:
    """What a case gave. `status`: complete | failed | too-long."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.record = json.loads((self.folder / "outcome.json").read_text())
        self.status = self.record["status"]
        self.message = self.record["message"]

    @property
    def complete(self):
        return self.status == "complete"

    @cached_property
    def summary(self):
        """summary.json; None for a run that was stopped."""
        path = self.folder / "summary.json"
        return json.loads(path.read_text()) if path.exists() else None

    @cached_property
    def results(self):
        """Particles and tables over time."""
        return load(self.folder)

    def last(self, name):
        """A particle field of the last output."""
        return self.results.frames[-1][name]

    def series(self, name):
        return self.results.columns("series")[name]


def _up_to_date(folder, stamp):
    path = folder / "outcome.json"
    if not path.exists():
        return False
    record = json.loads(path.read_text())
    return all(record.get(key) == value for key, value in stamp.items())


def run(case, runs):
    """The outcome of `case` in the folder `runs`/NAME; a run that is there already, by the same program, is kept."""
    folder = pathlib.Path(runs) / case.name
    stamp = {"command": run_command(case, folder), "program": digest(program()), "scene": digest(studies / case.scene)}
    if not _up_to_date(folder, stamp):
        _compute(case, folder, stamp)
    return Outcome(folder)


def _compute(case, folder, stamp):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "outcome.json").unlink(missing_ok=True)
    start = time.perf_counter()
    try:
        done = subprocess.run(stamp["command"], capture_output=True, text=True, timeout=case.longest)
    except subprocess.TimeoutExpired:
        status, message = "too-long", f"stopped after {case.longest:g} s"
    else:
        message = done.stderr.strip()
        if done.returncode not in results:
            raise StudyError(f"case {case.name}: exit status {done.returncode}: {message}")
        status = "complete" if done.returncode == 0 else "failed"
    record = {**stamp, "status": status, "message": message, "seconds": time.perf_counter() - start}
    # Last, and whole: a folder with an outcome is a finished run.
    temporary = folder / ".outcome.next"
    temporary.write_text(json.dumps(record, indent=1))
    temporary.rename(folder / "outcome.json")
