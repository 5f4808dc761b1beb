"""Panels: every output, or every run, as a close-up and, for slender bodies, as a strip of the whole length below it."""
import textwrap
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from vitrum.plot import views
from vitrum.plot.looks import page_width

# Inches. Panels are placed by hand so that both scales of every axis are exactly what the labels say.
left_margin, right_margin, column_gap = 0.55, 0.12, 0.34
row_gap, strip_gap = 0.44, 0.24
line = 0.17  # of a title or a legend


@dataclass
class Painting:
    """Colours of one frame's particles (N x 4), and which of them are drawn (N); segments (n x 2 x 2, m) over them with their colours and widths."""
    colours: np.ndarray
    shown: np.ndarray
    segments: np.ndarray = field(default_factory=lambda: np.empty((0, 2, 2)))
    segment_colours: np.ndarray = field(default_factory=lambda: np.empty((0, 4)))


@dataclass
class Panel:
    run: object
    frame: object
    title: str


@dataclass
class Layout:
    """How the panels of a figure are arranged; lengths in inches. Room on the right is for a colour bar."""
    columns: int = 2
    strip_height: float = 0.4
    room_right: float = 0.0

    @property
    def width(self):
        """Of a panel, so that the figure is as wide as a page."""
        return (page_width - left_margin - right_margin - self.room_right - (self.columns - 1) * column_gap) / self.columns


def at_times(run, frames):
    """A panel for each frame of a run."""
    return [Panel(run, frame, f"t = {1e6 * frame.time:.4g} µs".replace("-", "\u2212")) for frame in frames]


def _mirrored(points):
    """Points (n x m x 2) and their images beyond the axis."""
    return np.concatenate([points, points * [-1, 1]])


def _squares(run, frame, chosen):
    """Corners (n x 4 x 2, mm) of the chosen particles' squares, mirrored copies included."""
    half = 0.5 * run.side[chosen, None, None]
    corners = frame.position[chosen, None, :] + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    return 1e3 * (_mirrored(corners) if run.axisymmetric else corners)


def _draw(axes, run, frame, painting, view):
    corners = _squares(run, frame, painting.shown)
    colours = painting.colours[painting.shown]
    segments, segment_colours = 1e3 * painting.segments, painting.segment_colours
    if run.axisymmetric:
        colours = np.concatenate([colours, colours])
        segments, segment_colours = _mirrored(segments), np.concatenate([segment_colours, segment_colours])
    # The edge in the face's colour closes the hairlines between neighbours that have moved apart a little.
    axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.3, rasterized=True))
    if len(segments):
        axes.add_collection(LineCollection(segments, colors=segment_colours, linewidths=1.1, capstyle="round"))
    axes.set_xlim(1e3 * view.left, 1e3 * view.right)
    axes.set_ylim(1e3 * view.bottom, 1e3 * view.top)
    axes.tick_params(labelsize=7.5, length=2, pad=2)
    for spine in axes.spines.values():
        spine.set_linewidth(0.5)


def _strip_of(run, layout):
    """The strip's view and its height (inches) for a whole-number exaggeration."""
    view = views.strip(run)
    true_height = layout.width * view.height / view.width
    exaggeration = max(1, round(layout.strip_height / true_height))
    return view, true_height * exaggeration, exaggeration


def _title_lines(run, what, width):
    """The scene's title, folded to the figure's width (inches), above what the figure shows; none where a caption says both."""
    return [*textwrap.wrap(run.title, max(20, int(width / 0.085))), what] if what else []


def _legend_columns(handles, width):
    longest = max((len(handle.get_label()) for handle in handles), default=0)
    return max(1, min(len(handles), int(width / (0.5 + 0.068 * longest))))


def draw_panels(panels, paint, shown, layout, what, handles, view=None):
    """A figure with a panel each, titled by the first run's scene and `what`, with a legend of `handles` below. `paint(run, frame)` gives a Painting;
    `shown(run)` the particles that set the limits, which are those of the first run, unless `view` gives them."""
    run, frames = panels[0].run, [panel.frame for panel in panels if panel.run is panels[0].run]
    slender = view is None and views.is_slender(run)
    if view is None:
        view = views.close_up(run, frames, shown(run)) if slender else views.whole(run, frames, shown(run))
    height = layout.width * view.height / view.width
    panel_height = height
    if slender:
        strip, strip_height, exaggeration = _strip_of(run, layout)
        panel_height += strip_gap + strip_height
    columns = min(layout.columns, len(panels))
    rows = -(-len(panels) // columns)
    # A single panel leaves its neighbour's room to nobody, but titles and legends need a width to stand in.
    width = left_margin + columns * layout.width + (columns - 1) * column_gap + right_margin + layout.room_right
    lines = _title_lines(run, what, width)
    legend_columns = _legend_columns(handles, width)
    legend_rows = -(-len(handles) // legend_columns) if handles else 0
    top_margin, bottom_margin = 0.32 + line * len(lines), 0.5 + line * legend_rows
    size = (width, top_margin + rows * panel_height + (rows - 1) * row_gap + bottom_margin)
    figure = plt.figure(figsize=size)
    horizontal, vertical = ("r", "z") if run.axisymmetric else ("x", "y")

    def axes_at(column, top, tall):
        return figure.add_axes([(left_margin + column * (layout.width + column_gap)) / size[0], 1.0 - (top + tall) / size[1],
                                layout.width / size[0], tall / size[1]])

    for n, panel in enumerate(panels):
        row, column = divmod(n, columns)
        top = top_margin + row * (panel_height + row_gap)
        painting = paint(panel.run, panel.frame)
        axes = axes_at(column, top, height)
        _draw(axes, panel.run, panel.frame, painting, view)
        axes.set_title(panel.title, fontsize=8.5, loc="left", pad=3)
        if column == 0:
            axes.set_ylabel(f"{vertical} (mm)", fontsize=8)
        if slender:
            axes = axes_at(column, top + height + strip_gap, strip_height)
            _draw(axes, panel.run, panel.frame, painting, strip)
            stretched = f", {vertical} stretched {exaggeration} ×" if exaggeration > 1 else ""
            axes.text(0.01, 0.04, f"whole {run.bodies[views.focus_body(run)]}{stretched}", transform=axes.transAxes, fontsize=6.5)
            if column == 0:
                axes.set_ylabel(f"{vertical} (mm)", fontsize=8)
        if n + columns >= len(panels):
            axes.set_xlabel(f"{horizontal} (mm)", fontsize=8)
    figure.align_ylabels()
    figure.suptitle("\n".join(lines), fontsize=9.5, y=1.0 - 0.06 / size[1], va="top")
    if handles:
        figure.legend(handles=handles, loc="lower center", ncol=legend_columns, fontsize=8, frameon=False, borderaxespad=0.3, handlelength=1.4, columnspacing=1.4)
    return figure


def colour_bar(figure, scale, layout):
    """In the room that the layout leaves on the right."""
    width, height = figure.get_size_inches()
    tall = min(height - 1.4, 4.0)
    axes = figure.add_axes([1.0 - layout.room_right / width, 0.5 - 0.5 * tall / height, 0.14 / width, tall / height])
    bar = figure.colorbar(scale.mapping, cax=axes, ticks=scale.bounds, spacing="uniform")
    bar.ax.set_yticklabels([f"{bound:,g}" for bound in scale.bounds])
    bar.ax.minorticks_off()
    bar.set_label(scale.label, fontsize=8.5)
    axes.tick_params(labelsize=7.5)
