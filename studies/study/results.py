"""The runs of a study: what each predicts and cost, how far two are apart."""
import statistics
from functools import cached_property

import numpy as np

from study import plan as plans
from study.file import Quantity
from study.outcome import kept, run as compute
from study.quantities import of_every_scene, of_run, scale, speed_of, value

class Study:
    """A plan and the runs that it asked for; those that are not there yet are computed, or left out (`partial`)."""

    def __init__(self, out, key="", partial=False):
        self.out, self.plan, self.partial = out, plans.load(out, key), partial
        self.cases = self.plan["cases"]
        self.scene = self.plan["resolved"]
        self._outcomes, self._summaries = {}, {}

    def look_again(self):
        """Forgets what was not there."""
        self._outcomes = {run: outcome for run, outcome in self._outcomes.items() if outcome is not None}
        self.__dict__.pop("quantities", None)

    def outcome(self, name):
        """None: it is not there yet."""
        run = self.cases[name]["run"]
        if run not in self._outcomes:
            self._outcomes[run] = (kept if self.partial else compute)(plans.case(self.plan, name), self.out / "runs")
        return self._outcomes[run]

    def named(self, role, **facts):
        """Names of the cases of this role and these facts; None: the fact is absent."""
        return [name for name, case in self.cases.items() if case["role"] == role and all(case.get(key) == fact for key, fact in facts.items())]

    def named_any(self, role):
        """Names of the cases of this role, whatever their facts."""
        return [name for name, case in self.cases.items() if case["role"] == role]

    def there(self, role, **facts):
        """As `named`, of the cases whose runs are there."""
        return [name for name in self.named(role, **facts) if self.outcome(name) is not None]

    def status(self, name):
        outcome = self.outcome(name)
        return "to come" if outcome is None else outcome.status

    def message(self, name):
        """Why a run failed, in a line, without the warnings before; empty: it did not."""
        outcome = self.outcome(name)
        if outcome is None or outcome.complete:
            return ""
        _, word, said = outcome.message.rpartition("error: ")
        return " ".join((word + said).split())

    def summary(self, name):
        """None for a run that did not come to its end."""
        run, outcome = self.cases[name]["run"], self.outcome(name)
        if outcome is None or not outcome.complete:
            return None
        if run not in self._summaries:
            self._summaries[run] = of_run(outcome)
        return self._summaries[run]

    @cached_property
    def quantities(self):
        """The file's own; else those of every scene that are not zero or absent in every run."""
        if self.plan["quantities"]:
            return [Quantity(**each) for each in self.plan["quantities"]]
        found = [summary for name in self.cases if (summary := self.summary(name)) is not None]
        return [each for each in of_every_scene(self.scene) if any(value(each.source, summary) for summary in found)]

    def scale(self, name, quantity):
        """What errors of the run `name` are measured by."""
        summary = self.summary(name)
        own = None if summary is None else scale(quantity, self.scene_of(name), summary)
        return own or self._most(quantity)

    def _most(self, quantity):
        """The largest size of a quantity in all runs that are there; 1 where it is zero in all."""
        return max((abs(found) for name in self.cases if (found := self.value(name, quantity)) is not None), default=0.0) or 1.0

    def scene_of(self, name):
        """The scene of a run as the program understood it: what varies may change its speeds and times."""
        return self.outcome(name).results.scene

    def value(self, name, quantity):
        summary = self.summary(name)
        return None if summary is None else value(quantity.source, summary)

    def seconds(self, name):
        """Wall time of the time loop, of each time that the case has been run (median)."""
        summary = self.summary(name)
        return None if summary is None else statistics.median([summary["wall_seconds"], *self.outcome(name).repeats()])

    def difference(self, name, other, quantity):
        """Relative to the quantity's scale in `other`; None where one of both has no value."""
        one, two = self.value(name, quantity), self.value(other, quantity)
        return None if one is None or two is None else abs(one - two) / self.scale(other, quantity)

    def field_difference(self, name, other):
        """RMS of the velocities' difference over the scene's largest speed."""
        if self.summary(name) is None or self.summary(other) is None:
            return None
        one, two = (self.outcome(each).last("velocity") for each in (name, other))
        reach = speed_of(self.scene_of(other)) or float(np.sqrt(np.mean(two**2))) or 1.0
        with np.errstate(over="ignore", invalid="ignore"):
            return float(np.sqrt(np.mean((one - two) ** 2)) / reach) if one.shape == two.shape else None

    def drift(self, name, other):
        """(times in s, RMS difference of the velocities over the scene's largest speed) at the outputs that both runs have; as far as both came."""
        one, two = (self.outcome(each).results for each in (name, other))
        both = list(zip(one.frames, two.frames))
        apart = [np.sqrt(np.mean((a["velocity"] - b["velocity"]) ** 2)) for a, b in both]
        return np.array([a.time for a, _ in both]), np.array(apart) / (speed_of(self.scene_of(other)) or 1.0)


def work(study, name):
    """What a run cost, and what it says of itself."""
    summary = study.summary(name)
    row = {"status": study.status(name)}
    if summary is None:
        return row
    integrator = summary["integrator"]
    steps = integrator["steps"]
    adaptive = integrator["method"] != "explicit"
    estimate = integrator["error_estimate"]
    return row | {"seconds": study.seconds(name), "steps": steps, "rejected": integrator["rejected"], "rhs_evaluations": integrator["rhs_evaluations"] or steps,
                  "tolerance_idle": integrator["limited_by"]["stability"] / steps if adaptive and steps else None,
                  "residual": summary["energy"]["relative_residual"], "estimate": estimate and estimate["total"]}


def case_rows(study):
    for name, case in study.cases.items():
        yield {"case": name, "role": case["role"], **{key: case.get(key) for key in ("method", "setting", "effort", "kind", "point", "member")}, **work(study, name),
               **{quantity.name: study.value(name, quantity) for quantity in study.quantities}, "message": study.message(name) or None,
               "settings": plans.typed(case["settings"])}
