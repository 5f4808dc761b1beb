"""Work and precision of every method: what does an accuracy cost, and what is there to be had?"""
import sys

import numpy as np
from study.command import main
from study.files import cases, jobs, long_run, run  # noqa: F401
from study.ladders import levels
from study.tables import markdown, number, write_csv

from trade import figures
from trade.advice import describe, recommendations
from trade.problems import read

name = "trade"


def _order(rows, family, shape="linear", quantity="velocity"):
    """Slope of the error over the step between the two tightest settings."""
    points = sorted((row["tightness"], row[quantity]) for row in rows if row["family"] == family and row["shape"] == shape and row["local"] == "closed-form" and row.get(quantity))
    return float(np.log(points[1][1] / points[0][1]) / np.log(points[1][0] / points[0][0])) if len(points) > 1 else None


def report(quick, out):
    problems = read(out)
    every = [row for problem in problems.values() for row in problem.rows]
    write_csv(out / "tables" / "work-precision.csv", list(dict.fromkeys(key for row in every for key in row)), every)
    write_csv(out / "tables" / "references.csv", ["problem", "shape", "quantity", "difference"],
              [{"problem": key, "shape": shape, "quantity": quantity, "difference": value} for key, problem in problems.items() for (shape, quantity), value in problem.floors.items()])
    advice = recommendations(problems)
    write_csv(out / "tables" / "recommendations.csv", list(dict.fromkeys(key for row in advice for key in row)), advice)
    for key in ("impact", "onset"):
        figures.work_precision(problems[key], out / "figures", f"work-precision-{key}")
    for key in ("onset", "failure"):
        figures.quantities(problems[key], out / "figures", f"quantities-{key}")
    figures.tolerance([problems["impact"], problems["onset"]], out / "figures", "tolerance")
    apart = {shape: _divergence(problems["failure"], shape) for shape in problems["failure"].shapes}
    figures.divergence({problems["failure"].named(shape): series for shape, series in apart.items()}, out / "figures", "divergence")
    locals_ = [row for key in ("onset", "failure") for row in problems[key].linear() if row["local"] != "closed-form" or (row["family"], row["tightness"]) in (("musl", 5e-8), ("erk3", 1e-4))]
    figures.local(problems, locals_, out / "figures", "local")
    return _page_values(problems, apart["linear"], advice, locals_, quick)


def _divergence(problem, shape):
    """Times (s), RMS difference of velocities (of the impact's) and relative difference of kinetic energy of both references."""
    names = problem.references(shape)
    time, velocity = problem.study.drift(*names)
    one, two = (problem.study.outcome(each).series("kinetic")[:len(time)] for each in names)
    return time, velocity, np.abs(one / two - 1.0)


def _of_implicit(problem):
    """The least error of velocity of the implicit ladders, against the reference of their own and against that of the particle system."""
    rows = [row for row in problem.linear() if row["family"].startswith("dirk")]
    least = {kind: min((row[key] for row in rows if row.get(key) is not None), default=None) for kind, key in (("own", "own velocity"), ("apart", "velocity"))}
    return {f"implicit_{kind}_{problem.key}": number(value, 2) for kind, value in least.items()}


def _onset(problem):
    """Whose first localisation it is, and when, by the first reference."""
    first = problem.study.outcome(problem.references("linear")[0]).summary["failure"]["first_localisation"]
    return {"onset_body": first["body"], "onset_time": number(1e6 * first["time"])}


def _when(time, values, level):
    above = np.nonzero(values > level)[0]
    return f"at {number(1e6 * time[above[0]])} µs" if above.size else "never"


def _by_problem(problems, section):
    """What `section` says of each problem, under its title."""
    return "\n\n".join(f"### {problem.title[0].upper() + problem.title[1:]}\n\n{section(problem)}" for problem in problems.values())


def _percent(error):
    return "–" if error is None else f"{number(100 * error, 2)} %"


def _advice_section(problem, advice):
    """A table of what can be decided, and a list of what cannot."""
    decided: list[list[str]] = []
    undecided: dict[str, list[str]] = {}
    for row in advice:
        if row["problem"] != problem.title:
            continue
        error = f"{100 * row['level']:g} %"
        if "achieved" in row:
            decided.append([row["quantity"], error, row["cheapest"], number(row["seconds"], 2), _percent(row["achieved"]), row["cheapest fixed step"],
                            number(row["seconds of the fixed step"], 2)])
        else:
            undecided.setdefault(row["quantity"], []).append(error)
    parts = [markdown(["quantity", "error", "cheapest", "s", "achieved", "cheapest fixed step", "s"], decided)] if decided else []
    if undecided:
        parts.append("No single run decides these, for the [references differ by more](#how-far-the-references-agree):\n\n" +
                     "\n".join(f"- {quantity}: {', '.join(errors)}" for quantity, errors in undecided.items()))
    return "\n\n".join(parts)


def _references_section(problem):
    return markdown(["references differ by", *map(problem.named, problem.shapes)],
                    [[quantity, *(number(problem.floors.get((shape, quantity)), 2) for shape in problem.shapes)] for quantity in problem.names])


def _local_section(problem, rows):
    measured = [quantity for quantity in problem.names if quantity in ("velocity", "kinetic energy of the plate", "time of first localisation")]
    return markdown(["grid", "local equations", "s", *(f"error: {quantity}" for quantity in measured)],
                    [[describe(row | {"local": "closed-form"}), row["local"], number(row["seconds"], 2), *(number(row[quantity], 2) for quantity in measured)]
                     for row in rows if row["problem"] == problem.key])


def _page_values(problems, apart, advice, locals_, quick):
    time, velocity, kinetic = apart
    smooth = [row for row in problems["impact"].linear() if row["seconds"]]
    fixed = min((row for row in smooth if row["family"] in ("usf", "musl")), key=lambda row: row["velocity"])
    adaptive = min((row for row in smooth if row["family"].startswith("erk")), key=lambda row: row["velocity"])
    floors = {key: problem.floors for key, problem in problems.items()}
    return {
        "recommendations": _by_problem(problems, lambda problem: _advice_section(problem, advice)),
        "references": _by_problem(problems, _references_section),
        "local": _by_problem({key: problems[key] for key in ("onset", "failure")}, lambda problem: _local_section(problem, locals_)),
        "cheapest_smooth": next(row["cheapest"] for row in advice if (row["problem"], row["quantity"], row["level"]) == (problems["impact"].title, "velocity", min(levels))),
        **_onset(problems["onset"]), **_of_implicit(problems["impact"]), **_of_implicit(problems["onset"]),
        "order_usf": number(_order(problems["impact"].rows, "usf"), 3), "order_musl": number(_order(problems["impact"].rows, "musl"), 3),
        "impact_floor": number(floors["impact"]["linear", "velocity"], 2), "onset_floor": number(floors["onset"]["linear", "velocity"], 2),
        "failure_floor": number(floors["failure"]["linear", "velocity"], 2),
        "failure_cylinder": number(100 * floors["failure"]["linear", "velocity of the cylinder"], 2),
        "best_fixed": describe(fixed), "best_fixed_error": number(fixed["velocity"], 2), "best_fixed_seconds": number(fixed["seconds"], 2),
        "best_adaptive": describe(adaptive), "best_adaptive_error": number(adaptive["velocity"], 2), "best_adaptive_seconds": number(adaptive["seconds"], 2),
        "apart_1e6": _when(time, velocity, 1e-6), "apart_1e3": _when(time, velocity, 1e-3), "apart_1e2": _when(time, velocity, 1e-2),
        "kinetic_most": number(100 * float(kinetic.max()), 2), "full": not quick, "failure_end": f"{1e6 * problems['failure'].study.scene['time']['end']:g}",
        "timing": "one run each" if quick else f"median of {problems['impact'].study.plan['repeats']} runs; those longer than {long_run:g} s are timed once",
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
