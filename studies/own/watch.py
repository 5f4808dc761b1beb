"""watch.html: the page of a study while it runs, written again and again of the runs that are there (`studies/run NAME|FILE.toml OUT QUICK --watch [SECONDS]`)."""
import fcntl
import pathlib
import sys
import time

from study import progress

from own import page

rest = 4.0  # the page takes at most a part in so many of the time: runs want the processor


def under_way(out):
    """Whether somebody holds the lock of the study (studies/run)."""
    with open(out / ".running") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False


def finished(out):
    state = progress.read(out)
    return state["done"] == state["every"]


def watch(out, quick, seconds):
    """Until the study ends; then the page says how, and a browser that follows it reads it for the last time."""
    print(f"{out / 'watch.html'}: follows the study; open it in a browser", file=sys.stderr, flush=True)
    studies, following = page.studies_of(out, partial=True), 0.0

    def write(state, refresh=None):
        for study in studies:
            study.look_again()
        page.write(out, quick, "watch.html", studies, state, refresh)

    while under_way(out):
        if time.monotonic() >= following:
            start = time.monotonic()
            write({"heading": "Under way", **progress.read(out)}, seconds)
            following = time.monotonic() + max(seconds, rest * (time.monotonic() - start))
        time.sleep(0.2)
    write(None if finished(out) else {"heading": "Stopped", **progress.read(out)})


if __name__ == "__main__":
    watch(pathlib.Path(sys.argv[1]), sys.argv[2] == "1", int(sys.argv[3]))
