"""What the runs of a study say: values, errors against references, error bars and what they mean."""
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from study.advice import cheapest
from study.outcome import run as compute

from own import plan as plans
from own.file import Quantity
from own.quantities import of_every_scene, of_run, scales, speed_of, value

levels = (0.1, 0.01, 0.001)
field_of_velocity = "velocity field"  # RMS over all particles


class Study:
    """A plan and the runs that it asked for."""

    def __init__(self, out):
        self.out, self.plan = out, plans.load(out)
        self.cases = self.plan["cases"]
        self.scene = self.plan["resolved"]
        self._outcomes, self._values = {}, {}

    def outcome(self, name):
        if name not in self._outcomes:
            self._outcomes[name] = compute(plans.case(self.plan, name), self.out / "runs")
        return self._outcomes[name]

    def named(self, role, **facts):
        """Names of the cases of this role and these facts; None: the fact is absent."""
        return [name for name, case in self.cases.items() if case["role"] == role and all(case.get(key) == fact for key, fact in facts.items())]

    @cached_property
    def _summaries(self):
        return {name: of_run(outcome) if outcome.complete else None for name in self.cases for outcome in [self.outcome(name)]}

    def summary(self, name):
        """None for a run that did not come to its end."""
        return self._summaries[name]

    @cached_property
    def quantities(self):
        """The file's own; else those of every scene that are not zero or absent in every run."""
        if self.plan["quantities"]:
            return [Quantity(**each) for each in self.plan["quantities"]]
        found = [each for each in self._summaries.values() if each is not None]
        return [each for each in of_every_scene(self.scene) if any(value(each.source, summary) for summary in found)]

    @cached_property
    def scales(self):
        summary = next((each for each in self._summaries.values() if each is not None), None)
        return scales(self.quantities, self.scene, summary) if summary else {each.name: 1.0 for each in self.quantities}

    def value(self, name, quantity):
        summary = self.summary(name)
        return None if summary is None else value(quantity.source, summary)

    def seconds(self, name):
        """Wall time of the time loop."""
        summary = self.summary(name)
        return None if summary is None else summary["wall_seconds"]

    def difference(self, name, other, quantity):
        """Relative to the quantity's scale; None where one of both has no value."""
        one, two = self.value(name, quantity), self.value(other, quantity)
        return None if one is None or two is None else abs(one - two) / self.scales[quantity.name]

    def field_difference(self, name, other):
        """RMS of the velocities' difference over the scene's largest speed."""
        if self.summary(name) is None or self.summary(other) is None:
            return None
        one, two = (self.outcome(each).last("velocity") for each in (name, other))
        scale = speed_of(self.scene) or float(np.sqrt(np.mean(two**2))) or 1.0
        return float(np.sqrt(np.mean((one - two) ** 2)) / scale) if one.shape == two.shape else None


def work(study, name):
    """What a run cost, and what it says of itself."""
    summary = study.summary(name)
    row = {"status": study.outcome(name).status}
    if summary is None:
        return row
    integrator = summary["integrator"]
    steps = integrator["steps"]
    adaptive = integrator["method"] != "explicit"
    estimate = integrator["error_estimate"]
    return row | {"seconds": summary["wall_seconds"], "steps": steps, "rejected": integrator["rejected"], "rhs_evaluations": integrator["rhs_evaluations"] or steps,
                  "tolerance_idle": integrator["limited_by"]["stability"] / steps if adaptive and steps else None,
                  "residual": summary["energy"]["relative_residual"], "estimate": estimate and estimate["total"]}


def case_rows(study):
    for name, case in study.cases.items():
        yield {"case": name, "role": case["role"], **{key: case.get(key) for key in ("method", "setting", "effort", "kind", "point", "member")}, **work(study, name),
               **{quantity.name: study.value(name, quantity) for quantity in study.quantities}, "message": " ".join(study.outcome(name).message.split())[:300] or None,
               "settings": plans.typed(case["settings"])}


# ------------------------------------------------------------------ trade

def trade_rows(study):
    """A row for each rung of each ladder and each quantity: its error against the first reference, and how far both references are apart."""
    first, second = study.named("reference")
    measured = [(quantity.name, lambda name, other, quantity=quantity: study.difference(name, other, quantity),
                 lambda name, quantity=quantity: study.value(name, quantity)) for quantity in study.quantities]
    measured.append((field_of_velocity, study.field_difference, lambda name: None))
    for name in study.named("ladder"):
        case, cost = study.cases[name], work(study, name)
        for quantity, difference, own in measured:
            yield {"method": case["method"], "setting": case["setting"], "rung": case["rung"], **cost, "quantity": quantity, "value": own(name), "reference": own(first),
                   "error": difference(name, first), "references_apart": difference(second, first)}


def recommendations(rows):
    """For each quantity and level the cheapest rung that meets it and goes on meeting it in all tighter rungs of its ladder: no lucky hits."""
    for quantity in dict.fromkeys(row["quantity"] for row in rows):
        of = [row for row in rows if row["quantity"] == quantity]
        for level in levels:
            apart = of[0]["references_apart"]
            base = {"quantity": quantity, "level": level, "references_apart": apart}
            if apart is None or apart > level:
                yield base | {"advice": "undecidable: the references differ by more" if apart is not None else "undecidable: a reference has no value"}
                continue
            ladders = {}
            for row in sorted(of, key=lambda row: row["rung"]):
                ladders.setdefault(row["method"], []).append(row)
            best = cheapest(ladders.values(), "error", level)
            yield base | ({"advice": "none of the ladders"} if best is None else {"advice": f"{best['method']}, {best['setting']}", "seconds": best["seconds"], "error": best["error"]})


# ------------------------------------------------------------------ error bars

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
        known = {kind: bar for kind, bar in self.relative.items() if bar is not None}
        return max(known, key=known.get) if known else None

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
    here, scale = study.value(base, quantity), study.scales[quantity.name]
    bars = Bars(quantity, here, scale, {})
    for name in study.named("refined", point=point):
        case = study.cases[name]
        moved = study.difference(name, base, quantity)
        bars.undecided |= (study.value(name, quantity) is None) != (here is None)
        if moved is None:
            continue
        bars.relative[case["kind"]] = max(moved, bars.relative.get(case["kind"]) or 0.0)
        # What is no dearer than the run itself, but for the noise of clocks, counts as a hundredth of it.
        bars.efforts[case["effort"]] = (case["kind"], moved, max(study.seconds(name) - study.seconds(base), 0.01 * study.seconds(base), 1e-6))
    for names, values in ((study.named("member", point=point, finer=None), bars.members), (study.named("member", point=point, finer="finer"), bars.finer)):
        found = [study.value(name, quantity) for name in names]
        values.extend(each for each in found if each is not None)
        bars.undecided |= 0 < len(values) < len(names)
    if len(bars.members) > 1:
        bars.relative["chaos"] = _half_range(bars.members) / scale
    return bars


def verdict(bars, converged):
    if bars.undecided:
        return "undecided: some runs have it, some have not"
    if bars.value is None:
        return "absent"
    if bars.largest is None:
        return "not measured"
    if bars.relative[bars.largest] <= converged:
        return "converged"
    return {"time": "needs a tolerance", "local": "needs a tolerance", "space": "needs cells", "chaos": "chaotic"}[bars.largest]


def best_effort(bars):
    """What moves the largest bar most per second, in words."""
    kind = bars.largest
    if kind is None:
        return ""
    if kind == "chaos":
        return f"more members: of {len(bars.members)} the mean is known to ±{100.0 * bars.relative[kind] / len(bars.members) ** 0.5:.2g} %"
    rates = {effort: moved / seconds for effort, (of, moved, seconds) in bars.efforts.items() if of == kind}
    effort = max(rates, key=rates.get)
    _, moved, seconds = bars.efforts[effort]
    return f"{effort}: moves it by {100.0 * moved:.2g} % for {seconds:.2g} s more" if moved > 0.0 else ""


def bar_rows(study, point=None, base=None):
    base = base or study.named("base")[0]
    for quantity in study.quantities:
        bars = bars_at(study, quantity, base, point)
        yield bars, {"quantity": quantity.name, "unit": quantity.unit, "value": bars.value, "scale": bars.scale,
                     **{kind: None if bars.relative.get(kind) is None else bars.relative[kind] * bars.scale for kind in ("time", "local", "space", "chaos")},
                     "verdict": verdict(bars, study.plan["converged"]), "largest": bars.largest, "effort": best_effort(bars),
                     "mean": float(np.mean(bars.members)) if bars.members else None, "same_distribution": bars.probability}


# ------------------------------------------------------------------ sweep

def sweep_rows(study):
    for n, point in enumerate(study.plan["points"]):
        name = study.named("point", point=n)[0]
        row = {**{key: (value if isinstance(value, (int, float, str)) else str(value)) for key, value in point.items()}, **work(study, name)}
        for quantity in study.quantities:
            row[quantity.name] = study.value(name, quantity)
            if study.plan["sweep_bars"]:
                bars = bars_at(study, quantity, name, n)
                known = [bar for bar in bars.relative.values() if bar is not None]
                row[f"± {quantity.name}"] = float(np.hypot.reduce(known)) * bars.scale if known else None
        yield row
