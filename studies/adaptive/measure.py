#!/usr/bin/python3
"""Steps, work, time and achieved error of every order and tolerance of the adaptive methods, beside explicit steps.

    studies/adaptive/measure.py VITRUM [--out DIR] [--quick]

Two cases: `smooth` (a swinging elastic disk) and `reference` (the paper's case up to first touch of the surfaces, t = 0:
by then steel and glass have localised). The achieved error is the root mean square difference of all particle velocities at the end, relative to the scale of velocity
(0.2 and 200 m/s), from a run of the particle system under order 5 with a tolerance of 1e-9 (smooth) or 1e-6 (reference); implicit runs are
also compared with their own tight run, which has the same remaps. Leaves measure.csv, measure.md (tables) and tolerance.png in DIR.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

here = pathlib.Path(__file__).resolve().parent
cases = {"smooth": (here / "smooth.toml", 0.2, [], 1e-9),
         "reference": (here.parent / "paper" / "reference.toml", 200.0, ["time.end=0.0", "integrator.max_growth=inf"], 1e-6)}
columns = ["case", "shape", "method", "setting", "steps", "rejected", "rhs", "factorisations", "seconds", "error", "own_error",
           "estimate"]
longest = 120  # s, of one run


class Measurement:
    def __init__(self, program, out):
        self.program, self.out = program, out

    def run(self, case, shape, *settings):
        """Summary and velocities of one run; None when it takes too long."""
        scene, _, fixed, _ = cases[case]
        folder = self.out / "run"
        command = [self.program, "run", scene, "--out", folder, "--force", "--quiet", "--threads", "1"]
        for setting in [f'space.shape_functions="{shape}"', *fixed, *settings]:
            command += ["--set", setting]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=longest)
        except subprocess.TimeoutExpired:
            return None
        if done.returncode != 0:
            print(done.stderr.splitlines()[-1], file=sys.stderr)
            return None
        with h5py.File(folder / "result.h5") as result:
            last = result["steps"][sorted(result["steps"])[-1]]
            velocities = last["particles/velocity"][:]
        return json.loads((folder / "summary.json").read_text()), velocities

    def row(self, case, shape, method, setting, answer, reference, own=None):
        if answer is None:
            return dict.fromkeys(columns) | {"case": case, "shape": shape, "method": method, "setting": setting}
        summary, velocities = answer
        scale = cases[case][1]
        error = lambda other: float(np.sqrt(np.mean((velocities - other) ** 2)) / scale) if other is not None else None
        i = summary["integrator"]
        return {"case": case, "shape": shape, "method": method, "setting": setting, "steps": i["steps"], "rejected": i["rejected"],
                "rhs": i["rhs_evaluations"], "factorisations": i["factorisations"], "seconds": summary["wall_seconds"],
                "error": error(reference), "own_error": error(own),
                "estimate": i["error_estimate"]["velocity"] if i["error_estimate"] else None}

    def rows(self, case, shape, orders, tolerances, steps):
        adaptive = lambda method, order, rtol: self.run(case, shape, f'integrator.method="{method}"', f"integrator.order={order}",
                                                        f"integrator.rtol={rtol:g}")
        tight = adaptive("arkode-explicit", 5, cases[case][3])
        reference = tight[1] if tight else None
        for scheme in ("usf", "musl"):
            for step in steps:
                answer = self.run(case, shape, 'integrator.method="explicit"', f'integrator.scheme="{scheme}"', f"integrator.step={step:g}")
                yield self.row(case, shape, scheme, f"{step * 1e6:g} us", answer, reference)
        for method in ("arkode-explicit", "arkode-implicit"):
            own = None
            if method == "arkode-implicit":
                tight = adaptive(method, 5, 1e-8 if case == "smooth" else 1e-4)
                own = tight[1] if tight else None
            for order in orders:
                for rtol in tolerances:
                    if case == "reference" and method == "arkode-implicit" and rtol < 1e-3:
                        continue
                    yield self.row(case, shape, f"{method} {order}", f"{rtol:g}", adaptive(method, order, rtol), reference, own)


def text(value):
    if value is None:
        return ""
    return f"{value:.2g}" if isinstance(value, float) else str(value)


def write_tables(rows, path):
    with open(path, "w") as file:
        for case in cases:
            of_case = [r for r in rows if r["case"] == case]
            if not of_case:
                continue
            file.write(f"\n## {case}\n\n| " + " | ".join(columns[1:]) + " |\n|" + "---|" * (len(columns) - 1) + "\n")
            for r in of_case:
                file.write("| " + " | ".join(text(r[c]) for c in columns[1:]) + " |\n")


def draw(rows, path):
    """Achieved error against tolerance, smooth case."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 4), sharey=True)
    for axis, method, key in ((axes[0], "arkode-explicit", "error"), (axes[1], "arkode-implicit", "own_error")):
        for order in (2, 3, 4, 5):
            points = [(float(r["setting"]), r[key]) for r in rows if r["case"] == "smooth" and r["shape"] == "bspline2"
                      and r["method"] == f"{method} {order}" and r[key]]
            if points:
                axis.loglog(*zip(*points), "o-", label=f"order {order}")
        limits = np.array([1e-7, 1e-1])
        axis.loglog(limits, limits, "k:", lw=1, label="error = rtol")
        axis.set(xlabel="integrator.rtol", title=method + (", one set of remaps" if key == "own_error" else ""))
        axis.legend(fontsize=8)
    axes[0].set_ylabel("achieved error of velocity / scale")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/adaptive"))
    parser.add_argument("--quick", action="store_true", help="few orders and tolerances")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    measurement = Measurement(pathlib.Path(arguments.program).resolve(), arguments.out)
    orders = (3,) if arguments.quick else (2, 3, 4, 5)
    tolerances = (1e-2, 1e-4) if arguments.quick else (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
    steps = (0.05e-6,) if arguments.quick else (0.2e-6, 0.1e-6, 0.05e-6, 0.025e-6, 0.0125e-6)
    rows = []
    with open(arguments.out / "measure.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        for case in cases:
            for shape in ("bspline2",) if arguments.quick else ("linear", "gimp", "bspline2"):
                for row in measurement.rows(case, shape, orders, tolerances, steps):
                    rows.append(row)
                    writer.writerow(row)
                    file.flush()
                    print(" ".join(text(row[c]) for c in columns), file=sys.stderr)
    write_tables(rows, arguments.out / "measure.md")
    draw(rows, arguments.out / "tolerance.png")


if __name__ == "__main__":
    main()
