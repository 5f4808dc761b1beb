"""Pictures of a run: each function gives a matplotlib figure, or None where the run has nothing of what it shows.

`times` (s) choose the outputs nearest to them; six spread over the run when none is given.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

if TYPE_CHECKING:
    from vitrum.results import Run

Times = Sequence[float] | None


def snapshots(run: Run, times: Times = None) -> Any:
    """Bodies in their colours, what has separated of each darker."""
    from vitrum.plot.particle_figures import snapshots as draw
    return draw(run, run.frames_at(times)) if run.frames else None


def damage(run: Run, times: Times = None) -> Any:
    """Damage D of eq. 8."""
    from vitrum.plot.particle_figures import damage as draw
    return draw(run, run.frames_at(times)) if run.frames else None


def opening(run: Run, times: Times = None) -> Any:
    """Length of the opening vector of the decohesion planes."""
    from vitrum.plot.particle_figures import opening as draw
    return draw(run, run.frames_at(times)) if run.frames else None


def cracks(run: Run, times: Times = None) -> Any:
    """Decohesion planes as segments."""
    from vitrum.plot.crack_figures import cracks as draw
    return draw(run, run.frames_at(times)) if run.frames else None


def fragments(run: Run, times: Times = None) -> Any:
    """Connected pieces in colours."""
    from vitrum.plot.crack_figures import fragments as draw
    return draw(run, run.frames_at(times)) if run.frames else None


def fragment_masses(run: Run, times: Times = None) -> Any:
    """How many pieces are heavier than a mass at the last time, and where the mass is over time."""
    from vitrum.plot.crack_figures import fragment_masses as draw
    return draw(run, run.frames_at(times)) if run.frames else None


def failure(run: Run) -> Any:
    """Localised and separated particles over time, and how far out."""
    from vitrum.plot.history_figure import failure_history
    return failure_history(run)


def energy(run: Run) -> Any:
    """The energy account over time."""
    from vitrum.plot.energy_figure import energy_history
    return energy_history(run)


# All of them, and why one may be missing.
of_particles = {snapshots: "", damage: "no material of the scene is damaged", opening: "nothing has opened at these times",
                cracks: "the outputs hold no planes (effective_length, normal_r, normal_z)", fragments: "the outputs do not tell what has separated (decohesion)",
                fragment_masses: "the outputs do not tell what has separated (decohesion)"}
over_time = {failure: "nothing of the scene can fail", energy: ""}
