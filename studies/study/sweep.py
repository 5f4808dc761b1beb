"""Quantities over what varies: at each point, and of each method's ensembles there."""
import numpy as np

from study.bars import bars_at
from study.results import work


def _point(study, number):
    """The varied values of a point, as cells of a table."""
    values = study.plan["points"][number] if number is not None else {}
    return {key: (each if isinstance(each, (int, float, str)) else str(each)) for key, each in values.items()}


def label(study, number):
    """A point in words; empty: the scene as it is."""
    return ", ".join(f"{key.split('.')[-1]} {value}" for key, value in _point(study, number).items())


def sweep_rows(study):
    """A row for each point: what it cost, the quantities, and the sum of their error bars (root of squares) where these were asked for."""
    for name in study.named_any("point"):
        number = study.cases[name]["point"]
        row = {**_point(study, number), **work(study, name)}
        for quantity in study.quantities:
            row[quantity.name] = study.value(name, quantity)
            if study.plan["sweep_bars"]:
                bars = bars_at(study, quantity, name, number)
                known = list(bars.relative.values())
                row[f"± {quantity.name}"] = float(np.hypot.reduce(known)) * bars.scale if known else None
        yield row


def distribution(values):
    """Of members of an ensemble, None where one predicts nothing: number, median, 5 and 95 %, a 95 % confidence interval of the median (bootstrap), mean and
    standard deviation.

    >>> distribution([1.0, None, 3.0])["median"], distribution([None])
    (2.0, {'n': 0})
    """
    known = np.array([each for each in values if each is not None], float)
    if not known.size:
        return {"n": 0}
    draws = np.random.default_rng(1).choice(known, (2000, known.size))
    low, high = np.quantile(np.median(draws, axis=1), [0.025, 0.975])
    return {"n": known.size, "median": float(np.median(known)), "p05": float(np.quantile(known, 0.05)), "p95": float(np.quantile(known, 0.95)),
            "median_low": float(low), "median_high": float(high), "mean": float(known.mean()), "std": float(known.std(ddof=1)) if known.size > 1 else 0.0}


def method_rows(study):
    """A row for each point, method, rung and quantity: what its members say."""
    groups: dict[tuple, list[str]] = {}
    for name in study.named_any("rung"):
        case = study.cases[name]
        groups.setdefault((case.get("point"), case["method"], case["rung"]), []).append(name)
    for (point, method, _), names in groups.items():
        status = sorted({study.status(name) for name in names})
        for quantity in study.quantities:
            yield {**_point(study, point), "method": method, "setting": study.cases[names[0]]["setting"], "members": len(names), "status": ", ".join(status),
                   "quantity": quantity.name, "unit": quantity.unit, **distribution([study.value(name, quantity) for name in names])}
