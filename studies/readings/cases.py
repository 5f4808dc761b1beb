"""The runs: readings by ways of integrating, each on three of the paper's cases."""
import itertools
import tomllib
from dataclasses import dataclass

from study.case import Case, studies

from readings.design import covering_array
from readings.factors import counts, factors, full, settings_of

amplitude = 0.02  # cells, by which members of an ensemble differ
shown = ((200, 200), (200, 800), (400, 200))  # cases (R in mm, v in m/s), of which 21 statements speak
rows_of_design = 64  # pairs need 25; an effect that explains a quarter of a verdict is more than chance among some 300 from 60 on


@dataclass(frozen=True)
class Integration:
    key: str
    label: str
    settings: tuple
    resolved: bool


def _explicit(scheme, step):
    return (("integrator.method", "explicit"), ("integrator.scheme", scheme), ("integrator.step", step))


usf, musl, resolved, adaptive = integrations = [
    Integration("usf", "USF 0.2 µs", _explicit("usf", 2e-7), False), Integration("musl", "MUSL 0.2 µs", _explicit("musl", 2e-7), False),
    Integration("resolved", "MUSL 0.05 µs", _explicit("musl", 4.93e-8), True),
    Integration("adaptive", "ERK 3, rtol 1e-2", (("integrator.method", "arkode-explicit"), ("integrator.order", 3), ("integrator.rtol", 1e-2)), True)]
fine = Integration("fine", "MUSL 0.025 µs, cells of 0.5 mm", (*_explicit("musl", 2.47e-8), ("space.cell", 5e-4)), True)


@dataclass(frozen=True)
class Point:
    """One reading under one integration: `part` tells what it is for, `member` 0 is unperturbed."""
    part: str
    row: tuple
    integration: Integration
    member: int = 0

    @property
    def name(self):
        return f"{self.part}-{''.join(map(str, self.row))}-{self.integration.key}-{self.member}"


def _single():
    """Each other level of each factor alone."""
    for factor, count in enumerate(counts):
        for level in range(1, count):
            yield tuple(level if n == factor else 0 for n in range(len(counts)))


def _factorial(keys):
    places = [n for n, factor in enumerate(factors) if factor.key in keys]
    for levels in itertools.product(*(range(counts[n]) for n in places)):
        row = [0] * len(counts)
        for place, level in zip(places, levels):
            row[place] = level
        yield tuple(row)


def _row(**levels):
    return tuple(levels.get(factor.key, 0) for factor in factors)


reference = _row()
# Readings that are judged as ensembles: the reference, what the first scan found to reproduce most with a resolved step, and the stronger glass.
ensembles = [reference, _row(strain=1, rate=1, dilation=1), _row(k=1)]


def points(quick):
    """Every point, each once."""
    design = covering_array(counts, rows_of_design)
    if quick:
        return [Point("design", row, way) for row in design[:5] for way in (musl, resolved)] + [Point("member", design[n], resolved, 1) for n in (0, 1)]
    every = [Point("design", row, way) for row in design for way in integrations]
    every += [Point("member", row, resolved, 1) for row in design]  # what one ring is worth
    every += [Point("single", row, resolved) for row in _single()]
    every += [Point("full", row, resolved) for row in _factorial(full)]
    every += [Point("ensemble", row, resolved, member) for row in ensembles for member in range(1, 7)]
    every += [Point("cell", row, fine) for row in design[:6]]
    return every


def _case(radius, speed):
    """Settings of the study of the paper for one of its cases (R in mm, v in m/s)."""
    file = tomllib.loads((studies / "paper/study.toml").read_text(encoding="utf-8"))
    return {**file["set"], "parameters.R": 1e-3 * radius, "parameters.v": float(speed), "output.fields": ["damage", "decohesion", "opening_n", "opening_t"]}


def cases_of(point, quick):
    """(R, v) -> Case of the runs of a point. Shorter ones where it is quick."""
    made = {}
    for radius, speed in shown[:2] if quick else shown:
        settings = {**_case(radius, speed), **dict(point.integration.settings), **settings_of(point.row)}
        if quick:
            settings["time.end"] = 40e-6
        if point.member:
            settings |= {f"body.{n}.perturbation": {"amplitude": amplitude, "seed": 1000 * n + point.member} for n in (0, 1)}
        made[radius, speed] = Case(f"{point.name}/R{radius}-v{speed}", "paper/reference.toml", settings, longest=900.0)
    return made
