"""A line for each finished job of a study: how many are done, how many run, how long the rest may take. Snakemake calls `log_handler`."""
import sys
import time

_start = time.monotonic()
_running = set()


def _duration(seconds):
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def line(done, every, running, elapsed):
    """
    >>> line(5, 20, 2, 10.0)
    '5 of 20 done, 2 running, about 30 s left'
    """
    left = f", about {_duration(elapsed / done * (every - done))} left" if 0 < done < every else ""
    return f"{done} of {every} done" + (f", {running} running" if running else "") + left


def log_handler(message):
    level = message["level"]
    if level == "job_info":
        _running.add(message["jobid"])
    elif level in ("job_finished", "job_error"):
        _running.discard(message["jobid"])
    elif level == "progress":
        print(line(message["done"], message["total"], len(_running), time.monotonic() - _start), file=sys.stderr, flush=True)
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
