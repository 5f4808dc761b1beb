"""The cheapest setting for an accuracy."""
from study.advice import cheapest

from trade.figures import names as family_names
from trade.problems import names, problems, title

levels = (0.1, 0.01, 0.001)
fixed_steps = ("usf", "usl", "musl")


def _cheapest(rows, quantity, level, families=None):
    ladders = {}
    for row in sorted(rows, key=lambda row: -row["tightness"]):
        if row.get("seconds") and (not families or row["family"] in families) and row["local"] in ("closed-form", "substep 1e-06", "substep 0.0001"):
            ladders.setdefault((row["family"], row["local"], row["shape"]), []).append(row)
    return cheapest(ladders.values(), quantity, level)


def describe(row):
    if row is None:
        return "none"
    setting = f"{1e6 * row['tightness']:g} µs" if row["family"] in fixed_steps else f"rtol {row['tightness']:g}"
    return f"{family_names[row['family']]} {setting}" + ("" if row["local"] == "closed-form" else f", {row['local']}")


def recommendations(rows, floors, quick):
    """One row for each problem, quantity and level; linear shape functions."""
    found = []
    for key, problem in problems.items():
        linear = [row for row in rows.get(key, []) if row["shape"] == "linear"]
        for quantity in names(problem) if linear else []:
            floor = floors[key]["linear", quantity]
            for level in levels:
                row = {"problem": title(problem, quick), "quantity": quantity, "level": level, "references apart": floor}
                if floor is None or floor > level:
                    found.append(row | {"cheapest": "undecidable: the references differ by more"})
                    continue
                best, fixed = _cheapest(linear, quantity, level), _cheapest(linear, quantity, level, fixed_steps)
                found.append(row | {"cheapest": describe(best), "seconds": best and best["seconds"], "achieved": best and best[quantity],
                                    "cheapest fixed step": describe(fixed), "seconds of the fixed step": fixed and fixed["seconds"]})
    return found
