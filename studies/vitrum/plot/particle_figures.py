"""Snapshots, and contours of damage and opening."""
import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch

from vitrum.plot import looks
from vitrum.plot.panels import Layout, Painting, at_times, colour_bar, draw_panels


def _everything(run):
    return np.ones(len(run.body), bool)


def _by_body(run, frame):
    """Bodies in their colours, what has separated of each in its own."""
    both = np.array([[to_rgba(looks.body_look(b, separated)) for separated in (False, True)] for b in range(len(run.bodies))])
    return Painting(both[run.body, frame.separated().astype(int)], _everything(run))


def _body_handles(panels):
    run = panels[0].run
    handles = [Patch(color=looks.body_look(b), label=f"{name} ({run.materials[b]})") for b, name in enumerate(run.bodies)]
    for b, name in enumerate(run.bodies):
        if any(np.any(panel.frame.separated() & (panel.run.body == b)) for panel in panels):
            handles.append(Patch(color=looks.body_look(b, separated=True), label=f"{name}, separated"))
    return handles


def snapshots(run, frames):
    """Bodies by colour, separated particles of each darker."""
    panels = at_times(run, frames)
    return draw_panels(panels, _by_body, _everything, Layout(), "Snapshots", _body_handles(panels))


def in_a_row(run, frames, view):
    """Snapshots of one part of the scene, all in one row: a picture as wide as a page and low."""
    panels = at_times(run, frames)
    return draw_panels(panels, _by_body, _everything, Layout(columns=len(panels)), "", _body_handles(panels), view)


def side_by_side(panels, what):
    """Snapshots of several runs of one scene, in the view of the first."""
    return draw_panels(panels, _by_body, _everything, Layout(columns=min(3, len(panels))), what, _body_handles(panels))


def _contours(run, frames, values_of, scale, what):
    """Panels of a field over time on a fixed scale; particles below it are pale, and the legend says so."""
    shown = np.isfinite(values_of(frames[-1]))
    norm = scale.norm

    def paint(_, frame):
        values = values_of(frame)
        colours = looks.worse(norm(np.maximum(np.nan_to_num(values), scale.bounds[0])))
        colours[~(values >= scale.bounds[0])] = to_rgba(looks.untouched)
        return Painting(colours, shown)

    layout = Layout(room_right=0.8)
    figure = draw_panels(at_times(run, frames), paint, lambda _: shown, layout, what, [Patch(color=looks.untouched, label=scale.below)])
    colour_bar(figure, scale, layout)
    return figure


def damage(run, frames):
    """Damage D of eq. 8; None when no material of the scene has it."""
    if run.frames[-1].field("damage") is None:
        return None
    return _contours(run, frames, lambda frame: frame.field("damage"), looks.damage_scale, "Damage")


def opening(run, frames):
    """Length of the opening vector, of the bodies that can be damaged where there are any; None when nothing has opened."""
    if run.frames[-1].opening() is None:
        return None
    brittle = run.frames[-1].field("damage")
    brittle = np.isfinite(brittle) if brittle is not None else _everything(run)

    def micrometres(frame):
        return np.where(brittle, 1e6 * frame.opening(), np.nan)

    if not any(np.any(micrometres(frame) > 0.0) for frame in frames):
        return None
    return _contours(run, frames, micrometres, looks.opening_scale(run.cell), "Opening of the decohesion planes")
