"""Ensembles: members differ by displacements of 1e-12 cell; ensembles by one setting, asked for by a question."""
from dataclasses import dataclass, field

from study.case import Case

amplitude = 1e-12  # cells
members = 30
end, quick_end = 150e-6, 20e-6  # s
# At 200 m/s a step of 0.05 us is a hundredth of a cell: the cylinder's particles land on nodes exactly, where the gradient of linear functions
# jumps, and rounding chooses the side. Steps are a little shorter so that none does; one question asks what it does.
off_nodes = 0.987


@dataclass(frozen=True)
class Ensemble:
    """`label` stands on the axis of its question's figure."""
    name: str
    label: str
    settings: dict = field(hash=False)
    members: int = members


def _musl(step):
    """`step` is nominal."""
    return {"integrator.method": "explicit", "integrator.scheme": "musl", "integrator.step": off_nodes * step}


def _on_nodes(step):
    return {**_musl(step), "integrator.step": step}


def _erk(rtol):
    return {"integrator.method": "arkode-explicit", "integrator.order": 3, "integrator.rtol": rtol}


def _implicit(remap):
    return {"integrator.method": "arkode-implicit", "integrator.order": 3, "integrator.rtol": 1e-2, "integrator.remap": remap}


def _per_cell(count):
    return {**_musl(5e-8), "body.0.particles_per_cell": count, "body.1.particles_per_cell": count}


def _cells(cell):
    # The step keeps its Courant number.
    return {**_musl(5e-5 * cell), "space.cell": cell}


def _local(method, rtol):
    return {**_musl(5e-8), "constitutive.method": method, "constitutive.solver": "adams", "constitutive.rtol": rtol, "constitutive.atol": 1e-3 * rtol}


base = Ensemble("base", "MUSL\n0.0493 µs", _musl(5e-8))


def _as(label):
    """The base ensemble under the name that it has in a question."""
    return Ensemble(base.name, label, base.settings)


# Question -> (title, ensembles from coarse to fine, or from the paper's reading to others).
questions = {
    "step": ("time step (MUSL)", [Ensemble("musl-0.2", "0.2 µs", _musl(2e-7)), Ensemble("musl-0.1", "0.1 µs", _musl(1e-7)), _as("0.05 µs"),
                                  Ensemble("musl-0.025", "0.025 µs", _musl(2.5e-8)), Ensemble("musl-0.0125", "0.0125 µs", _musl(1.25e-8), 15)]),
    "nodes": ("steps that land particles on nodes, and steps that do not (MUSL)", [
        Ensemble("on-nodes-0.05", "0.05 µs\non nodes", _on_nodes(5e-8)), _as("0.0493 µs"), Ensemble("on-nodes-0.025", "0.025 µs\non nodes", _on_nodes(2.5e-8), 15),
        Ensemble("musl-0.025", "0.0247 µs", _musl(2.5e-8))]),
    "tolerance": ("tolerance (ERK order 3)", [Ensemble("erk-1e-1", "1e-1", _erk(1e-1)), Ensemble("erk-1e-2", "1e-2", _erk(1e-2)),
                                              Ensemble("erk-1e-3", "1e-3", _erk(1e-3), 20), Ensemble("erk-1e-4", "1e-4", _erk(1e-4), 10)]),
    "local": ("local integration (MUSL 0.0493 µs)", [_as("closed\nform"), Ensemble("substep-1e-2", "substep\n1e-2", _local("substep", 1e-2), 15),
                                                   Ensemble("substep-1e-6", "substep\n1e-6", _local("substep", 1e-6), 15),
                                                   Ensemble("cvode-1e-6", "cvode\n1e-6", _local("cvode", 1e-6), 6)]),
    "remap": ("phase between remaps (implicit, order 3, rtol 1e-2)", [Ensemble("remap-2", "2 µs", _implicit(2e-6), 8), Ensemble("remap-1", "1 µs", _implicit(1e-6), 8),
                                                                     Ensemble("remap-0.5", "0.5 µs", _implicit(5e-7), 8), Ensemble("remap-0.25", "0.25 µs", _implicit(2.5e-7), 4)]),
    "particles": ("particles per cell (MUSL 0.0493 µs)", [_as("1"), Ensemble("per-cell-4", "4", _per_cell(4)), Ensemble("per-cell-9", "9", _per_cell(9), 10)]),
    # With one particle per cell gimp's functions are those of bspline2: one ensemble under both names.
    "shape": ("shape functions (MUSL 0.0493 µs)", [_as("linear"), Ensemble("gimp", "gimp, bspline2", {**_musl(5e-8), "space.shape_functions": "gimp"})]),
    "cell": ("cell size (MUSL, same Courant number)", [Ensemble("cell-1.25", "1.25 mm", _cells(1.25e-3)), _as("1 mm"), Ensemble("cell-0.5", "0.5 mm", _cells(5e-4), 20),
                                                       Ensemble("cell-0.25", "0.25 mm", _cells(2.5e-4), 4)]),
    "readings": ("readings of the model (MUSL 0.0493 µs)", [
        _as("paper's"), Ensemble("rate-1e3", "rate\n1e3 /s", {**_musl(5e-8), "material.glass.damage.rate": {"fixed": 1e3}}),
        Ensemble("rate-1e5", "rate\n1e5 /s", {**_musl(5e-8), "material.glass.damage.rate": {"fixed": 1e5}}),
        Ensemble("associated", "associated\nflow", {**_musl(5e-8), "material.glass.drucker_prager.flow": "associated"}),
        Ensemble("all-planes", "all\nplanes", {**_musl(5e-8), "material.glass.decohesion.plane": "all"}),
        Ensemble("viscous", "viscosity\n0.1 µs", {**_musl(5e-8), "material.glass.decohesion.viscosity": 1e-7})]),
}
# The fragments of these are drawn: label -> ensemble.
fragmenting = {"MUSL 0.197 µs": "musl-0.2", "base": "base", "MUSL 0.0123 µs": "musl-0.0125", "ERK 3, rtol 1e-2": "erk-1e-2", "9 per cell": "per-cell-9",
               "cells of 0.5 mm": "cell-0.5", "cells of 0.25 mm": "cell-0.25"}
_quick = {"step": (1, 2), "nodes": (0, 1), "tolerance": (1,), "readings": (0, 1)}


def asked(quick):
    """Question -> (title, ensembles)."""
    if not quick:
        return questions
    return {key: (questions[key][0], [Ensemble(e.name, e.label, e.settings, 3) for e in (questions[key][1][n] for n in chosen)]) for key, chosen in _quick.items()}


def all_ensembles(quick):
    """Name -> ensemble, each once."""
    return {ensemble.name: ensemble for _, ensembles in asked(quick).values() for ensemble in ensembles}


def case(ensemble, member, quick, **more):
    """`member` counts from 1; both bodies are perturbed, each by its own sequence."""
    return Case(f"{ensemble.name}/{member:02}", "paper/reference.toml", {
        "time.end": quick_end if quick else end, "integrator.max_growth": float("inf"), "output.every": 1.0, "output.fields": ["decohesion"],
        "body.0.perturbation": {"amplitude": amplitude, "seed": member}, "body.1.perturbation": {"amplitude": amplitude, "seed": 1000 + member},
        **ensemble.settings, **more}, longest=600.0)


# Runs that are watched on their way: label -> (settings, time between outputs in s). Outputs cut steps: theirs are off the nodes too.
_watched = {"MUSL 0.05 µs, landing on nodes": (_on_nodes(5e-8), 5e-7), "MUSL 0.0493 µs": (_musl(5e-8), 7.319e-7), "ERK 3, rtol 1e-2": (_erk(1e-2), 7.319e-7),
            "MUSL 0.0493 µs, gimp or bspline2": ({**_musl(5e-8), "space.shape_functions": "gimp"}, 7.319e-7)}


def watched(quick):
    """Label -> cases, the first of which the others are compared with."""
    labels = list(_watched)[:2] if quick else list(_watched)
    return {label: [case(Ensemble(f"watched-{n}", label, _watched[label][0]), member, quick,
                         **{"output.every": _watched[label][1], "output.fields": ["velocity"]}) for member in range(1, 3 if quick else 7)]
            for n, label in enumerate(labels)}
