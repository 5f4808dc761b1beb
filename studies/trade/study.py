"""Work and precision of every method: what does an accuracy cost, and what is there to be had?"""
import statistics
import sys

import h5py
import numpy as np
from study.command import main
from study.outcome import run as compute
from study.tables import markdown, number, write_csv

from trade import figures
from trade.problems import case, error, failure, ladders, names, problems, quantities, shapes

name = "trade"
levels = (0.1, 0.01, 0.001)
long_run = 3.0  # s: such runs are timed once
repeats = 3


def _jobs(quick):
    """Name -> (problem, shape, family, methods); the references come first, as jobs of their own."""
    return {f"{problem.key}-{shape}-{family}": (problem, shape, methods) for problem in problems.values() for shape in shapes(problem, quick)
            for family, methods in ladders(problem, shape, quick).items()}


def _references(quick):
    return {f"reference-{problem.key}-{shape}": (problem, shape) for problem in problems.values() for shape in shapes(problem, quick)}


def jobs(quick):
    return [*_references(quick), *_jobs(quick)]


def _tight_cases(problem, shape, quick):
    """Two references, and the tight run of the implicit methods where there is one. The run to failure is watched on its way."""
    # Outputs end steps; at multiples of half a microsecond the cylinder's particles would lie on nodes.
    every = 0.917e-6 if problem is failure else None
    found = [case(problem, shape, f"tight-{n}", settings, quick, every, longest=600.0) for n, settings in enumerate(problem.tight)]
    if problem.own_tight:
        found.append(case(problem, shape, "tight-implicit", problem.own_tight, quick, longest=600.0))
    return found


def cases(quick):
    found = [case(problem, shape, method.name, method.settings, quick) for problem, shape, methods in _jobs(quick).values() for method in methods]
    return found + [tight for problem, shape in _references(quick).values() for tight in _tight_cases(problem, shape, quick)]


def run(job, quick, out):
    if job in _references(quick):
        for tight in _tight_cases(*_references(quick)[job], quick):
            compute(tight, out / "runs")
        return
    problem, shape, methods = _jobs(quick)[job]
    # Repeats are apart in time, so that one disturbance does not meet all.
    for repeat in range(1 if quick else repeats):
        for method in methods:
            first = out / "runs" / f"{problem.key}-{shape}" / f"{method.name}-0"
            if repeat and compute(case(problem, shape, first.name, method.settings, quick), out / "runs").record["seconds"] > long_run:
                continue
            compute(case(problem, shape, f"{method.name}-{repeat}", method.settings, quick), out / "runs")


def _outcome(problem, shape, run_name, settings, quick, out, **more):
    return compute(case(problem, shape, run_name, settings, quick, **more), out / "runs")


def _row(problem, shape, method, references, own, quick, out):
    outcomes = []
    for repeat in range(1 if quick else repeats):
        if repeat and outcomes[0].record["seconds"] > long_run:
            break
        outcomes.append(_outcome(problem, shape, f"{method.name}-{repeat}", method.settings, quick, out))
    first = outcomes[0]
    row = {"problem": problem.key, "shape": shape, "family": method.family, "tightness": method.tightness, "local": method.local, "status": first.status}
    if first.summary is None or not first.complete:
        return row
    seconds = [outcome.summary["wall_seconds"] for outcome in outcomes]
    integrator = first.summary["integrator"]
    found = quantities(problem, first)
    row |= {"seconds": statistics.median(seconds), "seconds_min": min(seconds), "seconds_max": max(seconds), "repeats": len(seconds),
            "steps": integrator["steps"], "rejected": integrator["rejected"], "rhs": integrator["rhs_evaluations"] or integrator["steps"],
            "factorisations": integrator["factorisations"], "made": -(first.summary["energy"]["relative_residual"] or 0.0),
            "estimate": (integrator["error_estimate"] or {}).get("velocity")}
    row |= {quantity: error(quantity, found[quantity], references[quantity], problem) for quantity in names(problem)}
    if own is not None and method.family.startswith("dirk"):
        row["own velocity"] = error("velocity", found["velocity"], own["velocity"], problem)
    return row


def _divergence(tight):
    """Times (s), RMS difference of velocities (of 200 m/s) and relative difference of kinetic energy of two runs with the same outputs."""
    with h5py.File(tight[0].folder / "result.h5") as a, h5py.File(tight[1].folder / "result.h5") as b:
        count = min(len(a["steps"]), len(b["steps"]))
        time = np.array([a["steps"][f"{n:05}"].attrs["time"] for n in range(count)])
        velocity = [np.sqrt(np.mean((a["steps"][f"{n:05}"]["particles/velocity"][()] - b["steps"][f"{n:05}"]["particles/velocity"][()]) ** 2)) for n in range(count)]
        kinetic = np.abs(a["series/kinetic"][:count] / b["series/kinetic"][:count] - 1.0)
    return time, np.array(velocity) / 200.0, kinetic


def _measure(quick, out):
    """Rows by problem, floors by problem: (shape, quantity) -> distance of both references, divergence by shape."""
    rows, floors, apart = {}, {}, {}
    for problem, shape in _references(quick).values():
        tight = [compute(each, out / "runs") for each in _tight_cases(problem, shape, quick)]
        both = [quantities(problem, outcome) if outcome.complete else dict.fromkeys(names(problem)) for outcome in tight[:2]]
        floors.setdefault(problem.key, {}).update({(shape, quantity): error(quantity, both[1][quantity], both[0][quantity], problem) for quantity in names(problem)})
        own = quantities(problem, tight[2]) if len(tight) > 2 and tight[2].complete else None
        if problem is failure:
            apart[shape] = _divergence(tight)
        for owner, of_shape, methods in _jobs(quick).values():
            if (owner, of_shape) == (problem, shape):
                rows.setdefault(problem.key, []).extend(_row(problem, shape, method, both[0], own, quick, out) for method in methods)
    return rows, floors, apart


def _holds(row, family_rows, quantity, level):
    """The level is met by the row and by all tighter settings of its family: no lucky hits."""
    return all(other[quantity] is not None and other[quantity] <= level for other in family_rows if other["tightness"] <= row["tightness"])


def _cheapest(rows, quantity, level, families=None):
    best = None
    for row in rows:
        if row.get(quantity) is None or (families and row["family"] not in families) or row["local"] not in ("closed-form", "substep 1e-06", "substep 0.0001"):
            continue
        same = [other for other in rows if (other["family"], other["local"]) == (row["family"], row["local"]) and other["shape"] == row["shape"]
                and other.get("seconds")]
        if _holds(row, same, quantity, level) and (best is None or row["seconds"] < best["seconds"]):
            best = row
    return best


def describe(row):
    if row is None:
        return "none"
    setting = f"{1e6 * row['tightness']:g} µs" if row["family"] in ("usf", "usl", "musl") else f"rtol {row['tightness']:g}"
    return f"{figures.names[row['family']]} {setting}" + ("" if row["local"] == "closed-form" else f", {row['local']}")


def recommendations(rows, floors):
    """One row for each problem, quantity and level; linear shape functions."""
    found = []
    for key, problem in problems.items():
        linear = [row for row in rows.get(key, []) if row["shape"] == "linear"]
        for quantity in names(problem) if linear else []:
            floor = floors[key]["linear", quantity]
            for level in levels:
                row = {"problem": problem.title, "quantity": quantity, "level": level, "references apart": floor}
                if floor is None or floor > level:
                    found.append(row | {"cheapest": "undecidable: the references differ by more"})
                    continue
                best, fixed = _cheapest(linear, quantity, level), _cheapest(linear, quantity, level, ("usf", "usl", "musl"))
                found.append(row | {"cheapest": describe(best), "seconds": best and best["seconds"], "achieved": best and best[quantity],
                                    "cheapest fixed step": describe(fixed), "seconds of the fixed step": fixed and fixed["seconds"]})
    return found


def _order(rows, family, shape="linear", quantity="velocity"):
    """Slope of the error over the step between the two tightest settings."""
    points = sorted((row["tightness"], row[quantity]) for row in rows if row["family"] == family and row["shape"] == shape and row["local"] == "closed-form" and row.get(quantity))
    return float(np.log(points[1][1] / points[0][1]) / np.log(points[1][0] / points[0][0])) if len(points) > 1 else None


def report(quick, out):
    rows, floors, apart = _measure(quick, out)
    every = [row for key in rows for row in rows[key]]
    for row in every:
        for quantity in ("seconds", "rhs", "own velocity", *names(problems[row["problem"]])):
            row.setdefault(quantity, None)
    columns = list(dict.fromkeys(key for row in every for key in row))
    write_csv(out / "tables" / "work-precision.csv", columns, every)
    write_csv(out / "tables" / "references.csv", ["problem", "shape", "quantity", "difference"],
              [{"problem": key, "shape": shape, "quantity": quantity, "difference": value} for key in floors for (shape, quantity), value in floors[key].items()])
    advice = recommendations(rows, floors)
    write_csv(out / "tables" / "recommendations.csv", list(dict.fromkeys(key for row in advice for key in row)), advice)
    for key in ("impact", "onset"):
        figures.work_precision(rows[key], floors[key], problems[key].title.capitalize(), out / "figures", f"work-precision-{key}")
    for key in ("onset", "failure"):
        figures.quantities(rows[key], floors[key], names(problems[key]), problems[key].title.capitalize(), out / "figures", f"quantities-{key}")
    figures.tolerance({"impact": rows["impact"], "onset": rows["onset"]}, out / "figures", "tolerance")
    figures.divergence(apart, out / "figures", "divergence")
    locals_ = [row for key in ("onset", "failure") for row in rows[key] if row["shape"] == "linear" and
               (row["local"] != "closed-form" or (row["family"], row["tightness"]) in (("musl", 5e-8), ("erk3", 1e-4)))]
    figures.local(locals_, out / "figures", "local")
    published = ["work-precision-impact", "work-precision-onset", "quantities-onset", "quantities-failure", "tolerance", "divergence", "local"]
    return _page_values(rows, floors, apart, advice, locals_, quick), published


def _when(time, values, level):
    above = np.nonzero(values > level)[0]
    return f"{1e6 * time[above[0]]:.3g} µs" if above.size else "never"


def _page_values(rows, floors, apart, advice, locals_, quick):
    linear = {key: [row for row in rows[key] if row["shape"] == "linear"] for key in rows}
    time, velocity, kinetic = apart["linear"]
    fixed = [row for row in linear["impact"] if row["family"] in ("usf", "musl") and row["seconds"]]
    adaptive = [row for row in linear["impact"] if row["family"].startswith("erk") and row["seconds"]]
    table = markdown(["problem", "shape functions", "quantity", "references differ by"],
                     [[problems[key].title, shape, quantity, number(value, 2)] for key in floors for (shape, quantity), value in floors[key].items()])
    return {
        "recommendations": markdown(["problem", "quantity", "error", "cheapest", "s", "achieved", "cheapest fixed step", "s", "references apart"],
                                    [[row["problem"], row["quantity"], f"{100 * row['level']:g} %", row["cheapest"], number(row.get("seconds"), 2), number(row.get("achieved"), 2),
                                      row.get("cheapest fixed step") or "–", number(row.get("seconds of the fixed step"), 2), number(row["references apart"], 2)] for row in advice]),
        "references": table,
        "order_usf": number(_order(rows["impact"], "usf"), 3), "order_musl": number(_order(rows["impact"], "musl"), 3),
        "impact_floor": number(floors["impact"]["linear", "velocity"], 2), "onset_floor": number(floors["onset"]["linear", "velocity"], 2),
        "failure_floor": number(floors["failure"]["linear", "velocity"], 2),
        "failure_cylinder": number(100 * floors["failure"]["linear", "velocity of the cylinder"], 2),
        "best_fixed": describe(min(fixed, key=lambda row: row["velocity"])), "best_fixed_error": number(min(row["velocity"] for row in fixed), 2),
        "best_fixed_seconds": number(min(fixed, key=lambda row: row["velocity"])["seconds"], 2),
        "best_adaptive": describe(min(adaptive, key=lambda row: row["velocity"])), "best_adaptive_error": number(min(row["velocity"] for row in adaptive), 2),
        "best_adaptive_seconds": number(min(adaptive, key=lambda row: row["velocity"])["seconds"], 2),
        "apart_1e6": _when(time, velocity, 1e-6), "apart_1e3": _when(time, velocity, 1e-3), "apart_1e2": _when(time, velocity, 1e-2),
        "kinetic_most": number(100 * float(kinetic.max()), 2), "repeats": 1 if quick else repeats,
        "local": markdown(["problem", "grid", "local equations", "s", "error of velocity", "error of the plate's kinetic energy", "error of the time of first localisation"],
                          [[problems[row["problem"]].title, describe(row | {"local": "closed-form"}), row["local"], number(row["seconds"], 2), number(row["velocity"], 2),
                            number(row.get("kinetic energy of the plate"), 2), number(row.get("time of first localisation"), 2)] for row in locals_]),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
