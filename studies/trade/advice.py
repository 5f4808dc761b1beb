"""The cheapest setting for an accuracy."""
from study.ladders import cheapest, levels

from trade.figures import names as family_names
from trade.problems import fixed_steps


def _cheapest(rows, quantity, level, families=None):
    ladders: dict[tuple, list] = {}
    for row in sorted(rows, key=lambda row: -row["tightness"]):
        if row.get("seconds") and (not families or row["family"] in families) and row["local"] in ("closed-form", "substep 1e-06", "substep 0.0001"):
            ladders.setdefault((row["family"], row["local"], row["shape"]), []).append(row)
    return cheapest(ladders.values(), quantity, level)


def describe(row):
    if row is None:
        return "none"
    setting = f"{1e6 * row['tightness']:g} µs" if row["family"] in fixed_steps else f"rtol {row['tightness']:g}"
    return f"{family_names[row['family']]} {setting}" + ("" if row["local"] == "closed-form" else f", {row['local']}")


def recommendations(problems):
    """One row for each problem, quantity and level; linear shape functions."""
    found = []
    for problem in problems.values():
        linear = problem.linear()
        for quantity in problem.names:
            floor = problem.floors["linear", quantity]
            for level in levels:
                row = {"problem": problem.title, "quantity": quantity, "level": level, "references apart": floor}
                if floor is None or floor > level:
                    found.append(row | {"cheapest": "undecidable: the references differ by more"})
                    continue
                best, fixed = _cheapest(linear, quantity, level), _cheapest(linear, quantity, level, fixed_steps)
                found.append(row | {"cheapest": describe(best), "seconds": best and best["seconds"], "achieved": best and best[quantity],
                                    "cheapest fixed step": describe(fixed), "seconds of the fixed step": fixed and fixed["seconds"]})
    return found
