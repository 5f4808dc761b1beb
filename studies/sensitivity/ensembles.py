"""Questions and their ensembles, as the study's file tells them: an ensemble is a rung of a question, its members are cases."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Ensemble:
    """`name`: of the question that asked first, where several ask for the same runs; `label` stands on the axis of its question's figure; `cases`: names."""
    name: str
    label: str
    cases: tuple


base = "step 0.05 µs"
# Of time integration; others of the step and of the tolerance are coarse.
resolved = (base, "step 0.025 µs", "step 0.0125 µs", "tolerance 1e-2", "tolerance 1e-3", "tolerance 1e-4")
# The fragments of these are drawn: label -> ensemble.
fragmenting = {"MUSL 0.197 µs": "step 0.2 µs", "base": base, "MUSL 0.0123 µs": "step 0.0125 µs", "ERK 3, rtol 1e-2": "tolerance 1e-2", "9 per cell": "particles 9",
               "cells of 0.5 mm": "cell 0.5 mm", "cells of 0.25 mm": "cell 0.25 mm"}


def questions(plan):
    """Question -> (title, its ensembles from coarse to fine, or from the paper's reading to others)."""
    cases = plan["cases"]
    found: dict[str, dict[str, tuple[str, list[str]]]] = {}
    for name, case in cases.items():
        owner = cases[case["run"]]
        found.setdefault(case["method"], {}).setdefault(case["setting"], (f"{owner['method']} {owner['setting']}", []))[1].append(name)
    return {key: (plan["titles"][key], [Ensemble(name, label, tuple(members)) for label, (name, members) in settings.items()]) for key, settings in found.items()}


def by_name(asked):
    """Name -> ensemble, each once."""
    return {ensemble.name: ensemble for _, ensembles in asked.values() for ensemble in ensembles}
