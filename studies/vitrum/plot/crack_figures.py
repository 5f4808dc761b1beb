"""What has come apart: cracks as segments along their planes, fragments in colours, and how their masses are distributed."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from vitrum.plot import looks, views
from vitrum.plot.panels import Layout, Painting, at_times, draw_panels
from vitrum.plot.pieces import piece_masses, pieces

opening_crack, open_crack, hoop_crack = "#0072B2", "#D55E00", "#1A1A1A"
dust = "#6E6E6E"


def cracks(run, frames):
    """A segment of a particle's length along the plane of each; planes across the hoop direction as dots. None: no planes are known."""
    if run.frames[-1].plane() is None:
        return None

    def paint(run, frame):
        localised, normal = frame.plane()
        hoop = localised & ~np.any(normal, axis=1)
        planes = localised & ~hoop
        along = np.column_stack([-normal[:, 1], normal[:, 0]]) * 0.5 * run.side[:, None]
        along[hoop] = [1e-3 * run.cell, 0.0]
        ends = np.stack([frame.position - along, frame.position + along], axis=1)
        colours = np.array([to_rgba(opening_crack), to_rgba(open_crack), to_rgba(hoop_crack)])
        kind = np.where(hoop, 2, frame.separated().astype(int))
        base = np.array([to_rgba(looks.untouched if b == 0 else "#F1F1F1") for b in range(len(run.bodies))])
        chosen = planes | hoop
        return Painting(base[run.body], np.ones(len(run.body), bool), ends[chosen], colours[kind[chosen]])

    handles = [Line2D([], [], color=open_crack, label="crack plane, separated"), Line2D([], [], color=opening_crack, label="crack plane, still bearing"),
               Line2D([], [], color=hoop_crack, linestyle="", marker=".", markersize=4, label="plane across the hoop direction")]
    if not any(np.any(frame.plane()[0] & ~np.any(frame.plane()[1], axis=1)) for frame in frames):
        handles.pop()
    return draw_panels(at_times(run, frames), paint, lambda run: np.ones(len(run.body), bool), Layout(), "Cracks", handles, views.broken(run, frames))


def fragments(run, frames):
    """The heaviest piece of each body in the body's colour, other pieces in colours of their own, separated particles grey. None: nothing can separate."""
    if run.frames[-1].field("decohesion") is None:
        return None

    def paint(run, frame):
        found = pieces(run, frame)
        colours = np.tile(to_rgba(dust), (len(found), 1))
        heaviest = {body: found[(run.body == body) & (found >= 0)].min(initial=len(found)) for body in range(len(run.bodies))}
        turn = 0
        for piece in np.unique(found[found >= 0]):
            of = found == piece
            body = run.body[of][0]
            if piece == heaviest[body]:
                colours[of] = to_rgba(looks.body_look(body))
            else:
                colours[of] = to_rgba(looks.piece_colours[turn % len(looks.piece_colours)])
                turn += 1
        return Painting(colours, np.ones(len(found), bool))

    handles = [Patch(color=looks.body_look(body), label=f"{name}, heaviest piece") for body, name in enumerate(run.bodies)]
    handles += [Patch(color=looks.piece_colours[0], label="other pieces, each its colour"), Patch(color=dust, label="separated particle")]
    return draw_panels(at_times(run, frames), paint, lambda run: np.ones(len(run.body), bool), Layout(), "Fragments", handles, views.broken(run, frames))


def fragment_masses(run, frames):
    """How many pieces of each body are heavier than a mass, over time; and where its mass is. None: nothing can separate."""
    if run.frames[-1].field("decohesion") is None:
        return None
    unit, scale = ("g", 1e3) if run.axisymmetric else ("kg/m", 1.0)
    figure, (counts, shares) = plt.subplots(1, 2, figsize=(looks.page_width, 3.3), layout="constrained")
    dashes = ["-", "--", "-.", ":"]
    last = piece_masses(run, frames[-1])
    for body, name in enumerate(run.bodies):
        masses = np.array(last[body])
        if masses.size:
            steps = np.concatenate([[0.5 * masses.min()], masses[::-1]])
            counts.step(scale * steps, np.concatenate([[len(masses)], np.arange(len(masses), 0, -1)]), where="pre", color=looks.body_look(body, True),
                        linestyle=dashes[body % 4], label=f"{name}: {len(masses)}")
    counts.set_xscale("log")
    counts.set_yscale("log")
    counts.set_xlabel(f"mass ({unit})", fontsize=8.5)
    counts.set_ylabel("pieces at least as heavy", fontsize=8.5)
    counts.set_title(f"Pieces at t = {1e6 * frames[-1].time:.4g} µs".replace("-", "\u2212"), fontsize=9)
    most = max(len(masses) for masses in last.values())
    counts.set_ylim(0.8, 2.0 * most)
    counts.set_yticks([tick for decade in (1, 10, 100, 1000) for tick in (decade, 2 * decade, 5 * decade) if tick <= 2 * most])
    counts.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
    counts.minorticks_off()
    counts.legend(fontsize=8, frameon=False)
    time = np.array([1e6 * frame.time for frame in run.frames])
    for body, name in enumerate(run.bodies):
        total = run.mass[run.body == body].sum()
        loose = np.array([run.mass[(run.body == body) & frame.separated()].sum() for frame in run.frames])
        off = np.array([sum(piece_masses(run, frame)[body][1:]) for frame in run.frames])
        colour = looks.body_look(body, True)
        shares.plot(time, 100.0 * loose / total, color=colour, linestyle=dashes[body % 4], linewidth=1.6, label=f"{name}: separated particles")
        shares.plot(time, 100.0 * off / total, color=colour, linestyle=dashes[body % 4], linewidth=0.9, marker=".", markersize=3, label=f"{name}: pieces but the heaviest")
    shares.set_xlabel("time (µs)", fontsize=8.5)
    shares.set_ylabel("share of the body's mass (%)", fontsize=8.5)
    shares.set_title("Where the mass is", fontsize=9)
    shares.set_ylim(bottom=0.0)
    shares.legend(fontsize=7.5, frameon=False)
    for axes in (counts, shares):
        axes.tick_params(labelsize=7.5)
        axes.grid(True, linewidth=0.3, color="#CCCCCC")
    figure.suptitle(run.title, fontsize=9.5)
    return figure
