"""Scenes at the ends of what may be asked for: each ends well, or fails with a message that says why."""
from study.case import Case
from study.outcome import run

from stability.limits import time_unit

_reference, _row = "paper/reference.toml", "stability/row.toml"
_resolved = {"integrator.scheme": "musl", "integrator.step": 5e-8, "time.end": 2e-5}
_adaptive = {"integrator.method": "arkode-explicit", "time.end": 2e-5}
_implicit = {"integrator.method": "arkode-implicit", "time.end": 5e-6, "integrator.rtol": 1e-2, "integrator.remap": 1e-6}
# They swing to and fro across the nodes.
_on_nodes = {"integrator.step": 0.5 * time_unit, "integrator.max_growth": 1.5, "body.0.box.min.0": -5e-4 + 1e-12, "body.0.box.max.0": 0.0395 + 1e-12}
_short = {"time.end": 2e-6}
# What is extreme, scene, settings.
_table = [
    ("three times the critical step", _reference, {**_resolved, "integrator.step": 3.6e-7}),
    ("step of 0.1 ns, to 0.2 µs before touch", _reference, {**_resolved, "integrator.step": 1e-10, "time.end": -1.48e-5}),
    ("Courant number 0.95", _reference, {"integrator.scheme": "musl", "integrator.courant": 0.95, "time.end": 2e-5}),
    ("USL with a resolved step", _reference, {**_resolved, "integrator.scheme": "usl"}),
    ("impact at 2,000 m/s", _reference, {**_resolved, "integrator.step": 1e-8, "body.1.velocity.1": -2000.0, "time.start": -1.5e-6}),
    ("impact at 1 m/s", _reference, {**_resolved, "body.1.velocity.1": -1.0, "body.1.box.min.1": 0.005, "body.1.box.max.1": 0.055, "time.start": 0.0}),
    ("16 particles per cell", _reference, {**_resolved, "body.0.particles_per_cell": 16, "body.1.particles_per_cell": 16}),
    ("cells of 2.5 mm: two through the plate", _reference, {**_resolved, "space.cell": 2.5e-3}),
    ("Poisson's ratio 0.499 (steel)", _reference, {**_resolved, "integrator.step": 1e-8, "material.steel.poisson": 0.499, "time.end": 1e-5}),
    ("steel a million times softer than glass", _reference, {**_resolved, "material.steel.young": 7.2e4, "material.steel.von_mises.yield": 1e3,
                                                             "material.steel.von_mises.peak": 2e3, "material.steel.von_mises.hardening": 1e3,
                                                             "material.steel.von_mises.softening": 1e3}),
    ("glass without toughness (K_IC of 1 Pa √m)", _reference, {**_resolved, "material.glass.damage.toughness": 1.0}),
    ("decohesion over 1 pm", _reference, {**_resolved, "material.glass.decohesion.opening": 1e-12}),
    ("viscosity of 1 s in the decohesion", _reference, {**_resolved, "material.glass.decohesion.viscosity": 1.0}),
    ("rate floor of 1e9 /s", _reference, {**_resolved, "material.glass.damage.rate_floor": 1e9}),
    ("particles 1e-9 spacings from the nodes, ends free", _row, {**_on_nodes, "boundary.1.box.max.0": -1.0, "boundary.2.box.min.0": 1.0}),
    ("particles 1e-9 spacings from the nodes, ends held", _row, _on_nodes),
    ("explicit ARK, rtol 0.5", _reference, {**_adaptive, "integrator.rtol": 0.5}),
    ("explicit ARK, rtol 1e-8 (bspline2, to 2 µs)", _reference, {**_adaptive, **_short, "integrator.rtol": 1e-8, "integrator.order": 5, "space.shape_functions": "bspline2"}),
    ("explicit ARK, least step 0.1 µs at rtol 1e-6", _reference, {**_adaptive, "integrator.rtol": 1e-6, "integrator.min_step": 1e-7}),
    ("explicit ARK at 2,000 m/s", _reference, {**_adaptive, "integrator.rtol": 1e-2, "body.1.velocity.1": -2000.0, "time.start": -1.5e-6}),
    ("implicit ARK, phases of 10 ns", _reference, {**_implicit, "integrator.remap": 1e-8, "time.end": 1e-6}),
    ("implicit ARK, phases of 10 µs", _reference, {**_implicit, "integrator.remap": 1e-5}),
    ("implicit ARK with GMRES and a diagonal", _reference, {**_implicit, "integrator.linear_solver": "gmres", "integrator.preconditioner": "diagonal", "time.end": 0.0}),
    ("CVODE per particle at rtol 1e-10", _reference, {**_resolved, "constitutive.method": "cvode", "constitutive.rtol": 1e-10, "constitutive.atol": 1e-13, "time.end": 5e-6}),
    ("CVODE per particle at rtol 0.1", _reference, {**_resolved, "constitutive.method": "cvode", "constitutive.rtol": 0.1, "constitutive.atol": 1e-3, "time.end": 5e-6}),
]
_quick = (0, 1, 14, 16)


def cases(quick):
    """What is extreme -> Case."""
    chosen = [_table[n] for n in _quick] if quick else _table
    return {what: Case(f"extreme-{_table.index((what, scene, settings)):02}", scene, settings, fields=False, longest=120.0)
            for what, scene, settings in chosen}


def row(what, case, runs):
    outcome = run(case, runs)
    summary = outcome.summary
    if summary is None:
        return {"extreme": what, "status": outcome.status, "message": outcome.message}
    energy = summary["energy"]
    return {"extreme": what, "status": outcome.status, "until_us": 1e6 * summary["time"], "steps": summary["integrator"]["steps"],
            "max_growth": energy["max_growth"], "made": None if energy["relative_residual"] is None else -energy["relative_residual"],
            "seconds": summary["wall_seconds"], "message": summary["message"] or ""}
