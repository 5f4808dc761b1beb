"""Snapshots and contours: particles as squares, panels over time."""
from dataclasses import dataclass

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm, Normalize
from matplotlib.patches import Patch

from plotting import views

# Okabe and Ito's colours, told apart by all kinds of colour vision.
body_colours = ["#56B4E9", "#999999", "#E69F00", "#CC79A7", "#009E73", "#F0E442"]
separated_colour = "#D55E00"
untouched_colour = "#E4E4E4"
edge_colour = "#404040"


@dataclass
class Painting:
    """Colours of one frame's particles (N x 4), and which of them are drawn (N)."""
    colours: np.ndarray
    shown: np.ndarray


def _squares(run, frame, chosen):
    """Corners (n x 4 x 2, mm) of the chosen particles' squares, mirrored copies included."""
    half = 0.5 * run.side[chosen, None, None]
    corners = frame.position[chosen, None, :] + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    if run.axisymmetric:
        corners = np.concatenate([corners, corners * [-1, 1]])
    return 1e3 * corners


def _draw(axes, run, frame, painting, view):
    corners = _squares(run, frame, painting.shown)
    colours = painting.colours[painting.shown]
    if run.axisymmetric:
        colours = np.concatenate([colours, colours])
    # The thin edge in the face's colour closes the hairlines between neighbours.
    axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.15, rasterized=True))
    axes.set_xlim(1e3 * view.left, 1e3 * view.right)
    axes.set_ylim(1e3 * view.bottom, 1e3 * view.top)
    axes.set_aspect(view.exaggeration)
    axes.tick_params(labelsize=7, length=2)
    for spine in axes.spines.values():
        spine.set_linewidth(0.5)


def _panels(run, frames, paint, shown, columns):
    """A figure with a close-up per frame and, for slender bodies, the whole body in a strip below each."""
    slender = views.is_slender(run)
    view = views.close_up(run, frames, shown) if slender else views.whole(run, frames, shown)
    rows = -(-len(frames) // columns)
    panel_width = 9.6 / columns
    panel_height = min(panel_width * view.height / view.width, 1.3 * panel_width)
    strip_height = 0.42
    figure = plt.figure(figsize=(10.4, rows * (panel_height + (strip_height + 0.75 if slender else 0.45)) + 1.0),
                        layout="constrained")
    horizontal, vertical = ("r", "z") if run.axisymmetric else ("x", "y")
    grid = figure.add_gridspec(rows, columns)
    for n, frame in enumerate(frames):
        painting = paint(frame)
        cell = grid[n // columns, n % columns].subgridspec(2 if slender else 1, 1,
                                                         height_ratios=[panel_height, strip_height] if slender else None)
        axes = figure.add_subplot(cell[0])
        _draw(axes, run, frame, painting, view)
        axes.set_title(f"t = {1e6 * frame.time:.4g} µs", fontsize=9, loc="left", pad=3)
        if n % columns == 0:
            axes.set_ylabel(f"{vertical} (mm)", fontsize=8)
        below = axes
        if slender:
            below = figure.add_subplot(cell[1])
            outline = views.strip(run, frames, shown, 1.0)
            outline.exaggeration = max(1.0, round(strip_height / panel_width * outline.width / outline.height))
            _draw(below, run, frame, painting, outline)
            if n % columns == 0:
                below.set_ylabel(f"{vertical} (mm)\n× {outline.exaggeration:g}", fontsize=8)
        if n + columns >= len(frames):
            below.set_xlabel(f"{horizontal} (mm)", fontsize=8)
    return figure


def _title(figure, run, what):
    figure.suptitle(f"{run.title}\n{what}" if run.title else what, fontsize=10)


def snapshots(run, frames):
    """Bodies by colour, separated particles marked."""
    everything = np.ones(len(run.body), bool)
    base = np.array([matplotlib.colors.to_rgba(body_colours[b % len(body_colours)]) for b in range(len(run.bodies))])

    def paint(frame):
        colours = base[run.body].copy()
        colours[frame.separated()] = matplotlib.colors.to_rgba(separated_colour)
        return Painting(colours, everything)

    figure = _panels(run, frames, paint, everything, columns=3)
    _title(figure, run, "Snapshots")
    handles = [Patch(color=base[b], label=f"{name} ({run.materials[b]})") for b, name in enumerate(run.bodies)]
    if any(np.any(frame.separated()) for frame in frames):
        handles.append(Patch(color=separated_colour, label="separated particle"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), fontsize=8, frameon=False)
    return figure


def _contours(run, frames, values_of, norm, label, untouched):
    """Panels of a field over time; `untouched` names the particles below the scale, drawn grey."""
    shown = np.isfinite(values_of(frames[-1]))
    mapping = matplotlib.cm.ScalarMappable(norm, "viridis")

    def paint(frame):
        values = values_of(frame)
        colours = mapping.to_rgba(np.nan_to_num(values))
        colours[~(values >= norm.vmin)] = matplotlib.colors.to_rgba(untouched_colour)
        return Painting(colours, shown)

    figure = _panels(run, frames, paint, shown, columns=2)
    bar = figure.colorbar(mapping, ax=figure.axes, shrink=0.7, aspect=35, pad=0.02)
    bar.set_label(label, fontsize=9)
    bar.ax.tick_params(labelsize=8)
    figure.legend(handles=[Patch(color=untouched_colour, label=untouched)], loc="outside lower center", fontsize=8,
                  frameon=False)
    return figure


def damage(run, frames):
    """Damage D of eq. 8; None when no material of the scene has it."""
    if run.frames[-1].field("damage") is None:
        return None
    threshold = 1e-3
    largest = max(float(np.nanmax(frame.field("damage"))) for frame in frames)
    norm = Normalize(threshold, max(largest, 10.0 * threshold))
    figure = _contours(run, frames, lambda frame: frame.field("damage"), norm, "damage D (–)", f"D < {threshold:g}")
    _title(figure, run, "Damage")
    return figure


def opening(run, frames):
    """Length of the opening vector of the bodies that can also be damaged (all, when none can); None without decohesion."""
    if run.frames[-1].opening() is None:
        return None
    brittle = run.frames[-1].field("damage")
    brittle = np.isfinite(brittle) if brittle is not None else np.ones(len(run.body), bool)

    def values(frame):
        return np.where(brittle, frame.opening(), np.nan)

    positive = np.concatenate([values(frame) for frame in frames])
    positive = positive[positive > 0.0] * 1e6
    if not positive.size:
        return None
    # Three decades below the largest: smaller openings cannot be told from closed ones anyway.
    top = 10.0 ** np.ceil(np.log10(np.quantile(positive, 0.999)))
    norm = LogNorm(top * 1e-4, top)
    figure = _contours(run, frames, lambda frame: 1e6 * values(frame), norm, "opening |u| (µm)",
                       f"no opening above {norm.vmin:g} µm")
    _title(figure, run, "Opening of the decohesion planes")
    return figure
