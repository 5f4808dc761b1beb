"""What an accuracy costs: errors of each rung of each ladder, and the cheapest setting that meets one."""
import functools

from study.results import work

levels = (0.1, 0.01, 0.001)
field_of_velocity = "velocity field"  # RMS over all particles


def cheapest(ladders, error, level):
    """The row of least `seconds` whose `error` (a key) is at most `level`, as are those of all tighter rows of its ladder: no lucky hits. None: there is none.
    `ladders`: lists of rows, from loose to tight; an error of None meets nothing.

    >>> musl = [{"error": 1e-4, "seconds": 1}, {"error": 5e-2, "seconds": 2}, {"error": 5e-3, "seconds": 4}]
    >>> cheapest([musl], "error", 1e-2)["seconds"]
    4
    """
    def holds(row):
        return row.get(error) is not None and row[error] <= level

    met = [row for rows in ladders for n, row in enumerate(rows) if all(holds(each) for each in rows[n:])]
    return min(met, key=lambda row: row["seconds"], default=None)


def trade_rows(study):
    """A row for each rung of each ladder and each quantity: its error against the first reference of its point, how far both references are apart, and the error
    against the tight run of its own method where there is one."""
    measured: list[tuple] = [(quantity.name, functools.partial(study.difference, quantity=quantity), functools.partial(study.value, quantity=quantity)) for quantity in study.quantities]
    measured.append((field_of_velocity, study.field_difference, lambda name: None))
    units = {quantity.name: quantity.unit for quantity in study.quantities}
    for name in study.named_any("ladder"):
        case, cost = study.cases[name], work(study, name)
        first, second = study.named("reference", point=case.get("point"))
        tight = study.named("tight", point=case.get("point"), method=case["method"])
        for quantity, difference, own in measured:
            # A rung that is the first reference is measured against the second: that it agrees with itself says nothing.
            against = second if case["run"] == study.cases[first]["run"] else first
            yield {"point": case.get("point"), "method": case["method"], "setting": case["setting"], "rung": case["rung"], "tightness": case.get("tightness"), **cost,
                   "quantity": quantity, "unit": units.get(quantity, ""), "value": own(name), "reference": own(against), "error": difference(name, against), "references_apart": difference(second, first),
                   "own_error": difference(name, tight[0]) if tight else None}


def recommendations(rows):
    """For each point, quantity and level the cheapest rung that meets it and goes on meeting it in all tighter rungs of its ladder: no lucky hits."""
    for point, quantity in dict.fromkeys((row["point"], row["quantity"]) for row in rows):
        of = [row for row in rows if (row["point"], row["quantity"]) == (point, quantity)]
        for level in levels:
            apart = of[0]["references_apart"]
            base = {"point": point, "quantity": quantity, "level": level, "references_apart": apart}
            if apart is None or apart > level:
                yield base | {"advice": "undecidable: the references differ by more" if apart is not None else "undecidable: a reference has no value"}
                continue
            ladders: dict[str, list] = {}
            for row in sorted(of, key=lambda row: row["rung"]):
                ladders.setdefault(row["method"], []).append(row)
            best = cheapest(ladders.values(), "error", level)
            yield base | ({"advice": "none of the ladders"} if best is None else
                          {"advice": f"{best['method']}, {best['setting']}", "method": best["method"], "rung": best["rung"], "seconds": best["seconds"], "error": best["error"]})
