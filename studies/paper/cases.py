"""The paper's nine cases under every treatment, as the study's file tells them."""
from dataclasses import dataclass

from study.results import Study


@dataclass(frozen=True)
class Treatment:
    """How the equations are integrated. `resolved`: the step or tolerance follows the fastest waves."""
    key: str
    label: str
    resolved: bool


def read(out):
    """The study, and the names of its cases by (radius in mm, speed in m/s, treatment)."""
    study = Study(out)
    treatments = {key: Treatment(key, title, not key.startswith("a-")) for key, title in study.plan["titles"].items()}
    points: list[tuple[int, int]] = [(round(1e3 * point["parameters.R"]), round(point["parameters.v"])) for point in study.plan["points"]]
    found: dict[tuple[int, int, Treatment], str] = {}
    for name in study.named_any("rung"):
        radius, speed = points[study.cases[name]["point"]]
        found[radius, speed, treatments[study.cases[name]["method"]]] = name
    return study, found
