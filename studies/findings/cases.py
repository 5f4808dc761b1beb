"""The runs of the findings: the reference case with other steps, schemes, models, speeds and local methods."""
from study.case import Case

scene = "paper/reference.toml"
us = 1e-6
gap = 3.0e-3  # m, between plate and cylinder
schemes = ("usf", "usl", "musl")
steps = (2e-7, 1e-7, 5e-8, 2.5e-8)  # s
resolved_step = 5e-8  # s: such steps and shorter ones resolve the fastest waves
_glass: dict = {"density": 2500.0, "young": 72e9, "poisson": 0.25}
_steel: dict = {"density": 7800.0, "young": 195e9, "poisson": 0.25}
_mises = {"yield": 359e6, "peak": 484e6, "hardening": 9.6e9, "softening": 9.6e9}
# What is left of the models: label -> tables of materials in place of the scene's.
models: dict[str, dict[str, dict]] = {"all elastic": {"material.glass": _glass, "material.steel": _steel},
          "steel von Mises, glass elastic": {"material.glass": _glass, "material.steel": {**_steel, "von_mises": _mises}},
          "glass complete, steel elastic": {"material.steel": _steel},
          "glass complete, steel von Mises without decohesion": {"material.steel": {**_steel, "von_mises": _mises}},
          "complete": {}}
speeds = (400, 800)  # m/s
# Local method, solver, rtol.
local_methods = [("closed-form", None, None), *[("substep", None, rtol) for rtol in (1e-2, 1e-4, 1e-6, 1e-8)],
                 *[("cvode", "adams", rtol) for rtol in (1e-2, 1e-4, 1e-6, 1e-8)], ("cvode", "bdf", 1e-2), ("cvode", "bdf", 1e-6)]


def explicit(scheme, step):
    return {"integrator.method": "explicit", "integrator.scheme": scheme, "integrator.step": step}


adaptive = {"integrator.method": "arkode-explicit", "integrator.order": 3, "integrator.rtol": 1e-2}


def step_cases(quick):
    """(scheme, step) -> Case."""
    chosen = [(scheme, step) for scheme in schemes for step in steps] if not quick else [(scheme, step) for scheme in ("usf", "musl") for step in (2e-7, 5e-8)]
    return {(scheme, step): Case(f"steps/{scheme}-{step / us:g}", scene, explicit(scheme, step), fields=False) for scheme, step in chosen}


def model_cases(quick):
    """(label, scheme, step) -> Case."""
    labels = list(models)[:-1] if not quick else list(models)[:1]
    return {(label, scheme, step): Case(f"models/{n}-{scheme}-{step / us:g}", scene, {**explicit(scheme, step), **models[label]}, fields=False)
            for n, label in enumerate(labels) for scheme in ("usf", "musl") for step in ((2e-7, 1e-7) if not quick else (2e-7,))}


def speed_cases(quick):
    """(speed, scheme, step) -> Case."""
    chosen = [(speed, scheme, step) for speed in speeds for scheme in ("usf", "musl") for step in (2e-7, 5e-8, 2.5e-8)] if not quick else [(800, "musl", 5e-8)]
    return {(speed, scheme, step): Case(f"speeds/{speed}-{scheme}-{step / us:g}", scene, {
        **explicit(scheme, step), "body.1.velocity.1": -float(speed), "time.start": -gap / speed}, fields=False) for speed, scheme, step in chosen}


def local_cases(quick):
    """(method, solver, rtol) -> Case; outputs each half a microsecond, of series only."""
    found = {}
    for method, solver, rtol in local_methods if not quick else local_methods[:2]:
        settings: dict = {**explicit("musl", 5e-8), "constitutive.method": method, "output.every": 5e-7}
        if rtol is not None:
            settings |= {"constitutive.rtol": rtol, "constitutive.atol": 1e-3 * rtol}
        if solver is not None:
            settings["constitutive.solver"] = solver
        found[method, solver, rtol] = Case("local/" + "-".join(str(part) for part in (method, solver, rtol) if part is not None), scene, settings, fields=False)
    return found


# What README.md shows: its picture's scene is this one. The test of the picture's stamp asks for it here.
picture_settings = explicit("musl", 2.5e-8)


def picture_cases(_quick):
    """Name -> Case, with all fields."""
    return {"reference": Case("pictures/reference", scene, picture_settings),
            "paper-step": Case("pictures/paper-step", scene, {**explicit("usf", 2e-7), "integrator.max_growth": float("inf")}),
            "musl-paper-step": Case("pictures/musl-paper-step", scene, explicit("musl", 2e-7)),
            "adaptive": Case("pictures/adaptive", scene, adaptive)}
