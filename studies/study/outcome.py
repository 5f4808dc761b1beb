"""Running a case, and reading what it left."""
import json
import pathlib
import subprocess
import tempfile
import time
from functools import cached_property

from vitrum.results import load

from study.case import digest, inputs, program, run_command

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

    def repeat(self, case, number):
        """Runs the case once more, for its time alone."""
        path = self.folder / f"repeat-{number}.json"
        if path.exists():
            return
        with tempfile.TemporaryDirectory(prefix="vitrum-") as scratch:
            start = time.perf_counter()
            subprocess.run(run_command(case, scratch), capture_output=True, check=True)
            record = {"wall_seconds": json.loads((pathlib.Path(scratch) / "summary.json").read_text())["wall_seconds"], "seconds": time.perf_counter() - start}
        _write_whole(path, record)

    def repeats(self):
        """Wall times (s) of the time loops of further runs."""
        return [json.loads(path.read_text())["wall_seconds"] for path in sorted(self.folder.glob("repeat-*.json"))]


def _write_whole(path, record):
    """A file that is there is finished."""
    temporary = path.with_name(f".{path.name}.next")
    temporary.write_text(json.dumps(record, indent=1))
    temporary.rename(path)


def _stamp(case):
    """What must be the same for a run to be kept; wherever the study's folder stands."""
    return {"command": run_command(case, case.name), "program": digest(program()), "inputs": inputs(case.scene, [case.settings])}


def kept(case, runs):
    """The outcome of `case` in the folder `runs`/NAME where it is there, by the same program; else None."""
    folder = pathlib.Path(runs) / case.name
    path = folder / "outcome.json"
    if not path.exists():
        return None
    record = json.loads(path.read_text())
    if record["status"] == "too-long" and record["seconds"] < case.longest:  # it may take longer now
        return None
    return Outcome(folder) if all(record.get(key) == value for key, value in _stamp(case).items()) else None


def run(case, runs):
    """The outcome of `case`, which is computed where it is not kept."""
    outcome = kept(case, runs)
    if outcome is None:
        folder = pathlib.Path(runs) / case.name
        _compute(case, folder)
        outcome = Outcome(folder)
    return outcome


def _compute(case, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for old in (folder / "outcome.json", *folder.glob("repeat-*.json")):
        old.unlink(missing_ok=True)
    start = time.perf_counter()
    try:
        done = subprocess.run(run_command(case, folder), capture_output=True, text=True, timeout=case.longest)
    except subprocess.TimeoutExpired:
        status, message = "too-long", f"stopped after {case.longest:g} s"
    else:
        message = done.stderr.strip()
        if done.returncode not in results:
            raise StudyError(f"case {case.name}: exit status {done.returncode}: {message}")
        status = "complete" if done.returncode == 0 else "failed"
    # Last: a folder with an outcome is a finished run.
    _write_whole(folder / "outcome.json", {**_stamp(case), "status": status, "message": message, "seconds": time.perf_counter() - start})
