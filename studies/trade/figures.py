"""Figures of the trade between speed and accuracy."""
import numpy as np
from matplotlib.lines import Line2D
from study.figures import legend_below, plt, save

# Families by colour, members by marker.
looks = {"usf": ("#000000", "o"), "usl": ("#000000", "s"), "musl": ("#000000", "^"),
         "erk2": ("#0072B2", "o"), "erk3": ("#0072B2", "s"), "erk4": ("#0072B2", "^"), "erk5": ("#0072B2", "D"),
         "dirk2": ("#D55E00", "o"), "dirk3": ("#D55E00", "s"), "dirk4": ("#D55E00", "^"), "dirk5": ("#D55E00", "D")}
names = {"usf": "USF", "usl": "USL", "musl": "MUSL", **{f"erk{n}": f"ERK {n}" for n in (2, 3, 4, 5)}, **{f"dirk{n}": f"DIRK {n}" for n in (2, 3, 4, 5)}}


def _curves(axes, rows, x, y, families):
    for family in families:
        points = sorted(((row["tightness"], row[x], row[y]) for row in rows if row["family"] == family and row["local"] == "closed-form"
                         and row[x] and row[y]), reverse=True)
        if points:
            colour, marker = looks[family]
            axes.loglog([p[1] for p in points], [p[2] for p in points], color=colour, marker=marker, markerfacecolor="white", linewidth=1.0, markersize=4)


def _legend(figure, families, more=()):
    handles = [Line2D([], [], color=looks[family][0], marker=looks[family][1], markerfacecolor="white", linewidth=1.0, markersize=4, label=names[family])
               for family in families]
    legend_below(figure, [*handles, *more])


def _floor(axes, value):
    """How far both reference solutions are apart: nothing below it means anything."""
    if value:
        axes.axhspan(axes.get_ylim()[0], value, color="#DDDDDD", linewidth=0, zorder=0)


def _limits(rows, column, floor):
    values = [row[column] for row in rows if row[column] and row["local"] == "closed-form"]
    low = min(values + ([floor] if floor else []))
    return 0.4 * low, min(2.5 * max(values), 10.0)


def work_precision(problem, folder, name):
    """Error of the velocities over wall time and over right-hand sides; a row of panels for each shape function."""
    rows, floors, shapes = problem.rows, problem.floors, problem.shapes
    families = [family for family in looks if any(row["family"] == family for row in rows)]
    figure, panels = plt.subplots(len(shapes), 2, figsize=(6.8, 2.4 * len(shapes) + 0.9), squeeze=False, sharey="row", sharex="col")
    for line, shape in zip(panels, shapes):
        chosen = [row for row in rows if row["shape"] == shape]
        for axes, x in zip(line, ("seconds", "rhs")):
            _curves(axes, chosen, x, "velocity", families)
            axes.set_ylim(*_limits(chosen, "velocity", floors.get((shape, "velocity"))))
            _floor(axes, floors.get((shape, "velocity")))
            axes.set_title(problem.named(shape))
        line[0].set_ylabel("error of velocity (–)")
    panels[-1, 0].set_xlabel("wall time (s)")
    panels[-1, 1].set_xlabel("evaluations of the right-hand side")
    figure.suptitle(problem.title, fontsize=10)
    _legend(figure, families, [Line2D([], [], color="#DDDDDD", linewidth=6, label="references differ")])
    save(figure, folder, name)


def quantities(problem, folder, name):
    """Error of each quantity over wall time, linear shape functions."""
    rows, floors, columns = problem.linear(), problem.floors, problem.names
    families = [family for family in looks if any(row["family"] == family for row in rows)]
    count = len(columns)
    figure, panels = plt.subplots(-(-count // 2), 2, figsize=(6.8, 2.4 * -(-count // 2) + 0.9), squeeze=False, sharex=True)
    for axes, column in zip(panels.flat, columns):
        _curves(axes, rows, "seconds", column, families)
        if any(row[column] for row in rows):
            axes.set_ylim(*_limits(rows, column, floors.get(("linear", column))))
            _floor(axes, floors.get(("linear", column)))
        axes.set_title(column)
    for axes in panels.flat[count:]:
        axes.set_visible(False)
    for axes in panels[:, 0]:
        axes.set_ylabel("error (–)")
    for axes in panels.flat[max(0, count - 2):count]:
        axes.set_xlabel("wall time (s)")
        axes.xaxis.set_tick_params(labelbottom=True)
    figure.suptitle(problem.title, fontsize=10)
    _legend(figure, families, [Line2D([], [], color="#DDDDDD", linewidth=6, label="references differ")])
    save(figure, folder, name)


def tolerance(problems, folder, name):
    """Achieved over requested, linear shape functions; implicit runs against their own tight run, which has the same remaps."""
    figure, panels = plt.subplots(len(problems), 2, figsize=(6.8, 2.5 * len(problems) + 0.8), squeeze=False, sharex=True, sharey="row")
    families = []
    for line, problem in zip(panels, problems):
        rows = problem.linear()
        for axes, prefix, column in ((line[0], "erk", "velocity"), (line[1], "dirk", "own velocity")):
            here = [family for family in looks if family.startswith(prefix) and any(row["family"] == family for row in rows)]
            families += [family for family in here if family not in families]
            _curves(axes, rows, "tightness", column, here)
            span = np.array([1e-6, 1e-1])
            axes.loglog(span, span, color="black", linewidth=0.8, linestyle=":")
            if not here:
                axes.set_visible(False)
            axes.set_title(f"{problem.short}, {'explicit' if prefix == 'erk' else 'implicit, same remaps'}", fontsize=8)
        line[0].set_ylabel("achieved error (–)")
    for axes in panels[-1]:
        axes.set_xlabel("requested rtol")
    _legend(figure, families, [Line2D([], [], color="black", linewidth=0.8, linestyle=":", label="achieved = requested")])
    save(figure, folder, name)


def divergence(series, folder, name):
    """How far both reference solutions of the run to failure are apart over time. `series`: label -> (time, velocity, kinetic)."""
    figure, panels = plt.subplots(1, 2, figsize=(6.8, 2.9), sharex=True)
    for (label, (time, velocity, kinetic)), colour, dashes in zip(series.items(), ("#0072B2", "#D55E00", "#009E73"), ("-", "--", "-.")):
        for axes, values in zip(panels, (velocity, kinetic)):
            axes.semilogy(1e6 * time, np.where(values > 0.0, values, np.nan), color=colour, linestyle=dashes, label=label)
    panels[0].set_ylabel("RMS velocity, of 200 m/s")
    panels[1].set_ylabel("kinetic energy, relative")
    figure.suptitle("Difference between the two reference solutions", fontsize=10)
    for axes in panels:
        axes.set_xlabel("time (µs)")
    legend_below(figure, panels[0].get_lines())
    save(figure, folder, name)


def local(problems, rows, folder, name):
    """What local integration changes: error of the velocities over wall time."""
    markers = {"closed-form": "o", "substep": "s", "cvode": "D"}
    shown = list(dict.fromkeys(row["problem"] for row in rows))
    figure, panels = plt.subplots(1, len(shown), figsize=(3.4 * len(shown) + 0.4, 3.2), squeeze=False)
    for axes, problem in zip(panels[0], shown):
        for row in rows:
            if row["problem"] == problem and row["velocity"]:
                colour = looks[row["family"]][0]
                axes.loglog(row["seconds"], row["velocity"], linestyle="", marker=markers[row["local"].split()[0]], markerfacecolor="white", color=colour)
        axes.set_title(problems[problem].short)
        axes.set_xlabel("wall time (s)")
    panels[0, 0].set_ylabel("error of velocity (–)")
    handles = [Line2D([], [], linestyle="", marker=marker, markerfacecolor="white", color="#666666", label=kind) for kind, marker in markers.items()]
    handles += [Line2D([], [], color=looks[family][0], linewidth=2, label=label) for family, label in (("musl", "MUSL 0.05 µs"), ("erk3", "ERK 3, rtol 1e-4"))]
    legend_below(figure, handles)
    save(figure, folder, name)
