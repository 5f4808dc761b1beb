"""Groups of settings of the reference case, each over cells of 1, 0.5, 0.25 mm, and shipped scenes over their own cell and finer ones; every setting is a small ensemble."""
from dataclasses import dataclass, field

from study.case import Case

amplitude = 1e-12  # cells
cells = {"1": 1e-3, "0.5": 5e-4, "0.25": 2.5e-4, "0.125": 1.25e-4}  # mm -> m
end, short_end, quick_end = 60e-6, 10e-6, 4e-6  # s; short: what the finest cell is run to
plenty = {"1": 5, "0.5": 3, "0.25": 1}  # cell -> members
usual = {"1": 5, "0.5": 2}
few = {"1": 5, "0.5": 1}


@dataclass(frozen=True)
class Setting:
    """`label` stands in tables and legends; members: by cell, coarse to fine."""
    name: str
    label: str
    settings: dict = field(default_factory=dict, hash=False)
    members: dict = field(default_factory=lambda: usual, hash=False)


def _bodies(friction):
    return {"contact": {"method": "bodies", "friction": friction}}


def _per_cell(count, **more):
    return {"body.0.particles_per_cell": count, "body.1.particles_per_cell": count, **_bodies(0.1), **more}


def _functions(shape, count):
    return _per_cell(count, **{"space.shape_functions": shape})


def _paper(count):
    return {**_functions("linear", count), "contact": {"method": "single"}}


def _rate(rate, count=1):
    return _per_cell(count, **{"material.glass.damage.rate": rate})


base = Setting("base", "gimp, 1 a cell, friction 0.1, running maximum", _bodies(0.1), {**plenty, "0.125": 1})
four = Setting("per-cell-4", "4", _per_cell(4), few)
fixed, fixed_four = Setting("fixed", "1e3 /s", _rate({"fixed": 1e3}), plenty), Setting("fixed-4", "1e3 /s, 4 a cell", _rate({"fixed": 1e3}, 4), few)
paper, paper_four = Setting("linear-single", "linear, one field", _paper(1)), Setting("linear-single-4", "linear, one field, 4 a cell", _paper(4), few)


def named(setting, label):
    """The same setting as another group calls it."""
    return Setting(setting.name, label, setting.settings, setting.members)


# Group -> (title, settings).
groups = {
    "contact": ("contact", [Setting("single", "one field", {"contact": {"method": "single"}}, plenty), Setting("friction-0", "friction 0", _bodies(0.0)),
                            named(base, "friction 0.1"), Setting("friction-0.3", "friction 0.3", _bodies(0.3)),
                            Setting("stick", "stick", _bodies(float("inf")))]),
    "particles": ("particles a cell", [named(base, "1"), four, Setting("per-cell-9", "9", _per_cell(9), {"1": 5})]),
    "functions": ("shape functions", [named(base, "gimp"), named(four, "gimp, 4 a cell"), Setting("linear", "linear", _functions("linear", 1)),
                                      Setting("linear-4", "linear, 4 a cell", _functions("linear", 4), few), paper, paper_four,
                                      Setting("bspline2-4", "bspline2, 4 a cell", _functions("bspline2", 4), {"1": 5})]),
    "gradients": ("velocity gradients", [named(base, "between nodes"),
                                         Setting("centroids", "between centroids", {**_bodies(0.1), "space.gradients": "centroids"})]),
    "rate": ("rate of eq. 7", [named(base, "running maximum"), Setting("averaged", "averaged, 1 µs", _rate({"averaged": 1e-6})), fixed, fixed_four]),
}
_quick = {"contact": (0, 2), "particles": (0, 1)}


def asked(quick):
    if not quick:
        return groups
    return {key: (groups[key][0], [groups[key][1][n] for n in chosen]) for key, chosen in _quick.items()}


def cells_of(setting, quick):
    """Names of the cells that a setting is run with, coarse to fine."""
    return ("1",) if quick else tuple(setting.members)


def all_settings(quick):
    """Name -> setting, each once."""
    return {setting.name: setting for _, each in asked(quick).values() for setting in each}


def ensemble(setting, cell, quick):
    """Members differ by displacements of 1e-12 cell."""
    shared = {"space.cell": cells[cell], "space.shape_functions": "gimp", "time.end": quick_end if quick else short_end if cell == "0.125" else end,
              "integrator.method": "explicit", "integrator.scheme": "musl", "integrator.courant": 0.4, "integrator.max_growth": float("inf"),
              "output.every": quick_end if quick else short_end, "output.fields": ["effective_length", "cohesive_strength"]}
    return [Case(f"{setting.name}/{cell}/{member}", "paper/reference.toml", {
        **shared, "body.0.perturbation": {"amplitude": amplitude, "seed": member}, "body.1.perturbation": {"amplitude": amplitude, "seed": 1000 + member},
        **setting.settings}, longest=3600.0) for member in range(1, (2 if quick else setting.members[cell]) + 1)]


@dataclass(frozen=True)
class Shipped:
    """A scene of examples/, of so many bodies; cell: its own, m. members: of (part of the cell, particles a cell)."""
    name: str
    bodies: int
    cell: float
    members: dict = field(hash=False)

    def place(self, part, count):
        return f"{1e3 * self.cell / part:.3g}", str(count)


shipped = [Shipped("impact", 2, 0.5e-3, {(1, 1): 3, (2, 1): 1, (1, 4): 2}),
           Shipped("drop-ball", 2, 1e-3, {(1, 1): 3, (2, 1): 2, (1, 4): 3}),
           Shipped("laminated", 4, 0.38e-3, {(1, 1): 1, (1, 4): 1}),
           Shipped("blast", 1, 1.5e-3, {(1, 1): 3, (2, 1): 2, (1, 4): 3})]


def shipped_ensemble(scene, part, count):
    return [Case(f"shipped/{scene.name}/{part}-{count}/{member}", f"../examples/{scene.name}.toml", {
        "space.cell": scene.cell / part, "output.every": 1.0, "output.history_every": 1.0, "integrator.max_growth": float("inf"),
        **{f"body.{n}.particles_per_cell": count for n in range(scene.bodies)},
        **{f"body.{n}.perturbation": {"amplitude": amplitude, "seed": 1000 * n + member} for n in range(scene.bodies)}}, fields=False, longest=3600.0)
        for member in range(1, scene.members[part, count] + 1)]
