"""Work and precision of every method: what does an accuracy cost, and what is there to be had?"""
import sys

import numpy as np
from study.command import main
from study.outcome import run as compute
from study.tables import markdown, number, write_csv

from trade import figures
from trade.advice import describe, recommendations
from trade.measure import ladder_jobs, long_run, measure, method_case, references, repeats, tight_cases, timed
from trade.problems import failure_end, names, problems, shape_name, title

name = "trade"


def jobs(quick):
    return [*references(quick), *ladder_jobs(quick)]


def cases(quick):
    found = [method_case(problem, shape, method, 0, quick) for problem, shape, methods in ladder_jobs(quick).values() for method in methods]
    return found + [tight for problem, shape in references(quick).values() for tight in tight_cases(problem, shape, quick)]


def run(job, quick, out):
    if job in references(quick):
        for tight in tight_cases(*references(quick)[job], quick):
            compute(tight, out / "runs")
        return
    problem, shape, methods = ladder_jobs(quick)[job]
    # Repeats are apart in time, so that one disturbance does not meet all.
    for wanted in range(1, 2 if quick else repeats + 1):
        for method in methods:
            timed(problem, shape, method, quick, out, wanted)


def _order(rows, family, shape="linear", quantity="velocity"):
    """Slope of the error over the step between the two tightest settings."""
    points = sorted((row["tightness"], row[quantity]) for row in rows if row["family"] == family and row["shape"] == shape and row["local"] == "closed-form" and row.get(quantity))
    return float(np.log(points[1][1] / points[0][1]) / np.log(points[1][0] / points[0][0])) if len(points) > 1 else None


def report(quick, out):
    rows, floors, apart = measure(quick, out)
    every = [row for key in rows for row in rows[key]]
    for row in every:
        for quantity in ("seconds", "rhs", "own velocity", *names(problems[row["problem"]])):
            row.setdefault(quantity, None)
    columns = list(dict.fromkeys(key for row in every for key in row))
    write_csv(out / "tables" / "work-precision.csv", columns, every)
    write_csv(out / "tables" / "references.csv", ["problem", "shape", "quantity", "difference"],
              [{"problem": key, "shape": shape, "quantity": quantity, "difference": value} for key in floors for (shape, quantity), value in floors[key].items()])
    advice = recommendations(rows, floors, quick)
    write_csv(out / "tables" / "recommendations.csv", list(dict.fromkeys(key for row in advice for key in row)), advice)
    for key in ("impact", "onset"):
        figures.work_precision(rows[key], floors[key], lambda shape, key=key: shape_name(problems[key], shape), _heading(key, quick), out / "figures", f"work-precision-{key}")
    for key in ("onset", "failure"):
        figures.quantities(rows[key], floors[key], names(problems[key]), _heading(key, quick), out / "figures", f"quantities-{key}")
    figures.tolerance({"impact": rows["impact"], "onset": rows["onset"]}, out / "figures", "tolerance")
    figures.divergence({shape_name(problems["failure"], shape): series for shape, series in apart.items()}, out / "figures", "divergence")
    locals_ = [row for key in ("onset", "failure") for row in rows[key] if row["shape"] == "linear" and
               (row["local"] != "closed-form" or (row["family"], row["tightness"]) in (("musl", 5e-8), ("erk3", 1e-4)))]
    figures.local(locals_, out / "figures", "local")
    return _page_values(rows, floors, apart, advice, locals_, quick)


def _heading(key, quick):
    text = title(problems[key], quick)
    return text[0].upper() + text[1:]


def _when(time, values, level):
    above = np.nonzero(values > level)[0]
    return f"at {number(1e6 * time[above[0]])} µs" if above.size else "never"


def _page_values(rows, floors, apart, advice, locals_, quick):
    linear = {key: [row for row in rows[key] if row["shape"] == "linear"] for key in rows}
    time, velocity, kinetic = apart["linear"]
    fixed = [row for row in linear["impact"] if row["family"] in ("usf", "musl") and row["seconds"]]
    adaptive = [row for row in linear["impact"] if row["family"].startswith("erk") and row["seconds"]]
    table = markdown(["problem", "shape functions", "quantity", "references differ by"],
                     [[title(problems[key], quick), shape_name(problems[key], shape), quantity, number(value, 2)] for key in floors for (shape, quantity), value in floors[key].items()])
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
        "kinetic_most": number(100 * float(kinetic.max()), 2), "full": not quick, "failure_end": failure_end(quick),
        "timing": "one run each" if quick else f"median of {repeats} runs; those longer than {long_run:g} s are timed once",
        "local": markdown(["problem", "grid", "local equations", "s", "error of velocity", "error of the plate's kinetic energy", "error of the time of first localisation"],
                          [[title(problems[row["problem"]], quick), describe(row | {"local": "closed-form"}), row["local"], number(row["seconds"], 2), number(row["velocity"], 2),
                            number(row.get("kinetic energy of the plate"), 2), number(row.get("time of first localisation"), 2)] for row in locals_]),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
