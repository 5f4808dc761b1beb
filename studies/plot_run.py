#!/usr/bin/python3
"""Draws the pictures of a run.

    studies/plot_run.py OUTDIR [--out PICTURES_DIR] [--times T1 T2 ...]

Writes snapshots, damage, opening, cracks, fragments, fragment-masses, failure and energy as PNG and PDF, and says why one is missing. A run made with
--no-fields has the last two. Each PNG carries the commit, the command and the scene of the run as text. Exit status: 0 done; 2 the input is wrong.
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


def save(figure, folder, name, stamp):
    import matplotlib.pyplot as plt
    from vitrum.plot.looks import dots_per_inch
    for suffix in ("png", "pdf"):
        path = folder / f"{name}.{suffix}"
        figure.savefig(path, dpi=dots_per_inch, metadata=stamp if suffix == "png" else {"Creator": stamp["Source"]})
        print(path)
    plt.close(figure)


def draw(options):
    import matplotlib
    matplotlib.use("Agg")
    import vitrum
    from vitrum import plot
    from vitrum.plot import stamp

    run = vitrum.load(options.directory)
    run.frames_at(options.times)
    folder = pathlib.Path(options.out) if options.out else run.directory / "pictures"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise vitrum.InputError(f"{folder}: cannot be made: {error.strerror}") from error
    for figure_of, missing in plot.of_particles.items():
        name = figure_of.__name__.replace("_", "-")
        figure = figure_of(run, options.times)
        if figure is None:
            print(f"{name}: not drawn: {missing if run.frames else 'the run was made with --no-fields'}")
        else:
            save(figure, folder, name, stamp.of_run(run))
    for figure_of, missing in plot.over_time.items():
        figure = figure_of(run)
        if figure is None:
            print(f"{figure_of.__name__}: not drawn: {missing}")
        else:
            save(figure, folder, figure_of.__name__, stamp.of_run(run))


def main(arguments):
    options = parse(arguments)
    try:
        import vitrum
        try:
            draw(options)
        except vitrum.Error as error:
            print(f"error: {error}", file=sys.stderr)
            return 2
    except ModuleNotFoundError as error:
        print(f"error: Python module '{error.name}' is missing: install python3-numpy, python3-h5py and python3-matplotlib", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
