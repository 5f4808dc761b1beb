"""Largest stable step of a row at rest: measured by bisection, and by theory."""
import tomllib
from dataclasses import dataclass

from study.case import Case, studies
from study.outcome import run

from stability.theory import resting_limit

_scene = tomllib.loads((studies / "stability/row.toml").read_text())
_steel = _scene["material"]["steel"]
cell = _scene["space"]["cell"]  # m
# Of pressure waves, m/s.
wave_speed = (_steel["young"] * (1.0 - _steel["poisson"]) / (_steel["density"] * (1.0 + _steel["poisson"]) * (1.0 - 2.0 * _steel["poisson"]))) ** 0.5
time_unit = cell / wave_speed  # s
length = 40  # cells
steps = 600
unstable_growth = 50.0  # of energy: what a stable row does not reach, and an unstable one passes within its steps


@dataclass(frozen=True)
class Point:
    """`offset`: of the particles, in particle spacings from the cell's (or its part's) edge."""
    scheme: str
    shape: str
    per_side: int
    offset: float

    @property
    def name(self):
        return f"rest-{self.scheme}-{self.shape}-{self.per_side**2}-{self.offset:g}"


def resting_case(point, dt):
    """A row at rest that is disturbed a little; `dt` in cells over wave speed."""
    shift = cell * (point.offset - 0.5) / point.per_side
    return Case(f"{point.name}/{dt:.5f}", "stability/row.toml", {
        "space.shape_functions": point.shape, "integrator.scheme": point.scheme, "integrator.step": dt * time_unit,
        "integrator.max_growth": unstable_growth, "time.end": steps * dt * time_unit, "body.0.particles_per_cell": point.per_side**2,
        "body.0.box.min.0": shift, "body.0.box.max.0": length * cell + shift}, fields=False)


def measured_limit(point, guess, runs, precision=0.002):
    """Bisection on runs, from a bracket about `guess` that widens until it holds the limit."""
    def stable(dt):
        return run(resting_case(point, dt), runs).complete

    low, high = 0.98 * guess, 1.02 * guess
    while not stable(low):
        low, high = 0.8 * low, low
    while stable(high):
        low, high = high, 1.25 * high
    while high / low > 1.0 + precision:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if stable(middle) else (low, middle)
    return (low * high) ** 0.5


def points(quick):
    if quick:
        return [Point(scheme, "linear", 1, offset) for scheme in ("usf", "usl", "musl") for offset in (0.5, 0.1)]
    return [Point(scheme, shape, per_side, offset) for scheme in ("usf", "musl", "usl") for shape in ("linear", "gimp", "bspline2")
            for per_side in (1, 2, 3) for offset in (0.5, 0.25, 0.1, 0.03, 0.01)]


def row(point, runs):
    theory = resting_limit(point.scheme, point.shape, point.per_side, point.offset)
    measured = measured_limit(point, theory, runs)
    return {"scheme": point.scheme, "shape": point.shape, "particles_per_cell": point.per_side**2, "offset": point.offset,
            "theory": theory, "measured": measured, "deviation": measured / theory - 1.0}
