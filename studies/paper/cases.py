"""The paper's nine cases under every treatment, as the study's file tells them."""
from dataclasses import dataclass

from study.results import Study


@dataclass(frozen=True)
class Treatment:
    """How the equations are integrated, and under which reading of the model. `method`: the same under every reading. `resolved`: the step or tolerance follows the
    fastest waves. `probe`: it stands beside (b), and tells what a ring or the cell are worth."""
    key: str
    label: str
    method: str
    alternative: bool = False

    @property
    def resolved(self):
        return not self.method.startswith("a-")

    @property
    def probe(self):
        return self.method.startswith(("moved", "fine"))


def read(out):
    """The study, and the names of its cases by (radius in mm, speed in m/s, treatment)."""
    study = Study(out)
    variants = study.plan["variants"]
    treatments = {key: Treatment(key, title, variants.get(key, {"of": key})["of"], key in variants) for key, title in study.plan["titles"].items()}
    points: list[tuple[int, int]] = [(round(1e3 * point["parameters.R"]), round(point["parameters.v"])) for point in study.plan["points"]]
    found: dict[tuple[int, int, Treatment], str] = {}
    for name in study.named_any("rung"):
        radius, speed = points[study.cases[name]["point"]]
        found[radius, speed, treatments[study.cases[name]["method"]]] = name
    return study, found
