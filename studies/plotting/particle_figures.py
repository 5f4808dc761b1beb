"""Snapshots, and contours of damage and opening."""
import matplotlib
import numpy as np
from matplotlib.colors import LogNorm, Normalize, to_rgba
from matplotlib.patches import Patch

from plotting.panels import Layout, Painting, colour_bar, draw_panels, legend_below, title

# Okabe and Ito's colours, told apart by all kinds of colour vision.
body_colours = ["#56B4E9", "#999999", "#E69F00", "#CC79A7", "#009E73", "#F0E442"]
separated_colour = "#D55E00"
untouched_colour = "#DDDDDD"
damage_threshold = 1e-3
opening_decades = 4


def snapshots(run, frames):
    """Bodies by colour, separated particles marked."""
    everything = np.ones(len(run.body), bool)
    base = np.array([to_rgba(body_colours[b % len(body_colours)]) for b in range(len(run.bodies))])

    def paint(frame):
        colours = base[run.body]
        colours[frame.separated()] = to_rgba(separated_colour)
        return Painting(colours, everything)

    figure = draw_panels(run, frames, paint, everything, Layout(columns=3, width=3.1, strip_height=0.36))
    title(figure, run, "Snapshots")
    handles = [Patch(color=base[b], label=f"{name} ({run.materials[b]})") for b, name in enumerate(run.bodies)]
    if any(np.any(frame.separated()) for frame in frames):
        handles.append(Patch(color=separated_colour, label="separated particle"))
    legend_below(figure, handles)
    return figure


def _contours(run, frames, values_of, norm, label, untouched):
    """Panels of a field over time; particles below the scale are grey, and `untouched` says what they are."""
    shown = np.isfinite(values_of(frames[-1]))
    mapping = matplotlib.cm.ScalarMappable(norm, "viridis")

    def paint(frame):
        values = values_of(frame)
        colours = mapping.to_rgba(np.maximum(np.nan_to_num(values), norm.vmin))
        colours[~(values >= norm.vmin)] = to_rgba(untouched_colour)
        return Painting(colours, shown)

    layout = Layout(columns=2, width=4.3, strip_height=0.5, room_right=0.85)
    figure = draw_panels(run, frames, paint, shown, layout)
    colour_bar(figure, mapping, label, layout)
    legend_below(figure, [Patch(color=untouched_colour, label=untouched)])
    return figure


def damage(run, frames):
    """Damage D of eq. 8; None when no material of the scene has it."""
    if run.frames[-1].field("damage") is None:
        return None
    largest = max(float(np.nanmax(frame.field("damage"))) for frame in frames)
    norm = Normalize(damage_threshold, max(largest, 10.0 * damage_threshold))
    figure = _contours(run, frames, lambda frame: frame.field("damage"), norm, "damage D (–)", f"D < {damage_threshold:g}")
    title(figure, run, "Damage")
    return figure


def opening(run, frames):
    """Length of the opening vector, of the bodies that can be damaged where there are any; None when nothing has opened."""
    if run.frames[-1].opening() is None:
        return None
    brittle = run.frames[-1].field("damage")
    brittle = np.isfinite(brittle) if brittle is not None else np.ones(len(run.body), bool)

    def micrometres(frame):
        return np.where(brittle, 1e6 * frame.opening(), np.nan)

    values = np.concatenate([micrometres(frame) for frame in frames])
    values = values[values > 0.0]
    if not values.size:
        return None
    # A few particles that fly apart shall not set the scale.
    top = 10.0 ** np.ceil(np.log10(np.quantile(values, 0.999)))
    norm = LogNorm(top * 10.0**-opening_decades, top)
    figure = _contours(run, frames, micrometres, norm, "opening |u| (µm)", f"closed, or opening below {norm.vmin:g} µm")
    title(figure, run, "Opening of the decohesion planes")
    return figure
