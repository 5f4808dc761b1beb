"""Panels over time: every output as a close-up and, for slender bodies, as a strip of the whole length below it."""
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from plotting import views

# Inches. Panels are placed by hand so that both scales of every axis are exactly what the labels say.
left_margin, right_margin, column_gap = 0.62, 0.15, 0.38
top_margin, bottom_margin, row_gap, strip_gap = 0.72, 0.72, 0.42, 0.24


@dataclass
class Painting:
    """Colours of one frame's particles (N x 4), and which of them are drawn (N)."""
    colours: np.ndarray
    shown: np.ndarray


@dataclass
class Layout:
    """How the panels of a figure are arranged; lengths in inches. Room on the right is for a colour bar."""
    columns: int
    width: float
    strip_height: float
    room_right: float = 0.0


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
    # The edge in the face's colour closes the hairlines between neighbours that have moved apart a little.
    axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.4, rasterized=True))
    axes.set_xlim(1e3 * view.left, 1e3 * view.right)
    axes.set_ylim(1e3 * view.bottom, 1e3 * view.top)
    axes.tick_params(labelsize=7, length=2, pad=2)
    for spine in axes.spines.values():
        spine.set_linewidth(0.5)


def _strip_of(run, layout):
    """The strip's view and its height (inches) for a whole-number exaggeration."""
    view = views.strip(run)
    true_height = layout.width * view.height / view.width
    exaggeration = max(1, round(layout.strip_height / true_height))
    return view, true_height * exaggeration, exaggeration


def draw_panels(run, frames, paint, shown, layout):
    """A figure with a panel per frame; `paint(frame)` gives its Painting, `shown` the particles that set the limits."""
    slender = views.is_slender(run)
    view = views.close_up(run, frames, shown) if slender else views.whole(run, frames, shown)
    height = layout.width * view.height / view.width
    panel_height = height
    if slender:
        strip, strip_height, exaggeration = _strip_of(run, layout)
        panel_height += strip_gap + strip_height
    # Four panels are two rows of two, not three and a last one.
    columns = 2 if len(frames) == 4 else min(layout.columns, len(frames))
    rows = -(-len(frames) // columns)
    size = (left_margin + columns * layout.width + (columns - 1) * column_gap + right_margin + layout.room_right,
            top_margin + rows * panel_height + (rows - 1) * row_gap + bottom_margin)
    figure = plt.figure(figsize=size)
    horizontal, vertical = ("r", "z") if run.axisymmetric else ("x", "y")

    def axes_at(column, top, tall):
        return figure.add_axes([(left_margin + column * (layout.width + column_gap)) / size[0], 1.0 - (top + tall) / size[1],
                                layout.width / size[0], tall / size[1]])

    for n, frame in enumerate(frames):
        row, column = divmod(n, columns)
        top = top_margin + row * (panel_height + row_gap)
        painting = paint(frame)
        axes = axes_at(column, top, height)
        _draw(axes, run, frame, painting, view)
        axes.set_title(f"t = {1e6 * frame.time:.4g} µs".replace("-", "\u2212"), fontsize=9, loc="left", pad=3)
        if column == 0:
            axes.set_ylabel(f"{vertical} (mm)", fontsize=8)
        if slender:
            axes = axes_at(column, top + height + strip_gap, strip_height)
            _draw(axes, run, frame, painting, strip)
            stretched = f", {vertical} stretched {exaggeration} ×" if exaggeration > 1 else ""
            axes.text(0.01, 0.05, f"whole {run.bodies[views.focus_body(run)]}{stretched}",
                      transform=axes.transAxes, fontsize=6.5)
            if column == 0:
                axes.set_ylabel(f"{vertical} (mm)", fontsize=8)
        if n + columns >= len(frames):
            axes.set_xlabel(f"{horizontal} (mm)", fontsize=8)
    figure.align_ylabels()
    return figure


def title(figure, run, what):
    text = f"{run.title}\n{what}" if run.title else what
    figure.suptitle(text, fontsize=10, y=1.0 - 0.1 / figure.get_figheight(), va="top")


def legend_below(figure, handles):
    figure.legend(handles=handles, loc="lower center", ncol=len(handles), fontsize=8, frameon=False, borderaxespad=0.3)


def colour_bar(figure, mapping, label, layout):
    """In the room that the layout leaves on the right."""
    width, height = figure.get_size_inches()
    tall = min(height - top_margin - bottom_margin, 5.0)
    axes = figure.add_axes([1.0 - layout.room_right / width, 0.5 - 0.5 * tall / height, 0.16 / width, tall / height])
    bar = figure.colorbar(mapping, cax=axes)
    bar.set_label(label, fontsize=9)
    axes.tick_params(labelsize=8)
