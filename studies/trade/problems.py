"""The three problems, what is measured of them, and the settings of every method."""
from dataclasses import dataclass, field

import numpy as np
from study.case import Case

us = 1e-6


@dataclass(frozen=True)
class Problem:
    """`scale` (m/s) makes errors of velocity relative; `tight`: two ways to a reference solution."""
    key: str
    title: str
    scene: str
    settings: dict = field(hash=False)
    scale: float
    steps: tuple  # s, of the explicit schemes
    tolerances: tuple  # of ERK
    implicit_tolerances: tuple
    shapes: tuple
    tight: tuple = field(hash=False)
    own_tight: dict = field(hash=False, default=None)  # of DIRK, whose remaps put it apart
    implicit: dict = field(hash=False, default_factory=dict)  # settings of DIRK


def explicit(scheme, step):
    return {"integrator.method": "explicit", "integrator.scheme": scheme, "integrator.step": step}


def adaptive(method, order, rtol):
    phases = {"integrator.remap": 1e-6} if method == "implicit" else {}
    return {"integrator.method": f"arkode-{method}", "integrator.order": order, "integrator.rtol": rtol, **phases}


def local(method, rtol):
    return {"constitutive.method": method, "constitutive.solver": "adams", "constitutive.rtol": rtol, "constitutive.atol": 1e-3 * rtol}


_reference = {"integrator.max_growth": float("inf")}
_ladder = tuple(step * us for step in (0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625))
_six = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
impact = Problem("impact", "smooth elastic impact", "trade/impact.toml", {"integrator.max_growth": float("inf")}, 1.0, _ladder, _six, _six,
                 ("linear", "gimp", "bspline2"), (adaptive("explicit", 5, 1e-9), adaptive("explicit", 4, 1e-8)), adaptive("implicit", 5, 1e-8))
# First localisation comes at -2.29 us. Bodies that meet within a phase feel each other from the next one on: with 1 us that is after the end.
_short_phases = {"integrator.remap": 1e-7}
onset = Problem("onset", "reference case to 0.5 µs after first localisation", "paper/reference.toml", {**_reference, "time.end": -1.79e-6}, 200.0, _ladder,
                _six, (1e-1, 1e-2, 1e-3), ("linear", "bspline2"),
                ({**adaptive("explicit", 5, 1e-7), **local("substep", 1e-9)}, {**adaptive("explicit", 3, 1e-7), **local("cvode", 1e-9)}),
                {**adaptive("implicit", 5, 1e-4), **local("substep", 1e-9), **_short_phases}, _short_phases)
failure = Problem("failure", "reference case to {end} µs", "paper/reference.toml", {**_reference, "time.end": 150e-6}, 200.0, _ladder[:5], _six[:4], (1e-2,),
                  ("linear", "bspline2"),
                  (adaptive("explicit", 5, 1e-5), adaptive("explicit", 3, 1e-5)))
problems = {problem.key: problem for problem in (impact, onset, failure)}


@dataclass(frozen=True)
class Method:
    """One point of a ladder. `family` names the curve, `tightness` orders it: the step or the tolerance."""
    family: str
    tightness: float
    settings: dict = field(hash=False)
    local: str = "closed-form"

    @property
    def name(self):
        return f"{self.family}-{self.tightness:g}" + ("" if self.local == "closed-form" else f"-{self.local}")


def ladders(problem, shape, quick):
    """family -> its methods, from loose to tight."""
    if quick:
        return _quick_ladders(problem)
    found = {scheme: [Method(scheme, step, explicit(scheme, step)) for step in problem.steps] for scheme in ("usf", "usl", "musl")}
    for order in (2, 3, 4, 5):
        found[f"erk{order}"] = [Method(f"erk{order}", rtol, adaptive("explicit", order, rtol)) for rtol in problem.tolerances]
        if problem is not failure or order == 3:
            found[f"dirk{order}"] = [Method(f"dirk{order}", rtol, {**adaptive("implicit", order, rtol), **problem.implicit})
                                     for rtol in problem.implicit_tolerances]
    if problem is not impact and shape == "linear":
        for kind in ("substep", "cvode"):
            found[f"musl-{kind}"] = [Method("musl", 5e-8, {**explicit("musl", 5e-8), **local(kind, rtol)}, f"{kind} {rtol:g}") for rtol in (1e-2, 1e-4, 1e-6)]
            found[f"erk3-{kind}"] = [Method("erk3", 1e-4, {**adaptive("explicit", 3, 1e-4), **local(kind, rtol)}, f"{kind} {rtol:g}") for rtol in (1e-2, 1e-4, 1e-6)]
    return found


def _quick_ladders(problem):
    steps, tolerances = {"impact": ((2.5e-8, 1.25e-8, 6.25e-9), (1e-2, 1e-4, 1e-6)), "onset": ((1e-7, 5e-8), (1e-2, 1e-4)), "failure": ((1e-7, 5e-8), (1e-2,))}[problem.key]
    found = {scheme: [Method(scheme, step, explicit(scheme, step)) for step in steps] for scheme in ("usf", "musl")}
    found |= {f"erk{order}": [Method(f"erk{order}", rtol, adaptive("explicit", order, rtol)) for rtol in tolerances] for order in (3, 4)}
    if problem is impact:
        found["dirk3"] = [Method("dirk3", rtol, adaptive("implicit", 3, rtol)) for rtol in tolerances[:2]]
    if problem is onset:
        found["musl-substep"] = [Method("musl", 5e-8, {**explicit("musl", 5e-8), **local("substep", 1e-4)}, "substep 0.0001")]
    return found


def shapes(problem, quick):
    return ("linear",) if quick else problem.shapes


def shape_name(problem, shape):
    """With one particle per cell gimp's functions are those of bspline2, and one of both is run."""
    return "gimp, bspline2" if shape == "bspline2" and problem is not impact else shape


quick_end = 2e-6  # s, of the run to failure


def failure_end(quick):
    """In microseconds."""
    return f"{(quick_end if quick else failure.settings['time.end']) / us:g}"


def title(problem, quick):
    return problem.title.format(end=failure_end(quick))


def case(problem, shape, name, settings, quick, every=None, longest=300.0):
    end = {"time.end": quick_end} if quick and problem is failure else {}
    output = {"output.every": every} if every else {"output.every": 1.0}
    return Case(f"{problem.key}-{shape}/{name}", problem.scene, {
        "space.shape_functions": shape, "output.fields": ["velocity"], **output, **problem.settings, **end, **settings}, longest=longest)


def quantities(problem, outcome):
    """What is compared, by name: numbers, and the field of velocities (m/s)."""
    summary = outcome.summary
    bodies = summary["bodies"]
    found = {"velocity": outcome.last("velocity")}
    if problem is impact:
        return found | {"kinetic energy of the target": bodies["target"]["kinetic"], "elastic energy": summary["energy"]["elastic"]}
    plate, cylinder = bodies["plate"], bodies["cylinder"]
    found |= {"kinetic energy of the plate": plate["kinetic"], "velocity of the cylinder": cylinder["momentum"][1] / cylinder["mass"]}
    if problem is onset:
        first = summary["failure"]["first_localisation"]
        return found | {"time of first localisation": None if first is None else first["time"]}
    return found | {"separated particles of the plate": plate["separated"], "outermost localised radius": plate["localised_radius_max"]}


def names(problem):
    """Names of the quantities, velocity first."""
    if problem is impact:
        return ["velocity", "kinetic energy of the target", "elastic energy"]
    both = ["velocity", "kinetic energy of the plate", "velocity of the cylinder"]
    return both + (["time of first localisation"] if problem is onset else ["separated particles of the plate", "outermost localised radius"])


# Times have no zero of their own: errors are over the time that the glass plate's thickness takes a wave.
wave_time = 5e-3 / 5879.0


def error(name, value, reference, problem):
    """Relative; None where one of both is missing."""
    if value is None or reference is None:
        return None
    if name == "velocity":
        with np.errstate(over="ignore", invalid="ignore"):
            return float(np.sqrt(np.mean((value - reference) ** 2)) / problem.scale)
    if name == "time of first localisation":
        return abs(value - reference) / wave_time
    return abs(value - reference) / abs(reference) if reference else None
