"""Charts of the page: matplotlib's SVG, whose ink takes the page's colour, light or dark."""
from __future__ import annotations

import io
import re
from typing import Any, Callable, Iterator

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from vitrum.plot.energy_figure import shares_of
from vitrum.plot.pieces import piece_masses
from vitrum.results import Run

ink = "#010203"  # becomes the page's own text colour
lines = ["#3B8EC8", "#E0762B", "#2BA37F", "#C77BB0", "#C9A227", "#7E9BB5"]
dashes = ["-", "--", "-.", ":"]
style = {"font.size": 9, "axes.edgecolor": ink, "axes.labelcolor": ink, "text.color": ink, "xtick.color": ink, "ytick.color": ink, "axes.spines.top": False,
         "axes.spines.right": False, "axes.linewidth": 0.6, "lines.linewidth": 1.4, "legend.frameon": False, "legend.fontsize": 8, "figure.constrained_layout.use": True,
         "svg.fonttype": "none", "axes.grid": True, "grid.color": "#8888884D", "grid.linewidth": 0.4, "axes.unicode_minus": True, "font.family": "sans-serif"}
size = (4.4, 2.9)  # inches: the width of a phone


def svg(figure: Figure, salt: str) -> str:
    """The figure as a part of a page: scaled by its width, text as text, ids its own."""
    with matplotlib.rc_context({"svg.hashsalt": salt, "svg.fonttype": "none"}):
        file = io.StringIO()
        figure.savefig(file, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    text = file.getvalue()
    text = re.sub(r' id="[A-Za-z]+[\d.]*_\d+"', "", text[text.index("<svg"):])
    text = re.sub(r'<svg[^>]*?viewBox="([^"]*)"[^>]*>', r'<svg viewBox="\1" role="img">', text, count=1)
    return re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL).replace(ink, "currentColor")


def _axes(y: str, x: str = "time (µs)", height: float = size[1]) -> tuple[Figure, Any]:
    figure = Figure(figsize=(size[0], height))
    axes = figure.add_subplot()
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return figure, axes


def _legend(axes: Any) -> None:
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        axes.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, -0.55 / size[1]), ncol=max(1, min(len(labels), int(52 / (6 + max(map(len, labels)))))))


def energy(run: Run) -> Figure:
    """Where the energy is, stacked, and what was put in."""
    account = run.columns("energy")
    figure, axes = _axes("energy (J)" if run.axisymmetric else "energy (J/m)")
    present = shares_of(account)
    time = 1e6 * account["time"]
    axes.stackplot(time, [account[name] for name in present], colors=present.values(), labels=present.keys(), linewidth=0)
    axes.plot(time, account["kinetic"][0] + account["elastic"][0] + account["external"], color=ink, linestyle="--", linewidth=1.0, label="put in")
    _legend(axes)
    return figure


def residual(run: Run) -> Figure:
    """What the numerics have lost or made, of what was put in."""
    account = run.columns("energy")
    put_in = np.maximum.accumulate(np.abs(account["kinetic"][0] + account["elastic"][0]) + np.abs(account["external"]))
    figure, axes = _axes("residual (% of what was put in)")
    with np.errstate(divide="ignore", invalid="ignore"):
        axes.plot(1e6 * account["time"], np.where(put_in > 0.0, 100.0 * account["residual"] / put_in, np.nan), color=lines[0])
    axes.axhline(0.0, color=ink, linewidth=0.6)
    return figure


def _over_time(y: str, curves: dict[str, tuple[np.ndarray, np.ndarray]]) -> Figure | None:
    """Curves by name: (time in s, values)."""
    if not any(np.any(np.isfinite(values)) for _, values in curves.values()):
        return None
    figure, axes = _axes(y)
    for n, (name, (time, values)) in enumerate(curves.items()):
        axes.plot(1e6 * time, values, color=lines[n % len(lines)], linestyle=dashes[n // len(lines) % len(dashes)], label=name, marker="." if len(time) < 3 else None)
    if len(curves) > 1 or list(curves) != [""]:
        _legend(axes)
    return figure


def _by(columns: dict[str, np.ndarray], keys: tuple[str, ...], values: Callable[[dict[str, np.ndarray]], np.ndarray]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Curves of a history, one for each combination of its names."""
    names = list(dict.fromkeys(zip(*(columns[key] for key in keys))))
    rows = {name: np.logical_and.reduce([columns[key] == part for key, part in zip(keys, name)]) for name in names}
    return {" – ".join(map(str, name)): (columns["time"][of], values({key: column[of] for key, column in columns.items()})) for name, of in rows.items()}


def histories(run: Run) -> Iterator[tuple[str, Figure | None]]:
    """Bodies, forces and probes over time."""
    along = "z" if run.axisymmetric else "y"
    bodies = run.columns("bodies")
    mass = {name: run.summary["bodies"][name]["mass"] for name in run.bodies} if run.summary else \
        {name: run.mass[run.body == n].sum() for n, name in enumerate(run.bodies)} if run.frames else {}
    if mass:
        yield f"Velocity of the bodies along {along}", _over_time("m/s", _by(bodies, ("body",), lambda rows: rows["momentum_z"] / mass[rows["body"][0]]))
    if np.any(bodies["separated"]):
        yield "Separated particles", _over_time("particles", _by(bodies, ("body",), lambda rows: rows["separated"]))
    for table, keys, title in (("contacts", ("body_a", "body_b"), "Impulse between bodies"), ("reactions", ("boundary",), "Impulse of boundaries")):
        if (run.directory / f"{table}.csv").exists():
            rows = run.columns(table)
            if len(rows["time"]) and np.any(rows["impulse_z"]):
                yield f"{title} along {along}", _over_time("N s" if run.axisymmetric else "N s/m", _by(rows, keys, lambda each: each["impulse_z"]))
    if (run.directory / "probes.csv").exists():
        rows = run.columns("probes")
        rows = {name: values[rows["point"] == 0] for name, values in rows.items()}
        if len(rows["time"]):
            yield f"Velocity at probes along {along}", _over_time("m/s", _by(rows, ("probe",), lambda each: each["velocity_z"]))
            yield f"Stress at probes along {along}", _over_time("MPa", _by(rows, ("probe",), lambda each: 1e-6 * each["stress_zz"]))


def events(run: Run) -> Figure | None:
    """When what happened: a row for each kind, as high as there are many."""
    found = run.columns("events")
    if not len(found["time"]):
        return None
    first = list(dict.fromkeys(found["kind"]))
    figure, axes = _axes("", height=0.8 + 0.42 * len(first))
    start, end = run.scene["time"]["start"], max(run.scene["time"]["start"] + 1e-12, float(run.columns("series")["time"][-1]))
    edges = np.linspace(start, end, 121)
    for row, kind in enumerate(first):
        counts, _ = np.histogram(found["time"][found["kind"] == kind], edges)
        heights = np.log1p(counts) / np.log1p(counts.max(initial=1))
        axes.bar(1e6 * edges[:-1], 0.8 * heights, 1e6 * np.diff(edges), bottom=-row - 0.4, align="edge", color=lines[row % len(lines)], linewidth=0)
    axes.set_yticks(-np.arange(len(first)), [f"{kind} ({np.sum(found['kind'] == kind):,})" for kind in first])
    axes.set_xlim(1e6 * start, 1e6 * end)
    axes.grid(False, axis="y")
    return figure


def fragments(run: Run) -> Figure | None:
    """Pieces of each body at the last output that are at least as heavy."""
    if not run.frames or run.frames[-1].field("decohesion") is None:
        return None
    unit, scale = ("g", 1e3) if run.axisymmetric else ("kg/m", 1.0)
    figure, axes = _axes("pieces at least as heavy", f"mass ({unit})")
    found = piece_masses(run, run.frames[-1])
    for body, masses in found.items():
        if masses:
            steps = scale * np.array([0.5 * masses[-1], *masses[::-1]])
            axes.step(steps, [len(masses), *range(len(masses), 0, -1)], where="pre", color=lines[body % len(lines)], linestyle=dashes[body % 4],
                      label=f"{run.bodies[body]}: {len(masses)}")
    axes.set_xscale("log")
    axes.set_yscale("log")
    most = max(len(masses) for masses in found.values())
    axes.set_yticks([tick for decade in (1, 10, 100, 1000) for tick in (decade, 2 * decade, 5 * decade) if tick <= 2 * most])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:,g}")
    axes.minorticks_off()
    _legend(axes)
    return figure
