#!/usr/bin/python3
"""Draws the pictures of a run: snapshots, damage, openings, energy.

    studies/plot_run.py OUTDIR [--out PICTURES_DIR] [--times T1 T2 ...]

Writes snapshots, damage, opening and energy as PNG and PDF. Exit status: 0 done; 2 the input is wrong.
"""
import argparse
import pathlib
import sys


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def parse(arguments):
    parser = argparse.ArgumentParser(description="pictures of a run of vitrum")
    parser.add_argument("directory", metavar="OUTDIR", help="folder that the run left: result.h5, energy.csv, summary.json")
    parser.add_argument("--out", metavar="PICTURES_DIR", help="folder of the pictures (default: OUTDIR/pictures)")
    parser.add_argument("--times", type=float, nargs="+", metavar="T",
                        help="times of the panels, s; the nearest outputs are taken (default: six, spread over the run)")
    # argparse takes -1.5e-5 for an option, unless a blank precedes it.
    return parser.parse_args([f" {text}" if is_number(text) else text for text in arguments])


def save(figure, folder, name):
    import matplotlib.pyplot as plt
    for suffix in ("png", "pdf"):
        path = folder / f"{name}.{suffix}"
        figure.savefig(path, dpi=150)
        print(path)
    plt.close(figure)


def draw(options):
    import matplotlib
    matplotlib.use("Agg")
    from plotting.energy_figure import energy_history
    from plotting.particle_figures import damage, opening, snapshots
    from plotting.run_results import BadInput, RunResults

    run = RunResults(options.directory)
    frames = run.frames_at(options.times)
    folder = pathlib.Path(options.out) if options.out else run.directory / "pictures"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: cannot be made: {error.strerror}") from error
    save(snapshots(run, frames), folder, "snapshots")
    for name, figure, reason in (("damage", damage(run, frames), "no material of the scene is damaged"),
                                 ("opening", opening(run, frames), "nothing has opened at these times")):
        if figure is None:
            print(f"{name}: not drawn: {reason}")
        else:
            save(figure, folder, name)
    save(energy_history(run), folder, "energy")


def main(arguments):
    options = parse(arguments)
    try:
        from plotting.run_results import BadInput
    except ModuleNotFoundError as error:
        print(f"error: Python module '{error.name}' is missing: install python3-h5py and python3-matplotlib", file=sys.stderr)
        return 2
    try:
        draw(options)
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except ModuleNotFoundError as error:
        print(f"error: Python module '{error.name}' is missing: install python3-matplotlib", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
