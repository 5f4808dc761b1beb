"""What the discretisation in space decides of the reference case, and which measures converge."""
import sys

from study.command import main
from study.outcome import run as compute
from study.page import paper_title
from study.tables import markdown, number, write_csv

from space import figures
from space.cases import all_settings, asked, base, cells_of, end, ensemble, fixed, fixed_four, four, paper, paper_four, quick_end, shipped, shipped_ensemble
from space.measures import convergence, of_run, of_shipped, quantities, shipped_quantities, signed, statistics, tables

name = "space"


def _ensembles(quick):
    """Job -> cases."""
    of_reference = {f"{setting.name}-{cell}": ensemble(setting, cell, quick) for setting in all_settings(quick).values() for cell in cells_of(setting, quick)}
    of_shipped_scenes = {f"{scene.name}-{part}-{count}": shipped_ensemble(scene, part, count) for scene in shipped for part, count in scene.members if not quick}
    return of_reference | of_shipped_scenes


def jobs(quick):
    return list(_ensembles(quick))


def cases(quick):
    return [each for group in _ensembles(quick).values() for each in group]


def run(job, quick, out):
    for each in _ensembles(quick)[job]:
        compute(each, out / "runs")


def _measure(quick, out):
    """(setting, cell) -> rows of the members, and the number of those that failed."""
    return {(setting.name, cell): [of_run(compute(each, out / "runs"), quick_end if quick else end) for each in ensemble(setting, cell, quick)]
            for setting in all_settings(quick).values() for cell in cells_of(setting, quick)}


def _measure_shipped(out):
    """(scene, cell in mm, particles a cell) -> rows of the members."""
    return {(scene.name, *scene.place(*place)): [of_shipped(compute(each, out / "runs")) for each in shipped_ensemble(scene, *place)] for scene in shipped for place in scene.members}


def _cell_text(key, stats):
    if not stats["n"]:
        return "–"
    scale = quantities[key][2]
    middle, least, most = (number(scale * stats[which]) for which in ("median", "least", "most"))
    return middle if least == most else f"{middle} ({least} … {most})"


def _head(key):
    label, unit, _ = quantities[key]
    return f"{label} ({unit})" if unit else label


def _ratio(found, key, of, to):
    """Of the medians at two places, (setting, cell); None where either lacks the measure."""
    one, other = (found[place][key]["median"] if place in found else None for place in (of, to))
    return one / other if one and other else None


def report(quick, out):
    members = _measure(quick, out)
    found = {place: {key: statistics([row[key] for row in rows]) for key in quantities} for place, rows in members.items()}
    write_csv(out / "tables" / "members.csv", ["setting", "cell", "member", *quantities],
              [{"setting": setting, "cell": cell, "member": n, **row} for (setting, cell), rows in members.items() for n, row in enumerate(rows, 1)])
    orders = []
    for setting in all_settings(quick).values():
        for key in quantities:
            order, limit, verdict = convergence([found[setting.name, cell][key] for cell in cells_of(setting, quick)], key in signed)
            orders.append({"setting": setting.name, "measure": key, "order": order, "limit": limit, "verdict": verdict})
    write_csv(out / "tables" / "convergence.csv", list(orders[0]), orders)
    for key, (title, settings) in asked(quick).items():
        figures.group(title[0].upper() + title[1:], settings, found, out / "figures", key)
    shipped_members = {} if quick else _measure_shipped(out)
    if shipped_members:
        write_csv(out / "tables" / "shipped.csv", ["scene", "cell", "particles_per_cell", "member", *shipped_quantities],
                  [{"scene": scene, "cell": cell, "particles_per_cell": count, "member": n, **row} for (scene, cell, count), rows in shipped_members.items() for n, row in enumerate(rows, 1)])
    return _page_values(members, found, orders, shipped_members, quick)


def _shipped_table(shipped_members):
    rows = []
    for (scene, cell, count), of_members in shipped_members.items():
        stats = {key: statistics([row[key] for row in of_members]) for key in shipped_quantities}
        rows.append([f"`{scene}.toml`", cell, count, *[_cell_text(key, stats[key]) for key in shipped_quantities]])
    return markdown(["scene", "cell (mm)", "particles a cell", *map(_head, shipped_quantities)], rows) if rows else ""


def _converging(orders, setting):
    """What is said of the measures of a setting over its cells; nothing where there are too few cells."""
    judged = {quantities[row["measure"]][0]: row["verdict"] for row in orders if row["setting"] == setting.name and row["verdict"] != "–"}
    if not judged:
        return "One cell alone says nothing of convergence"
    settled = [f"{name} ({verdict})" for name, verdict in judged.items() if verdict != "no limit seen"]
    return f"Over the cells {len(judged) - len(settled)} of {len(judged)} measures show no limit ({setting.label}). The others: {'; '.join(settled) or 'none'}"


def _group(title, settings, found, quick):
    """The medians of every measure, a table for each part of them."""
    name = title[0].upper() + title[1:]
    places = [(setting, cell) for setting in settings for cell in cells_of(setting, quick)]
    parts = [f"{part[0].upper() + part[1:]}:\n\n" + markdown([title, "cell (mm)", *map(_head, keys)], [[setting.label, cell, *[_cell_text(key, found[setting.name, cell][key]) for key in keys]]
                                                                                   for setting, cell in places]) for part, keys in tables.items()]
    return f"### {name}\n\n" + "\n\n".join(parts)


def _verdict(row):
    if row["limit"] is None:
        return row["verdict"]
    order = "" if row["order"] is None else f", order {number(row['order'], 2)}"
    return f"{row['verdict']}: {number(quantities[row['measure']][2] * row['limit'])}{order}"


def _verdicts(orders, labels):
    """A row for each measure, a column for each setting that has cells enough."""
    judged = {(row["setting"], row["measure"]): row for row in orders if row["verdict"] != "–"}
    settings = list(dict.fromkeys(setting for setting, _ in judged))
    return markdown(["measure", *(labels[setting] for setting in settings)],
                    [[_head(key), *(_verdict(judged[setting, key]) if (setting, key) in judged else "–" for setting in settings)] for key in quantities]) if judged else ""


def _page_values(members, found, orders, shipped_members, quick):
    labels = {setting.name: setting.label for setting in reversed(all_settings(quick).values())} | {base.name: base.label, four.name: "4 a cell"}
    ratios = {"particle": ("localised_particles", four, base, "1"), "volume": ("localised_volume", four, base, "1"), "area": ("crack_area", four, base, "1"),
              "energy": ("fracture", four, base, "1")}
    if not quick:
        ratios |= {"early": ("early_area", four, base, "1"), "inner": ("inner_area", four, base, "1"), "lower": ("lower_area", four, base, "1"), "strength": ("strength", four, base, "1"), "paper_area": ("crack_area", paper_four, paper, "1"),
                   "fixed_area": ("crack_area", fixed_four, fixed, "1"), "fine_area": ("crack_area", four, base, "0.5")}
    values = {f"{name}_ratio": number(_ratio(found, key, (of.name, cell), (to.name, cell))) for name, (key, of, to, cell) in ratios.items()}
    across = {"spacing_area": ("crack_area", (four, "1"), (base, "0.5")), "spacing_energy": ("fracture", (four, "1"), (base, "0.5")), "halved_area": ("crack_area", (base, "0.5"), (base, "1")),
              "fixed_halved_area": ("crack_area", (fixed, "0.5"), (fixed, "1")), "fixed_four_halved_area": ("crack_area", (fixed_four, "0.5"), (fixed_four, "1")), "halved_inner": ("inner_area", (base, "0.5"), (base, "1")), "quartered_area": ("crack_area", (base, "0.25"), (base, "0.5")), "four_halved_area": ("crack_area", (four, "0.5"), (four, "1")), "finest_area": ("crack_area", (base, "0.25"), (four, "0.5"))}
    for name, (key, of, to) in across.items():
        values[f"{name}_ratio"] = number(_ratio(found, key, (of[0].name, of[1]), (to[0].name, to[1])))
    values |= dict.fromkeys((f"{name}_ratio" for name in ("early", "inner", "lower", "strength", "paper_area", "fixed_area", "fine_area") if quick), "")
    rows = [row for each in (members, shipped_members) for of_place in each.values() for row in of_place]
    return values | {
        "converging": _converging(orders, base), "runs": len(rows), "until": number(1e6 * (quick_end if quick else end)), "cells": "1 mm" if quick else "1, 0.5 and 0.25 mm",
        "failed": sum(row["residual"] is None for row in rows), "full": not quick, "paper": paper_title, "shipped": _shipped_table(shipped_members),
        "verdicts": _verdicts(orders, labels), "tables": "\n\n".join(_group(*each, found, quick) for each in asked(quick).values()),
        "first_single": _cell_text("first_time", found["single", "1"]["first_time"]), "first_bodies": _cell_text("first_time", found[base.name, "1"]["first_time"]),
        "pictures": "\n\n".join(f"![{title[0].upper() + title[1:]}: six measures of failure over the size of cells](figures/{key}.png)" for key, (title, _) in asked(quick).items()),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
