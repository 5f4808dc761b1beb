"""Largest stable steps against theory, growth in travel, energy of the reference case, extremes."""
import sys

import numpy as np
from study import files
from study.command import main
from study.results import Study
from study.tables import markdown, number, read_csv, write_csv

from stability import ends, figures, limits, travel

name = "stability"
tolerated = 1.1  # growth per cell of travel that the table of travelling rows admits


def _travel_keys(quick):
    """(scheme, shape, per side, speed in m/s, step in s)."""
    if quick:
        return [("musl", "linear", 1, speed, step) for speed in (200.0, 800.0) for step in (2e-7, 1e-7, 5e-8)]
    steps = (2e-7, 1.5e-7, 1e-7, 7.5e-8, 5e-8, 2.5e-8)
    return [(scheme, shape, per_side, speed, step) for scheme in ("musl", "usf") for shape in figures.shapes for per_side in (1, 2)
            for speed in (50.0, 200.0, 800.0) for step in steps if scheme == "musl" or (shape, per_side) == ("linear", 1)]


def _groups(quick):
    """Jobs: a name and what makes its table's rows."""
    groups: dict[str, list] = {}
    for point in limits.points(quick):
        groups.setdefault(f"limits-{point.scheme}-{point.shape}", []).append(point)
    for key in _travel_keys(quick):
        groups.setdefault(f"travel-{key[0]}-{key[1]}", []).append(key)
    return groups


def jobs(quick):
    return [*_groups(quick), *files.jobs(quick)]


def cases(quick):
    unit = limits.wave_speed
    return [*(limits.resting_case(point, 0.5) for point in limits.points(quick)),
            *(travel.case(scheme, shape, n, speed / unit, step / limits.time_unit) for scheme, shape, n, speed, step in _travel_keys(quick)), *files.cases(quick)]


def run(job, quick, out):
    """A group of what no file can tell: bisections, and rows in travel whose outputs follow from speed and step."""
    members, runs = _groups(quick)[job], out / "runs"
    if job.startswith("limits"):
        rows = [limits.row(point, runs) for point in members]
    else:
        rows = [travel.row(scheme, shape, n, speed / limits.wave_speed, step / limits.time_unit, runs) for scheme, shape, n, speed, step in members]
    write_csv(out / "parts" / f"{job}.csv", list(dict.fromkeys(key for row in rows for key in row)), rows)


def _gather(kind, quick, out):
    """Rows of all groups of a kind, from the tables that their jobs left."""
    rows = [row for job in _groups(quick) if job.startswith(kind) for row in read_csv(out / "parts" / f"{job}.csv")]
    for row in rows:
        row["particles_per_cell"] = int(row["particles_per_cell"])
    return rows


def _limit_table(rows):
    offsets = sorted({row["offset"] for row in rows}, reverse=True)
    body = []
    for key in dict.fromkeys((row["scheme"], row["shape"], row["particles_per_cell"]) for row in rows):
        found = {row["offset"]: row for row in rows if (row["scheme"], row["shape"], row["particles_per_cell"]) == key}
        body.append([figures.names[key[0]], key[1], key[2], *[f"{found[o]['measured']:.3f} ({found[o]['theory']:.3f})" for o in offsets]])
    return markdown(["scheme", "shape functions", "per cell", *[f"offset {o:g}" for o in offsets]], body)


def _largest(rows, which):
    """Largest step (µs) whose growth per cell stays below what is tolerated: between the steps of the ladder on a line of logarithms."""
    points = sorted((row["step_us"], row[which] - 1.0) for row in rows if row[which] is not None)
    below = [step for step, excess in points if excess < tolerated - 1.0]
    if len(below) == len(points):
        return f"> {points[-1][0]:.3g}"
    first = next(n for n, (_, excess) in enumerate(points) if excess >= tolerated - 1.0)
    if first == 0:
        return f"< {points[0][0]:.3g}"
    (a, ga), (b, gb) = points[first - 1], points[first]
    ga = max(ga, 1e-6)
    return f"{a * (b / a) ** (np.log((tolerated - 1.0) / ga) / np.log(gb / ga)):.2g}"


def _travel_table(rows):
    body = []
    speeds = sorted({row["speed"] for row in rows})
    for key in dict.fromkeys((row["scheme"], row["shape"], row["particles_per_cell"]) for row in rows):
        cells = []
        for speed in speeds:
            chosen = [row for row in rows if (row["scheme"], row["shape"], row["particles_per_cell"]) == key and row["speed"] == speed]
            cells.append(f"{_largest(chosen, 'measured')} ({_largest(chosen, 'theory')})")
        body.append([figures.names[key[0]], key[1], key[2], *cells])
    return markdown(["scheme", "shape functions", "per cell", *[f"{speed:.0f} m/s" for speed in speeds]], body)


def _growth_table(rows):
    body = [[f"{row['speed']:.0f}", number(row["step_us"]), number(row["theory"]), number(row["measured"])] for row in rows
            if (row["scheme"], row["shape"], row["particles_per_cell"]) == ("musl", "linear", 1)]
    return markdown(["speed (m/s)", "step (µs)", "theory, per cell", "measured, per cell"], body)


def _energy_table(rows):
    body = []
    for row in rows:
        setting = f"rtol {row['setting']:g}" if row["scheme"] == "erk3" else f"{1e6 * row['setting']:g} µs"
        state = "complete" if row["status"] == "complete" else f"stopped at {number(row['until_us'])} µs"
        body.append([figures.names[row["scheme"]], setting, state, number(row["max_growth"], 4), number(None if row["made"] is None else 100 * row["made"], 2),
                     row["separated_plate"], row["steps"], number(row["seconds"], 2)])
    return markdown(["scheme", "step or tolerance", "state", "largest growth", "energy made (%)", "separated in the plate", "steps", "seconds"], body)


def _extreme_table(rows):
    def said(row):
        return (row["message"] or "").split(";")[0].splitlines()[0][:160] if row["status"] != "complete" and row["message"] else ""
    return markdown(["extreme", "ends", "until (µs)", "steps", "largest growth", "energy made (%)", "says"],
                    [[row["extreme"], row["status"], row.get("until_us"), row.get("steps"), number(row.get("max_growth"), 4),
                      number(None if row.get("made") is None else 100 * row["made"], 2), said(row)] for row in rows])


def report(quick, out):
    energy = Study(out, "energy")
    found = {"limits": _gather("limits", quick, out), "travel": _gather("travel", quick, out), "energy": list(ends.of_energy(energy)),
             "extremes": list(ends.of_extremes(Study(out, "extremes"), Study(out, "on-nodes")))}
    for kind, rows in found.items():
        write_csv(out / "tables" / f"{kind}.csv", list(dict.fromkeys(key for row in rows for key in row)), rows)
    figures.limits(found["limits"], out / "figures", "limits")
    figures.growth(found["travel"], out / "figures", "growth")
    figures.energy(found["energy"], out / "figures", "energy")
    deviation = [abs(row["deviation"]) for row in found["limits"]]
    worst = max(found["limits"], key=lambda row: abs(row["deviation"]))
    at_paper_step = {row["speed"]: row for row in found["travel"] if (row["scheme"], row["shape"], row["particles_per_cell"]) == ("musl", "linear", 1)
                     and abs(row["step_us"] - 0.2) < 1e-6}
    ranges = {}
    for shape in figures.shapes:
        of_shape = [row["measured"] for row in found["limits"] if row["scheme"] == "usf" and row["shape"] == shape]
        ranges[shape] = f"{min(of_shape):.2f} to {max(of_shape):.2f}" if of_shape else ""
    usl = [row["measured"] for row in found["limits"] if row["scheme"] == "usl" and row["shape"] == "linear"]
    made = {(row["scheme"], row["setting"]): row for row in found["energy"]}
    failed = [row for row in found["extremes"] if row["status"] == "failed"]
    finest = min(key[1] for key in made if key[0] == "musl")
    values = {
        "full": not quick, "energy_end": f"{1e6 * energy.scene['time']['end']:g}", "finest": f"{1e6 * finest:g}", "crossed": travel.travel,
        "limit_count": len(deviation), "limit_median": number(100 * float(np.median(deviation)), 2),
        "limit_within": sum(value <= 0.01 for value in deviation), "limit_worst": number(100 * worst["deviation"], 2),
        "limit_worst_where": f"{figures.names[worst['scheme']]}, {worst['shape']}, {worst['particles_per_cell']} per cell, offset {worst['offset']:g}",
        "limits": _limit_table(found["limits"]), "travel": _travel_table(found["travel"]), "growth": _growth_table(found["travel"]),
        "growth_theory": number(at_paper_step[min(at_paper_step, key=lambda v: abs(v - 200.0))]["theory"], 3),
        "growth_measured": number(at_paper_step[min(at_paper_step, key=lambda v: abs(v - 200.0))]["measured"], 3),
        "tolerated": number(100 * (tolerated - 1.0)), "energy": _energy_table(found["energy"]), "extremes": _extreme_table(found["extremes"]),
        **{f"range_{shape}": text for shape, text in ranges.items()}, "range_usl": f"{min(usl):.2f} to {max(usl):.2f}",
        "made_usf": number(100 * made["usf", 2e-7]["made"], 2), "made_musl": number(100 * made["musl", 2e-7]["made"], 2),
        "grown_musl": number(100 * (made["musl", 2e-7]["max_growth"] - 1.0), 2),
        "made_resolved": number(100 * max(abs(row["made"]) for key, row in made.items() if key[0] in ("usf", "musl") and key[1] <= 5e-8), 2),
        "usl_completed": sum(row["status"] == "complete" for key, row in made.items() if key[0] == "usl"),
        "extreme_count": len(found["extremes"]), "extreme_failed": len(failed), "extreme_long": sum(row["status"] == "too-long" for row in found["extremes"]),
    }
    return values


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
