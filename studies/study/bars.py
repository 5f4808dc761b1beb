"""Error bars: what refinements and rounding move a quantity by, and what that means."""
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from study.file import Quantity, bars as kinds


@dataclass
class Bars:
    """Of one quantity at one point; `relative`: kind -> bar over the quantity's scale, None where it was not measured."""
    quantity: Quantity
    value: float | None
    scale: float
    relative: dict
    efforts: dict = field(default_factory=dict)  # effort -> (kind, what it moves, seconds more)
    members: list = field(default_factory=list)
    finer: list = field(default_factory=list)
    undecided: bool = False  # the value is there in some runs only

    @property
    def largest(self):
        """The kind of the largest bar; chaos, where the others are no more than two members may differ by, twice its bar: a pair of runs cannot tell them apart."""
        known = {kind: bar * (2.0 if kind == "chaos" else 1.0) for kind, bar in self.relative.items() if bar is not None}
        return max(known, key=known.__getitem__) if known else None

    @cached_property
    def probability(self):
        """That two ensembles as different as these come of one distribution (two-sample Kolmogorov-Smirnov); None: not asked."""
        if len(self.members) < 2 or len(self.finer) < 2:
            return None
        from scipy.stats import ks_2samp
        return float(ks_2samp(self.members, self.finer).pvalue)


def _half_range(values):
    """Half the distance of 5 and 95 % of the values."""
    return float(np.subtract(*np.quantile(values, [0.95, 0.05]))) / 2.0


def bars_at(study, quantity, base, point=None):
    """Error bars of a quantity around the run `base`."""
    here = study.value(base, quantity)
    bars = Bars(quantity, here, study.scale(base, quantity), {})
    for name in study.there("refined", point=point):
        case = study.cases[name]
        moved = study.difference(name, base, quantity)
        bars.undecided |= (study.value(name, quantity) is None) != (here is None)
        if moved is None:
            continue
        bars.relative[case["kind"]] = max(moved, bars.relative.get(case["kind"]) or 0.0)
        # What is no dearer than the run itself, but for the noise of clocks, counts as a hundredth of it.
        bars.efforts[case["effort"]] = (case["kind"], moved, max(study.seconds(name) - study.seconds(base), 0.01 * study.seconds(base), 1e-6))
    for names, values in ((study.there("member", point=point, finer=None), bars.members), (study.there("member", point=point, finer="finer"), bars.finer)):
        found = [study.value(name, quantity) for name in names]
        values.extend(each for each in found if each is not None)
        bars.undecided |= 0 < len(values) < len(names)
    if len(bars.members) > 1:
        bars.relative["chaos"] = _half_range(bars.members) / bars.scale
    return bars


def verdict(bars, converged):
    """What the bars mean, in words; `converged`: of the quantity's scale, what does not matter."""
    if bars.undecided:
        return "undecided: some runs have it, some have not"
    if bars.value is None:
        return "absent"
    if bars.largest is None:
        return "not measured"
    if max(bar for bar in bars.relative.values() if bar is not None) <= converged:
        return "converged"
    return {"time": "needs a tolerance", "local": "needs a tolerance", "space": "needs cells", "chaos": "chaotic"}[bars.largest]


def best_effort(bars):
    """What moves the largest bar most per second, in words."""
    kind = bars.largest
    if kind is None or bars.relative[kind] == 0.0:
        return ""
    if kind == "chaos":
        return f"more members: of {len(bars.members)} the mean is known to ±{100.0 * bars.relative[kind] / len(bars.members) ** 0.5:.2g} %"
    rates = {effort: moved / seconds for effort, (of, moved, seconds) in bars.efforts.items() if of == kind}
    effort = max(rates, key=rates.__getitem__)
    _, moved, seconds = bars.efforts[effort]
    return f"{effort}: moves it by {100.0 * moved:.2g} % for {seconds:.2g} s more"


def best_of_all(every, converged):
    """Which effort takes most off the largest bars of all quantities together, per second, in words; None: no refinement would."""
    efforts: dict[str, tuple[float, float]] = {}  # effort -> what it moves, of all scales together, and its seconds
    for bars in every:
        if bars.largest in (None, "chaos") or bars.relative[bars.largest] <= converged:
            continue
        for effort, (kind, moved, seconds) in bars.efforts.items():
            if kind == bars.largest:
                efforts[effort] = efforts.get(effort, (0.0,))[0] + moved, seconds
    if not efforts:
        return None
    best = max(efforts, key=lambda effort: efforts[effort][0] / efforts[effort][1])
    moved, seconds = efforts[best]
    return (f"{best[0].upper()}{best[1:]} takes most off the largest bars for its time: {100.0 * moved:.2g} % of the quantities' scales together, for {seconds:.2g} s more a run.")


def bar_rows(study):
    """(bars, row of the table) of each quantity of the scene as it is; bars in the quantity's unit."""
    base = study.named("base")[0]
    for quantity in study.quantities:
        bars = bars_at(study, quantity, base)
        yield bars, {"quantity": quantity.name, "unit": quantity.unit, "value": bars.value, "scale": bars.scale,
                     **{kind: None if bars.relative.get(kind) is None else bars.relative[kind] * bars.scale for kind in kinds},
                     "verdict": verdict(bars, study.plan["converged"]), "largest": bars.largest, "effort": best_effort(bars),
                     "mean": float(np.mean(bars.members)) if bars.members else None, "same_distribution": bars.probability}
