"""The paper's nine cases under every treatment, made from one scene."""
from dataclasses import dataclass, field

from study.case import Case

gap = 3.0e-3  # m, between plate and cylinder
# Until when a case is followed, by the plate's radius (mm): what the text claims of it has happened by then.
ends = {200: 250e-6, 400: 300e-6, 800: 600e-6}
output_interval = 10e-6  # s
radii, speeds = (200, 400, 800), (200, 400, 800)


@dataclass(frozen=True)
class Treatment:
    """How the equations are integrated. `resolved`: the step or tolerance follows the fastest waves."""
    key: str
    label: str
    settings: dict = field(hash=False)
    resolved: bool = True


def _explicit(scheme, step):
    return {"integrator.method": "explicit", "integrator.scheme": scheme, "integrator.step": step}


def _adaptive(rtol):
    return {"integrator.method": "arkode-explicit", "integrator.order": 3, "integrator.rtol": rtol}


# The watchdog is off: what the paper's step does after it has blown up is part of the question.
treatments = [
    Treatment("a-usf", "(a) USF 0.2 µs", _explicit("usf", 2e-7), False),
    Treatment("a-musl", "(a) MUSL 0.2 µs", _explicit("musl", 2e-7), False),
    Treatment("b", "(b) MUSL 0.025 µs", _explicit("musl", 2.5e-8)),
    Treatment("c-1e-2", "(c) ERK 3, rtol 1e-2", _adaptive(1e-2)),
    Treatment("c-1e-3", "(c) ERK 3, rtol 1e-3", _adaptive(1e-3)),
    Treatment("d", "(d) MUSL 0.025 µs, CVODE", {**_explicit("musl", 2.5e-8), "constitutive.method": "cvode",
                                                "constitutive.solver": "adams", "constitutive.rtol": 1e-6}),
]
by_key = {treatment.key: treatment for treatment in treatments}
# Quick: the resolved run by a step twice as long, no local solver, two speeds, the smallest plate, the first 60 us.
quick_treatments = [by_key["a-usf"], by_key["a-musl"], Treatment("b", "(b) MUSL 0.05 µs", _explicit("musl", 5e-8)),
                    by_key["c-1e-2"]]


def name(radius, speed, treatment):
    return f"R{radius}-v{speed}-{treatment.key}"


def case(radius, speed, treatment, end=None):
    """`radius` in mm, `speed` in m/s."""
    wall = 1e-3 * radius
    return Case(name(radius, speed, treatment), "paper/reference.toml", {
        "title": f"R = {radius} mm, {speed} m/s, {treatment.label}",
        "body.0.box.max.0": wall, "boundary.0.box.min.0": wall, "boundary.0.box.max.0": round(wall + 0.1, 6),
        "body.1.velocity.1": -float(speed), "time.start": -gap / speed, "time.end": end or ends[radius],
        "integrator.max_growth": float("inf"), "output.every": output_interval,
        "output.fields": ["velocity", "damage", "decohesion", "opening_n", "opening_t", "effective_length", "normal_r", "normal_z"], **treatment.settings}, longest=1800.0)


def all_cases(quick):
    """(radius, speed, treatment) -> Case."""
    if quick:
        return {(200, v, t): case(200, v, t, 60e-6) for v in (200, 800) for t in quick_treatments}
    return {(r, v, t): case(r, v, t) for r in radii for v in speeds for t in treatments}
