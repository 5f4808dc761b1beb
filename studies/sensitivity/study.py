"""Which predictions of failure are robust, which need a tolerance, which are chaotic?"""
import sys

import h5py
import numpy as np
from study.command import main
from study.outcome import run as compute
from study.tables import markdown, number, write_csv

from sensitivity import figures
from sensitivity.ensembles import all_ensembles, asked, base, case, end, fragmenting, quick_end, watched
from sensitivity.predictions import fragment_masses, of_run, quantities, size, statistics

name = "sensitivity"
small, large = 0.05, 0.2  # relative: what counts as little and as much


def jobs(quick):
    return [*all_ensembles(quick), *_watched_jobs(quick)]


def _watched_jobs(quick):
    return {f"watched-{n}": label for n, label in enumerate(watched(quick))}


def cases(quick):
    return [case(ensemble, member, quick) for ensemble in all_ensembles(quick).values() for member in range(1, ensemble.members + 1)] + \
        [each for group in watched(quick).values() for each in group]


def run(job, quick, out):
    if job in _watched_jobs(quick):
        for each in watched(quick)[_watched_jobs(quick)[job]]:
            compute(each, out / "runs")
        return
    ensemble = all_ensembles(quick)[job]
    for member in range(1, ensemble.members + 1):
        compute(case(ensemble, member, quick), out / "runs")


def _spread(group, out):
    """Times (s) and RMS distance of velocities of each other member from the first (of 200 m/s)."""
    fields = []
    for each in group:
        with h5py.File(compute(each, out / "runs").folder / "result.h5") as result:
            steps = [result["steps"][key] for key in sorted(result["steps"])]
            time = np.array([step.attrs["time"] for step in steps])
            fields.append(np.array([step["particles/velocity"][()] for step in steps]))
    return time, np.array([np.sqrt(np.mean((field - fields[0]) ** 2, axis=(1, 2))) for field in fields[1:]]) / 200.0


def _measure(quick, out):
    outcomes = {key: [compute(case(ensemble, member, quick), out / "runs") for member in range(1, ensemble.members + 1)]
                for key, ensemble in all_ensembles(quick).items()}
    members = {key: [of_run(outcome) for outcome in group] for key, group in outcomes.items()}
    found = {key: {quantity: statistics([row[quantity] for row in rows]) for quantity in quantities} for key, rows in members.items()}
    return outcomes, members, found


def _shift(key, names, found):
    """Largest distance between medians of the ensembles, over the prediction's size; None when fewer than two predict it."""
    medians = [found[each][key]["median"] for each in names if each in found and found[each][key]["n"]]
    return (max(medians) - min(medians)) / size(key, found[base.name][key]) if len(medians) > 1 else None


def _scatter(key, found):
    stats = found[base.name][key]
    return (stats["p95"] - stats["p05"]) / size(key, stats) if stats["n"] else None


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


def _robustness(found, quick):
    groups = {question: [ensemble.name for ensemble in ensembles] for question, (_, ensembles) in asked(quick).items()}
    resolved = ["base", "musl-0.025", "musl-0.0125", "erk-1e-2", "erk-1e-3", "erk-1e-4"]
    for key in quantities:
        stats, scatter = found[base.name][key], _scatter(key, found)
        coarse = _shift(key, groups.get("step", []) + groups.get("tolerance", []), found)
        row = {"prediction": quantities[key][0], "unit": quantities[key][1], "scatter": scatter, "resolved": _shift(key, resolved, found), "steps and tolerances": coarse}
        scale = quantities[key][2]
        row |= {which: scale * stats[which] if stats["n"] else None for which in ("median", "p05", "p95")}
        row |= {question: _shift(key, names, found) for question, names in groups.items()}
        yield row | {"verdict": verdict(scatter, coarse, row["resolved"])}


def report(quick, out):
    outcomes, members, found = _measure(quick, out)
    write_csv(out / "tables" / "members.csv", ["ensemble", "member", "status", *quantities],
              [{"ensemble": key, "member": n, "status": outcome.status, **row} for key in members for n, (outcome, row) in enumerate(zip(outcomes[key], members[key]), 1)])
    stats_rows = [{"ensemble": key, "quantity": quantity, "members": len(members[key]), **found[key][quantity]} for key in found for quantity in quantities]
    write_csv(out / "tables" / "ensembles.csv", ["ensemble", "quantity", "members", "n", "median", "p05", "p95", "median_low", "median_high", "mean", "std"], stats_rows)
    rows = list(_robustness(found, quick))
    write_csv(out / "tables" / "robustness.csv", list(rows[0]), rows)
    limits = figures.scales(found)
    for key, (title, ensembles) in asked(quick).items():
        figures.question(title, ensembles, members, found, base.name, limits, out / "figures", key)
    figures.fragment_masses({label: [(fragment_masses(outcome), row["separated_mass"]) for outcome, row in zip(outcomes[key], members[key]) if outcome.complete]
                             for label, key in fragmenting.items() if key in outcomes}, out / "figures", "fragments")
    spreads = {label: _spread(group, out) for label, group in watched(quick).items()}
    write_csv(out / "tables" / "spread.csv", ["run", "time", "median", "least", "most"],
              [{"run": label, "time": t, "median": float(np.median(column)), "least": float(column.min()), "most": float(column.max())}
               for label, (time, distance) in spreads.items() for t, column in zip(time, distance.T)])
    figures.spread(spreads, out / "figures", "spread")
    return _page_values(rows, outcomes, found, spreads, quick)


def _of_space(rows):
    """What the discretisation in space shifts, as far as it was asked."""
    def shift(prediction):
        found = next(row for row in rows if row["prediction"] == quantities[prediction][0]).get("cell")
        return None if found is None else number(100 * found, 2)

    more = sum(max(row.get(question) or 0.0 for question in ("particles", "shape", "cell")) > (row["resolved"] or 0.0) + (row["scatter"] or 0.0) for row in rows)
    return {"space_more": more, "predictions": len(rows), "cell_mass": shift("separated_mass"), "cell_radius": shift("outermost_radius"),
            "cell_cylinder": shift("cylinder_velocity"), "cell_perforated": shift("perforated")}


def _when(time, values, level):
    above = np.nonzero(values > level)[0]
    return f"{number(1e6 * time[above[0]])} µs" if above.size else "never"


def _page_values(rows, outcomes, found, spreads, quick):
    def percent(value):
        return None if value is None else number(100 * value, 2)

    groups = list(asked(quick))
    robust = [[row["prediction"], f"{number(row['median'], 3)} ({number(row['p05'], 3)} … {number(row['p95'], 3)}) {row['unit']}", percent(row["scatter"]), percent(row["resolved"]),
               *[percent(row[question]) for question in groups], f"**{row['verdict']}**"] for row in rows]
    everyone = []
    for key, ensemble in all_ensembles(quick).items():
        cells = [f"{number(quantities[q][2] * found[key][q]['median'], 3)} ({number(quantities[q][2] * found[key][q]['p05'], 3)} … {number(quantities[q][2] * found[key][q]['p95'], 3)})"
                 if found[key][q]["n"] else "–" for q in quantities]
        everyone.append([key, ensemble.members, sum(not outcome.complete for outcome in outcomes[key]), *cells])
    apart = [[label, *[_when(time, np.median(distance, axis=0), level) for level in (1e-9, 1e-6, 1e-3, 1e-2)], number(float(np.median(distance[:, -1])), 2)]
             for label, (time, distance) in spreads.items()]
    return {
        "robustness": markdown(["prediction", "base: median (5 … 95 %)", "scatter (%)", "shift, resolved steps and tolerances (%)", *[f"shift by {question} (%)" for question in groups], "verdict"], robust),
        "ensembles": markdown(["ensemble", "members", "failed", *[f"{label} ({unit})" if unit else label for label, unit, _ in quantities.values()]], everyone),
        "members": max(ensemble.members for ensemble in all_ensembles(quick).values()), "until": number(1e6 * (quick_end if quick else end)), "full": not quick,
        **_of_space(rows),
        "runs": number(sum(len(group) for group in outcomes.values())), "failed": sum(not outcome.complete for group in outcomes.values() for outcome in group),
        "apart": markdown(["run", "1e-9 at", "1e-6 at", "1e-3 at", "1e-2 at", "in the end"], apart),
        "robust_list": ", ".join(row["prediction"] for row in rows if row["verdict"].startswith("robust")) or "none",
        "tolerance_list": ", ".join(row["prediction"] for row in rows if row["verdict"].startswith("needs")) or "none",
        "chaotic_list": ", ".join(row["prediction"] for row in rows if row["verdict"].startswith("chaotic")) or "none",
        "questions": "\n\n".join(f"![{title[0].upper() + title[1:]}](figures/{key}.png)" for key, (title, _) in asked(quick).items()),
        "small": number(100 * small), "large": number(100 * large),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
