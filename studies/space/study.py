"""What the discretisation in space decides of the reference case, and which measures converge."""
import sys

from study.command import main
from study.outcome import run as compute
from study.tables import markdown, number, write_csv

from space import figures
from space.cases import all_settings, asked, base, cells, cells_of, end, ensemble, quick_end
from space.measures import convergence, of_run, quantities, statistics

name = "space"


def _ensembles(quick):
    """Job -> cases."""
    return {f"{setting.name}-{cell}": ensemble(setting, cell, quick) for setting in all_settings(quick).values() for cell in cells_of(setting, quick)}


def jobs(quick):
    return list(_ensembles(quick))


def cases(quick):
    return [each for group in _ensembles(quick).values() for each in group]


def run(job, quick, out):
    for each in _ensembles(quick)[job]:
        compute(each, out / "runs")


def _measure(quick, out):
    """(setting, cell) -> rows of the members, and the number of those that failed."""
    return {(setting.name, cell): [of_run(compute(each, out / "runs")) for each in ensemble(setting, cell, quick)]
            for setting in all_settings(quick).values() for cell in cells_of(setting, quick)}


def _cell_text(key, stats):
    if not stats["n"]:
        return "–"
    scale = quantities[key][2]
    middle, least, most = (number(scale * stats[which]) for which in ("median", "least", "most"))
    return middle if least == most else f"{middle} ({least} … {most})"


def _ratio(found, key, setting, cell):
    """Of the medians of a setting and the base; None where either lacks it."""
    if (setting, cell) not in found:
        return None
    one, other = found[setting, cell][key]["median"], found[base.name, cell][key]["median"]
    return one / other if one and other else None


def report(quick, out):
    members = _measure(quick, out)
    found = {place: {key: statistics([row[key] for row in rows]) for key in quantities} for place, rows in members.items()}
    write_csv(out / "tables" / "members.csv", ["setting", "cell", "member", *quantities],
              [{"setting": setting, "cell": cell, "member": n, **row} for (setting, cell), rows in members.items() for n, row in enumerate(rows, 1)])
    orders = []
    for setting in all_settings(quick).values():
        for key in quantities:
            stats = [found[setting.name, cell][key] for cell in cells_of(setting, quick)]
            order, limit, verdict = convergence(stats)
            orders.append({"setting": setting.name, "measure": key, "order": order, "limit": limit, "verdict": verdict})
    write_csv(out / "tables" / "convergence.csv", list(orders[0]), orders)
    for key, (title, settings) in asked(quick).items():
        figures.group(title[0].upper() + title[1:], settings, found, out / "figures", key)
    return _page_values(members, found, orders, quick)


def _page_values(members, found, orders, quick):
    tables = []
    for title, settings in asked(quick).values():
        rows = [[setting.label, cell, *[_cell_text(key, found[setting.name, cell][key]) for key in quantities]] for setting in settings for cell in cells_of(setting, quick)]
        tables.append(f"### {title[0].upper() + title[1:]}\n\n" + markdown(
            [title, "cell (mm)", *[f"{label} ({unit})" if unit else label for label, unit, _ in quantities.values()]], rows))
    verdicts = [[all_settings(quick)[row["setting"]].label if row["setting"] != base.name else base.label, quantities[row["measure"]][0], row["verdict"], row["order"],
                 None if row["limit"] is None else quantities[row["measure"]][2] * row["limit"]] for row in orders if row["verdict"] != "–"]
    four = {key: _ratio(found, key, "per-cell-4", "1") for key in ("crack_area", "localised_volume", "localised_particles", "fracture")}
    return {
        "runs": sum(len(rows) for rows in members.values()), "until": number(1e6 * (quick_end if quick else end)), "cells": "1 mm" if quick else "1, 0.5 and 0.25 mm",
        "failed": sum(row["fracture"] is None for rows in members.values() for row in rows), "full": not quick,
        "verdicts": markdown(["setting", "measure", "over the cells", "order", "limit"], verdicts) if verdicts else "",
        "tables": "\n\n".join(tables), "area_ratio": number(four["crack_area"]), "volume_ratio": number(four["localised_volume"]),
        "particle_ratio": number(four["localised_particles"]), "energy_ratio": number(four["fracture"]),
        "pictures": "\n\n".join(f"![{title[0].upper() + title[1:]}](figures/{key}.png)" for key, (title, _) in asked(quick).items()),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
