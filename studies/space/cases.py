"""Groups of settings of the reference case, each over cells of 1, 0.5, 0.25 mm; every setting is a small ensemble."""
from dataclasses import dataclass, field

from study.case import Case

amplitude = 1e-12  # cells
cells = {"1": 1e-3, "0.5": 5e-4, "0.25": 2.5e-4}  # mm -> m
end, quick_end = 60e-6, 4e-6  # s
members = {"1": 5, "0.5": 5, "0.25": 3}


@dataclass(frozen=True)
class Setting:
    """`label` stands in tables and legends."""
    name: str
    label: str
    settings: dict = field(default_factory=dict, hash=False)


def _bodies(friction):
    return {"contact": {"method": "bodies", "friction": friction}}


def _per_cell(count):
    return {"body.0.particles_per_cell": count, "body.1.particles_per_cell": count, **_bodies(0.1)}


def _functions(shape, count):
    return {**_per_cell(count), "space.shape_functions": shape}


def _rate(rate):
    return {**_bodies(0.1), "material.glass.damage.rate": rate}


base = Setting("base", "gimp, 1 a cell, friction 0.1, running maximum", _bodies(0.1))

# Group -> (title, settings).
groups = {
    "contact": ("contact", [Setting("single", "one field", {"contact": {"method": "single"}}), Setting("friction-0", "friction 0", _bodies(0.0)),
                            Setting("base", "friction 0.1", base.settings), Setting("friction-0.3", "friction 0.3", _bodies(0.3)),
                            Setting("stick", "stick", _bodies(float("inf")))]),
    "particles": ("particles a cell", [Setting("base", "1", base.settings), Setting("per-cell-4", "4", _per_cell(4)),
                                       Setting("per-cell-9", "9", _per_cell(9))]),
    "functions": ("shape functions, 4 particles a cell", [Setting("linear-4", "linear", _functions("linear", 4)), Setting("per-cell-4", "gimp", _per_cell(4)),
                                                          Setting("bspline2-4", "bspline2", _functions("bspline2", 4))]),
    "gradients": ("velocity gradients", [Setting("base", "between nodes", base.settings),
                                         Setting("centroids", "between centroids", {**_bodies(0.1), "space.gradients": "centroids"})]),
    "rate": ("rate of eq. 7", [Setting("base", "running maximum", base.settings), Setting("averaged", "averaged, 1 µs", _rate({"averaged": 1e-6})),
                               Setting("fixed", "1e3 /s", _rate({"fixed": 1e3}))]),
}
_quick = {"contact": (0, 2), "particles": (0, 1)}
# What is too long for every cell is run on the coarser ones.
_coarse = {"per-cell-9": ("1",), "per-cell-4": ("1", "0.5"), "linear-4": ("1", "0.5"), "bspline2-4": ("1", "0.5")}


def asked(quick):
    if not quick:
        return groups
    return {key: (groups[key][0], [groups[key][1][n] for n in chosen]) for key, chosen in _quick.items()}


def cells_of(setting, quick):
    """Names of the cells that a setting is run with, coarse to fine."""
    return ("1",) if quick else _coarse.get(setting.name, tuple(cells))


def all_settings(quick):
    """Name -> setting, each once."""
    return {setting.name: setting for _, each in asked(quick).values() for setting in each}


def ensemble(setting, cell, quick):
    """Members differ by displacements of 1e-12 cell."""
    shared = {"space.cell": cells[cell], "space.shape_functions": "gimp", "time.end": quick_end if quick else end, "integrator.method": "explicit",
              "integrator.scheme": "musl", "integrator.courant": 0.4, "integrator.max_growth": float("inf"), "output.every": 1.0}
    return [Case(f"{setting.name}/{cell}/{member}", "paper/reference.toml", {
        **shared, "body.0.perturbation": {"amplitude": amplitude, "seed": member}, "body.1.perturbation": {"amplitude": amplitude, "seed": 1000 + member},
        **setting.settings}, fields=False, longest=3600.0) for member in range(1, (2 if quick else members[cell]) + 1)]
