"""The command `vitrum-report`."""
from __future__ import annotations

import argparse
import pathlib
import sys
import time


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="vitrum-report", description="the report of a run: one HTML page, to be opened in a browser; no network")
    parser.add_argument("directory", metavar="DIR", type=pathlib.Path, help="folder that a run left, or is filling")
    parser.add_argument("--out", metavar="FILE.html", type=pathlib.Path, help="the page (default: DIR/report.html)")
    parser.add_argument("--watch", metavar="SECONDS", type=int, nargs="?", const=3, default=0,
                        help="while the run goes on, write the page again every so many seconds (default: 3); the browser follows")
    return parser


def _watch(directory: pathlib.Path, out: pathlib.Path | None, seconds: int) -> pathlib.Path:
    """Writes the page until the run has ended; waits for a run that has not begun."""
    import vitrum
    from vitrum import report
    said = False
    while True:
        ended = (directory / "summary.json").exists()
        if (directory / "result.h5").exists():
            written = report.write(vitrum.load(directory), out, seconds)
            if not said:
                print(f"{written}: follows the run; open it in a browser", flush=True)
                said = True
            if ended:
                return written
        elif ended:
            vitrum.load(directory)  # says what is missing
        time.sleep(seconds)


def main(arguments: list[str] | None = None) -> int:
    options = _parser().parse_args(arguments)
    try:
        import vitrum
        from vitrum import report
        try:
            print(_watch(options.directory, options.out, options.watch) if options.watch else report.write(vitrum.load(options.directory), options.out))
        except vitrum.Error as error:
            print(f"error: {error}", file=sys.stderr)
            return 2
        except OSError as error:
            print(f"error: {error.filename}: {error.strerror}", file=sys.stderr)
            return 4
    except ModuleNotFoundError as error:
        print(f"error: Python module '{error.name}' is missing: install python3-numpy, python3-h5py, python3-matplotlib and python3-jinja2", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    return 0
