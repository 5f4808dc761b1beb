"""What a run says of its own accuracy: sentences, each good, doubtful, bad, or a mere note."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from vitrum.results import Run

# Shares of the energy that a run may lose or make before the page says so, and before it warns.
closed, open_ = 0.01, 0.05
created = 1.01  # growth of kinetic + elastic energy over what was put in
idle = 0.5  # share of the steps that stability limits, from which on a tolerance decides nothing


@dataclass(frozen=True)
class Fact:
    grade: str  # good | note | mind | bad
    text: str


def percent(share: float) -> str:
    """
    >>> percent(0.00158), percent(-0.25), percent(0.0)
    ('0.16 %', '-25 %', '0 %')
    """
    return f"{100.0 * share:.2g} %"


def _energy(energy: dict[str, Any]) -> list[Fact]:
    facts = []
    residual = energy["relative_residual"]
    if residual is not None:
        what = "lost" if residual > 0 else "made"
        grade = "good" if abs(residual) <= closed else "mind" if abs(residual) <= open_ else "bad"
        text = f"The energy account closes within {percent(abs(residual))}" if grade == "good" else f"The numerics {what} {percent(abs(residual))} of the energy"
        facts.append(Fact(grade, f"{text} ({energy['residual']:.3g} J {what} of {energy['initial']:.4g} J at the start)."))
    growth = energy["max_growth"]
    if growth is not None and growth > created:
        facts.append(Fact("bad" if growth > 1.0 + open_ else "mind", f"Kinetic and elastic energy grew to {growth:.3g} times what was put in: the step is too long."))
    return facts


def _steps(integrator: dict[str, Any]) -> list[Fact]:
    steps, limits = integrator["steps"], integrator["limited_by"]
    if not steps:
        return []
    limited = {name: count / steps for name, count in limits.items() if count}
    said = ", ".join(f"{name} {percent(share)}" for name, share in sorted(limited.items(), key=lambda item: -item[1]))
    if not limited:
        return [Fact("note", f"{steps:,} steps of a fixed length.")]
    adaptive = integrator["method"] != "explicit"
    if adaptive and limited.get("stability", 0.0) > idle:
        return [Fact("mind", f"The tolerance was idle in {percent(limited['stability'])} of the steps: stability limited them ({steps:,} steps; limits: {said}).")]
    rejected = f", {integrator['rejected']:,} rejected" if integrator["rejected"] else ""
    return [Fact("note", f"{steps:,} steps{rejected}; what limited them: {said}.")]


def _estimate(integrator: dict[str, Any]) -> Fact:
    estimate = integrator["error_estimate"]
    if estimate is None:
        return Fact("note", "This method estimates no errors of time integration: repeat the run with half the step, or ask for error bars (vitrum-study).")
    parts = ", ".join(f"{name} {estimate[name]:.2g}" for name in ("position", "velocity", "strain") if estimate.get(name) is not None)
    total = estimate["total"]
    grade = "good" if total <= closed else "mind" if total <= 1.0 else "bad"
    return Fact(grade, f"Local errors of time integration add up to {total:.2g} of the scene's scales ({parts}).")


def progress(run: Run) -> float:
    """Share of the simulated time that is done."""
    start, end = run.scene["time"]["start"], run.scene["time"]["end"]
    reached = run.columns("series")["time"]
    return float((reached[-1] - start) / (end - start)) if len(reached) and end > start else 0.0


def facts(run: Run) -> list[Fact]:
    """Of a run without a summary, that it has none."""
    summary = run.summary
    if summary is None:
        return [Fact("mind", f"Under way, or killed: {percent(progress(run))} of the simulated time is here.")]
    end = {"complete": Fact("good", "The run is complete."), "interrupted": Fact("mind", f"The run was interrupted: {summary['message'] or 'it can be resumed'}"),
           "failed": Fact("bad", f"The run failed: {summary['message']}")}[summary["status"]]
    return [end, *_energy(summary["energy"]), _estimate(summary["integrator"]), *_steps(summary["integrator"]),
            *[Fact("mind", f"Warning: {warning}") for warning in summary["warnings"]]]


def headline(found: list[Fact]) -> Fact:
    """The worst grade in words."""
    words = {"good": "Nothing speaks against this run", "note": "Nothing speaks against this run", "mind": "To be read with care", "bad": "Not to be trusted as it stands"}
    worst = max((fact.grade for fact in found), key=list(words).index)
    return Fact("good" if worst == "note" else worst, words[worst])
