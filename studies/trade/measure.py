"""Work and errors of every run, measured against the reference solutions."""
import statistics

import h5py
import numpy as np
from study.outcome import run as compute

from trade.problems import case, error, failure, ladders, names, problems, quantities, shapes

long_run = 3.0  # s: such runs are timed once
repeats = 3


def ladder_jobs(quick):
    """Name -> (problem, shape, methods)."""
    return {f"{problem.key}-{shape}-{family}": (problem, shape, methods) for problem in problems.values() for shape in shapes(problem, quick)
            for family, methods in ladders(problem, shape, quick).items()}


def references(quick):
    return {f"reference-{problem.key}-{shape}": (problem, shape) for problem in problems.values() for shape in shapes(problem, quick)}


def tight_cases(problem, shape, quick):
    """Two references, and the tight run of the implicit methods where there is one. The run to failure is watched on its way."""
    # Outputs end steps; at multiples of half a microsecond the cylinder's particles would lie on nodes.
    every = 0.917e-6 if problem is failure else None
    found = [case(problem, shape, f"tight-{n}", settings, quick, every, longest=600.0) for n, settings in enumerate(problem.tight)]
    if problem.own_tight:
        found.append(case(problem, shape, "tight-implicit", problem.own_tight, quick, longest=600.0))
    return found


def method_case(problem, shape, method, repeat, quick):
    return case(problem, shape, f"{method.name}-{repeat}", method.settings, quick)


def timed(problem, shape, method, quick, out, wanted=repeats):
    """Outcomes of a method's repeats, as many as wanted; long runs have one."""
    first = compute(method_case(problem, shape, method, 0, quick), out / "runs")
    more = 0 if quick or first.record["seconds"] > long_run else wanted - 1
    return [first, *[compute(method_case(problem, shape, method, n + 1, quick), out / "runs") for n in range(more)]]


def _row(problem, shape, method, reference, own, quick, out):
    outcomes = timed(problem, shape, method, quick, out)
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
    row |= {quantity: error(quantity, found[quantity], reference[quantity], problem) for quantity in names(problem)}
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


def measure(quick, out):
    """Rows by problem, floors by problem: (shape, quantity) -> distance of both references, divergence by shape."""
    rows, floors, apart = {}, {}, {}
    for problem, shape in references(quick).values():
        tight = [compute(each, out / "runs") for each in tight_cases(problem, shape, quick)]
        both = [quantities(problem, outcome) if outcome.complete else dict.fromkeys(names(problem)) for outcome in tight[:2]]
        floors.setdefault(problem.key, {}).update({(shape, quantity): error(quantity, both[1][quantity], both[0][quantity], problem) for quantity in names(problem)})
        own = quantities(problem, tight[2]) if len(tight) > 2 and tight[2].complete else None
        if problem is failure:
            apart[shape] = _divergence(tight)
        for owner, of_shape, methods in ladder_jobs(quick).values():
            if (owner, of_shape) == (problem, shape):
                rows.setdefault(problem.key, []).extend(_row(problem, shape, method, both[0], own, quick, out) for method in methods)
    return rows, floors, apart
