"""Which predictions of failure are robust, which need a tolerance, which are chaotic?"""
import sys

import numpy as np
from study.command import main
from study.files import cases, jobs, run  # noqa: F401
from study.results import Study
from study.sweep import distribution
from study.tables import markdown, number, write_csv

from sensitivity import figures
from sensitivity.ensembles import base, by_name, fragmenting, questions, resolved
from sensitivity.predictions import fragment_masses, of_ensemble, quantities, sizes

name = "sensitivity"
small, large = 0.05, 0.2  # relative: what counts as little and as much


def _spread(study, ensemble):
    """Times (s) and RMS distance of velocities of each other member from the first (of the impact's)."""
    drifts = [study.drift(ensemble.cases[0], other) for other in ensemble.cases[1:]]
    reached = min(len(time) for time, _ in drifts)
    return drifts[0][0][:reached], np.array([apart[:reached] for _, apart in drifts])


def _shift(key, size, names, found):
    """Largest distance between medians of the ensembles, over the prediction's size; None when fewer than two predict it."""
    medians = [found[each][key]["median"] for each in names if each in found and found[each][key]["n"]]
    return (max(medians) - min(medians)) / size if len(medians) > 1 else None


def _scatter(stats, size):
    return (stats["p95"] - stats["p05"]) / size if stats["n"] else None


def verdict(scatter, coarse, resolved):
    """`scatter` of members; shifts of medians over all steps and tolerances, and over the resolved ones."""
    if scatter is None:
        return "undecided"
    if scatter > large:
        return "chaotic: ensembles only"
    if resolved is not None and resolved > max(small, scatter):
        return "needs a tolerance, not converged"
    if coarse is not None and coarse > max(small, scatter):
        return "needs a tolerance"
    return "robust" if scatter <= small else f"robust to {number(100 * scatter, 2)} %"


def _robustness(found, asked, measured_by):
    groups = {question: [ensemble.name for ensemble in ensembles] for question, (_, ensembles) in asked.items()}
    for key, size in measured_by.items():
        stats, scatter = found[base][key], _scatter(found[base][key], size)
        coarse = _shift(key, size, groups.get("step", []) + groups.get("tolerance", []), found)
        row = {"prediction": quantities[key][0], "unit": quantities[key][1], "scatter": scatter, "resolved": _shift(key, size, resolved, found), "steps and tolerances": coarse}
        scale = quantities[key][2]
        row |= {which: scale * stats[which] if stats["n"] else None for which in ("median", "p05", "p95")}
        row |= {question: _shift(key, size, names, found) for question, names in groups.items()}
        yield row | {"verdict": verdict(scatter, coarse, row["resolved"])}


def report(quick, out):
    study, watched = Study(out, "ensembles"), Study(out, "watched")
    asked = questions(study.plan)
    ensembles = by_name(asked)
    members = {key: of_ensemble(study, ensemble) for key, ensemble in ensembles.items()}
    found = {key: {quantity: distribution([row[quantity] for row in rows]) for quantity in quantities} for key, rows in members.items()}
    write_csv(out / "tables" / "members.csv", ["ensemble", "member", "status", *quantities],
              [{"ensemble": key, "member": n, "status": study.status(case), **row} for key in members for n, (case, row) in enumerate(zip(ensembles[key].cases, members[key]), 1)])
    write_csv(out / "tables" / "ensembles.csv", ["ensemble", "quantity", "members", "n", "median", "p05", "p95", "median_low", "median_high", "mean", "std"],
              [{"ensemble": key, "quantity": quantity, "members": len(members[key]), **found[key][quantity]} for key in found for quantity in quantities])
    rows = list(_robustness(found, asked, sizes(study, found[base])))
    write_csv(out / "tables" / "robustness.csv", list(rows[0]), rows)
    limits = figures.scales(found)
    for key, (title, of) in asked.items():
        figures.question(title, of, members, found, base, limits, out / "figures", key)
    figures.fragment_masses({label: [(fragment_masses(study.outcome(case)), row["separated_mass"]) for case, row in zip(ensembles[key].cases, members[key]) if study.summary(case)]
                             for label, key in fragmenting.items() if key in ensembles}, out / "figures", "fragments")
    spreads = {ensemble.label: _spread(watched, ensemble) for _, of in questions(watched.plan).values() for ensemble in of}
    write_csv(out / "tables" / "spread.csv", ["run", "time", "median", "least", "most"],
              [{"run": label, "time": t, "median": float(np.median(column)), "least": float(column.min()), "most": float(column.max())}
               for label, (time, distance) in spreads.items() for t, column in zip(time, distance.T)])
    figures.spread(spreads, out / "figures", "spread")
    return _page_values(study, asked, rows, found, spreads, quick)


def _of_space(rows):
    """What the discretisation in space shifts, as far as it was asked."""
    def shift(prediction):
        found = next(row for row in rows if row["prediction"] == quantities[prediction][0]).get("cell")
        return None if found is None else number(100 * found, 2)

    more = sum(max(row.get(question) or 0.0 for question in ("particles", "shape", "cell")) > (row["resolved"] or 0.0) + (row["scatter"] or 0.0) for row in rows)
    return {"space_more": more, "predictions": len(rows), "cell_mass": shift("separated_mass"), "cell_radius": shift("outermost_radius"),
            "cell_cylinder": shift("cylinder_velocity"), "cell_perforated": shift("perforated")}


def _of_phases(asked, found):
    """Range of the medians of the energy made, over the lengths of the implicit method's phases."""
    medians = [100.0 * found[ensemble.name]["made"]["median"] for ensemble in asked.get("remap", (None, []))[1] if found[ensemble.name]["made"]["n"]]
    return {"remap_made": f"{number(min(medians), 2)} and {number(max(medians), 2)}" if medians else ""}


def _when(time, values, level):
    above = np.nonzero(values > level)[0]
    return f"{number(1e6 * time[above[0]])} µs" if above.size else "never"


def _page_values(study, asked, rows, found, spreads, quick):
    def percent(value):
        return None if value is None else number(100 * value, 2)

    groups, ensembles = list(asked), by_name(asked)
    failed = {key: sum(study.summary(case) is None for case in ensemble.cases) for key, ensemble in ensembles.items()}
    robust = [[row["prediction"], f"{number(row['median'], 3)} ({number(row['p05'], 3)} … {number(row['p95'], 3)}) {row['unit']}", percent(row["scatter"]), percent(row["resolved"]),
               *[percent(row[question]) for question in groups], f"**{row['verdict']}**"] for row in rows]
    everyone = []
    for key, ensemble in ensembles.items():
        cells = [f"{number(quantities[q][2] * found[key][q]['median'], 3)} ({number(quantities[q][2] * found[key][q]['p05'], 3)} … {number(quantities[q][2] * found[key][q]['p95'], 3)})"
                 if found[key][q]["n"] else "–" for q in quantities]
        everyone.append([key, len(ensemble.cases), failed[key], *cells])
    apart = [[label, *[_when(time, np.median(distance, axis=0), level) for level in (1e-9, 1e-6, 1e-3, 1e-2)], number(float(np.median(distance[:, -1])), 2)]
             for label, (time, distance) in spreads.items()]
    return {
        "robustness": markdown(["prediction", "base: median (5 … 95 %)", "scatter (%)", "shift, resolved steps and tolerances (%)", *[f"shift by {question} (%)" for question in groups], "verdict"], robust),
        "ensembles": markdown(["ensemble", "members", "failed", *[f"{label} ({unit})" if unit else label for label, unit, _ in quantities.values()]], everyone),
        "members": max(len(ensemble.cases) for ensemble in ensembles.values()), "until": number(1e6 * study.scene["time"]["end"]), "full": not quick,
        **_of_space(rows), **_of_phases(asked, found),
        "runs": number(sum(len(ensemble.cases) for ensemble in ensembles.values())), "failed": sum(failed.values()),
        "apart": markdown(["run", "1e-9 at", "1e-6 at", "1e-3 at", "1e-2 at", "in the end"], apart),
        "robust_list": ", ".join(row["prediction"] for row in rows if row["verdict"].startswith("robust")) or "none",
        "tolerance_list": ", ".join(row["prediction"] for row in rows if row["verdict"].startswith("needs")) or "none",
        "chaotic_list": ", ".join(row["prediction"] for row in rows if row["verdict"].startswith("chaotic")) or "none",
        "questions": "\n\n".join(f"![{title[0].upper() + title[1:]}](figures/{key}.png)" for key, (title, _) in asked.items()),
        "small": number(100 * small), "large": number(100 * large),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
