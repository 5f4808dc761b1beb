"""How far a study is: a line for each finished job, and progress.json for whoever looks on. Snakemake calls `log_handler`, in the study's folder."""
import json
import pathlib
import sys
import time

_start = time.monotonic()
_running: set[int] = set()
_before: int | None = None  # cases that were done when the study began
_said = ""


def _duration(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def line(done, every, running, elapsed, before=0):
    """`before`: of those done, how many were done when the clock was started.

    >>> line(5, 20, 2, 10.0), line(12, 20, 0, 10.0, before=10)
    ('5 of 20 cases done, 2 running, about 30 s left', '12 of 20 cases done, about 40 s left')
    """
    left = f", about {_duration(elapsed / (done - before) * (every - done))} left" if before < done < every else ""
    return f"{done} of {every} cases done" + (f", {running} running" if running else "") + left


def expect(weights):
    """Tells who counts what there is to do (job -> cases), in the study's folder."""
    _write(pathlib.Path(".jobs.json"), weights)
    done, every = _counts()
    _record(done, every, line(done, every, 0, 0.0, done))


def _write(path, record):
    """Whole at any moment."""
    following = path.with_name(f"{path.name}.next")
    following.write_text(json.dumps(record))
    following.replace(path)


def _counts():
    """(cases done, all)."""
    weights = json.loads(pathlib.Path(".jobs.json").read_text())
    return sum(cases for job, cases in weights.items() if pathlib.Path(f"jobs/{job}.done").exists()), sum(weights.values())


def _record(done, every, text):
    _write(pathlib.Path("progress.json"), {"text": text, "done": done, "every": every, "at": time.strftime("%Y-%m-%d %H:%M:%S")})


def _tell():
    global _before, _said
    done, every = _counts()
    if _before is None:
        _before = done
    text = line(done, every, len(_running), time.monotonic() - _start, _before)
    if text == _said:  # what was done is no case: the check of all scenes, the page
        return
    _said = text
    print(text, file=sys.stderr, flush=True)
    _record(done, every, text)


def read(out):
    """What the study in this folder said last: text, done, every, at."""
    path = pathlib.Path(out) / "progress.json"
    return json.loads(path.read_text()) if path.exists() else {"text": "no case done yet", "done": 0, "every": 1, "at": time.strftime("%Y-%m-%d %H:%M:%S")}


def log_handler(message):
    level = message["level"]
    if level == "job_info":
        _running.add(message["jobid"])
    elif level in ("job_finished", "job_error"):
        _running.discard(message["jobid"])
    elif level == "progress":
        _tell()
    elif level in ("error", "warning") or (level == "info" and "Nothing to be done" in message["msg"]):
        print(message["msg"], file=sys.stderr, flush=True)
    if level == "job_error":
        print(f"job {message['name']} failed: see above", file=sys.stderr, flush=True)


def _alone():
    """Takes the place of Snakemake's own words (pages of them), without its --quiet, under which it tells no handler of progress."""
    from snakemake.logging import logger
    logger.log_handler.clear()


if __name__ == "log":  # as Snakemake loads it
    _alone()
