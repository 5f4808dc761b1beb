"""KLU against GMRES in implicit steps of the bar: what each takes, and the share of it that factors take."""
import statistics

import runs
from roofline import median
from tables import percent, table

kinds = {"klu": [], "gmres": ['integrator.linear_solver="gmres"', 'integrator.preconditioner="diagonal"']}


class Size:
    """The bar with so many thousand particles: particles, steps, factorisations, entries of the factors, seconds by kind of solver, and KLU's share."""

    def __init__(self, measured, benchmarks, thousands):
        self.particles, self.steps = measured["klu"][0]["particles"], measured["klu"][0]["steps"]
        self.factorisations, self.entries = (measured["klu"][0]["integrator"][key] for key in ("factorisations", "factor_entries"))
        self.seconds = {kind: statistics.median(run["seconds"] for run in measured[kind]) for kind in kinds}
        factor, solve = (self.particles / median(benchmarks[f"klu_{part}/thousand:{thousands}"], "items_per_second") for part in ("factor", "solve"))
        solved = measured["klu"][0]["integrator"]["newton_iterations"]
        self.share = (self.factorisations * factor + solved * solve) / self.seconds["klu"]


def measure(program, benchmarks, repetitions, quick):
    """Sizes from small to large; every repetition runs both kinds in turn. Factors and substitutions are timed by the benchmarks and counted by the runs."""
    cells = {1: 0.625e-3, 5: 0.3125e-3} if quick else {1: 0.625e-3, 5: 0.3125e-3, 20: 0.15625e-3, 80: 0.078125e-3}
    steps = {1: 1200, 5: 1200, 20: 400, 80: 160}
    sizes = []
    for thousands, cell in cells.items():
        settings = runs.adaptive_settings("arkode-implicit", cell, 40 if quick else steps[thousands])
        measured = {kind: [] for kind in kinds}
        for _ in range(repetitions if thousands < 80 else min(repetitions, 3)):
            for kind, more in kinds.items():
                measured[kind].append(runs.once(program, runs.Case(kind, runs.bar, settings + more)))
        sizes.append(Size(measured, benchmarks, thousands))
    return sizes


def rows(sizes):
    return table(["particles", "steps, factorisations", "entries of the factors, million", "KLU's share", "with KLU, s", "with GMRES, s"],
                 [(f"{s.particles:,}", f"{s.steps}, {s.factorisations}", f"{1e-6 * s.entries:.2g}", percent(s.share),
                   f"{s.seconds['klu']:.2g}", f"{s.seconds['gmres']:.2g}") for s in sizes])
