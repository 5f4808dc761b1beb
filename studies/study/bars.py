"""Error bars: what refinements and rounding move a quantity by, and what that means."""
import textwrap
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from study.file import Quantity, bars as kinds

confidence = 0.95


@dataclass(frozen=True)
class Effort:
    """A run with one thing refined. `kind`: of error that it shows; `moved`: distance from the run as it is, over the scale; `seconds`: how much longer it took."""
    kind: str
    value: float
    moved: float
    seconds: float


@dataclass
class Bars:
    """Of one quantity at one point. `efforts`: name -> Effort; `members`: of the ensemble around the run as it is, `finer`: around the one that is finer in time;
    `failures`: runs that did not come to their end, in words; `undecided`: the value is there in some runs only."""
    quantity: Quantity
    value: float | None
    scale: float
    efforts: dict = field(default_factory=dict)
    members: list = field(default_factory=list)
    finer: list = field(default_factory=list)
    failures: list = field(default_factory=list)
    undecided: bool = False

    @cached_property
    def relative(self):
        """Kind -> bar over the scale: the most that an effort moves, and half the range of the members. A kind that was not measured is absent."""
        return self._largest_of(self.efforts.values())

    @cached_property
    def noise(self):
        """(centre, bound): of what lies farther from the centre chance is no explanation; no ensemble: nothing is. The run as it is counts as a member. Standard
        deviation s of both ensembles of n and m, about their own means; a single run more is off by s sqrt(1 + 1/n); bound of 95 % by Student's t, shared by all efforts (Bonferroni)."""
        from scipy.stats import t
        ensemble = [self.value, *self.members]
        free = len(ensemble) - 1 + max(len(self.finer) - 1, 0)
        if not self.members or not self.efforts:
            return self.value, 0.0
        squares = sum(np.sum((np.array(each) - np.mean(each)) ** 2) for each in (ensemble, self.finer) if each)
        bound = t.ppf(1.0 - (1.0 - confidence) / (2.0 * len(self.efforts)), free)
        return float(np.mean(ensemble)), float(bound * np.sqrt(squares / free * (1.0 + 1.0 / len(ensemble))))

    @cached_property
    def shown(self):
        """Efforts that move the quantity by more than chance explains."""
        centre, bound = self.noise if self.efforts else (0.0, 0.0)
        return {name: effort for name, effort in self.efforts.items() if abs(effort.value - centre) > bound or bound == 0.0}

    @cached_property
    def beyond_chance(self):
        """As `relative`, of the efforts that are shown."""
        return self._largest_of(self.shown.values())

    def _largest_of(self, efforts):
        found: dict[str, float] = {}
        for effort in efforts:
            found[effort.kind] = max(effort.moved, found.get(effort.kind, 0.0))
        if len(self.members) > 1:
            found["chaos"] = _half_range(self.members) / self.scale
        return found

    @property
    def largest(self):
        """The kind of the largest bar, of those that chance does not explain, and of chaos."""
        return max(self.beyond_chance, key=self.beyond_chance.__getitem__, default=None)

    @cached_property
    def probability(self):
        """That two ensembles as different as these come of one distribution (two-sample Kolmogorov-Smirnov); None: not asked."""
        return _same(self.members, self.finer) if min(len(self.members), len(self.finer)) > 1 else None

    @property
    def least_probability(self):
        """The least that so many members can say, however far apart."""
        return _same(range(len(self.members)), range(len(self.members), len(self.members) + len(self.finer)))


def _same(one, two):
    from scipy.stats import ks_2samp
    return float(ks_2samp(one, two).pvalue)


def _half_range(values):
    """Half the distance of 5 and 95 % of the values."""
    return float(np.subtract(*np.quantile(values, [0.95, 0.05]))) / 2.0


def _failed(study, name, what):
    """What became of a run that did not come to its end, in words; None: it did."""
    status = study.status(name)
    if status == "complete":
        return None
    return f"{what} {'took too long' if status == 'too-long' else 'failed'}: {textwrap.shorten(study.message(name), 100, placeholder=' ...')}"


def bars_at(study, quantity, base, point=None):
    """Error bars of a quantity around the run `base`."""
    here = study.value(base, quantity)
    bars = Bars(quantity, here, study.scale(base, quantity))
    failed = [_failed(study, base, "the run itself")]
    for name in study.there("refined", point=point):
        case, moved = study.cases[name], study.difference(name, base, quantity)
        failed.append(_failed(study, name, case["effort"]))
        if study.summary(name) is not None:
            bars.undecided |= (study.value(name, quantity) is None) != (here is None)
        if moved is not None:
            # What is no dearer than the run itself, but for the noise of clocks, counts as a hundredth of it.
            seconds = max(study.seconds(name) - study.seconds(base), 0.01 * study.seconds(base), 1e-6)
            bars.efforts[case["effort"]] = Effort(case["kind"], study.value(name, quantity), moved, seconds)
    for names, values, what in ((study.there("member", point=point, finer=None), bars.members, "members"), (study.there("member", point=point, finer="finer"), bars.finer, "finer members")):
        ended = [name for name in names if study.summary(name) is not None]
        values.extend(found for name in ended if (found := study.value(name, quantity)) is not None)
        bars.undecided |= 0 < len(values) < len(ended)
        stopped = [name for name in names if name not in ended]
        failed += [_failed(study, stopped[0], f"{len(stopped)} of {len(names)} {what}")] if stopped else []
    bars.failures = [each for each in failed if each]
    return bars


def verdict(bars, converged):
    """What the bars mean, in words; `converged`: of the quantity's scale, what does not matter."""
    if bars.failures:
        return bars.failures[0] + (f" (and {len(bars.failures) - 1} more)" if len(bars.failures) > 1 else "")
    if bars.undecided:
        return "undecided: some runs have it, some have not"
    if bars.value is None:
        return "absent"
    if bars.largest is None:
        return "not measured"
    if bars.beyond_chance[bars.largest] <= converged:
        return "converged"
    return {"time": "needs a tolerance", "local": "needs a tolerance", "space": "needs cells", "chaos": "chaotic"}[bars.largest]


def best_effort(bars):
    """What moves the largest bar most per second, in words."""
    kind = bars.largest
    if kind is None or bars.beyond_chance[kind] == 0.0:
        return ""
    if kind == "chaos":
        return f"more members: of {len(bars.members)} the mean is known to ±{100.0 * bars.relative[kind] / len(bars.members) ** 0.5:.2g} %"
    name, effort = max(((name, effort) for name, effort in bars.shown.items() if effort.kind == kind), key=lambda each: each[1].moved / each[1].seconds)
    return f"{name}: moves it by {100.0 * effort.moved:.2g} % for {effort.seconds:.2g} s more"


def best_of_all(every, converged):
    """Which effort takes most off the largest bars of all quantities together, per second, in words; None: no refinement would. What chance explains is no effort's doing."""
    efforts: dict[str, tuple[float, float]] = {}  # effort -> what it moves, of all scales together, and its seconds
    for bars in every:
        if bars.failures or bars.undecided or bars.largest in (None, "chaos") or bars.beyond_chance[bars.largest] <= converged:
            continue
        for name, effort in bars.shown.items():
            if effort.kind == bars.largest:
                efforts[name] = efforts.get(name, (0.0,))[0] + effort.moved, effort.seconds
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
                     "chance": bars.noise[1] if bars.members and bars.efforts else None,
                     "mean": float(np.mean(bars.members)) if bars.members else None, "same_distribution": bars.probability}
