#!/usr/bin/env python3
"""The reference case with the paper's explicit step and with adaptive steps, side by side over time: docs/pictures/explicit-against-adaptive.gif of README.md.

    VITRUM=build/release/src/app/vitrum PYTHONPATH=studies docs/pictures/animation.py        (a minute of computing)"""
import pathlib

import numpy as np
import vitrum
from look import blue, orange, plt
from matplotlib.animation import FuncAnimation, PillowWriter

root = pathlib.Path(__file__).resolve().parents[2]
ways = {
    "explicit, 0.2 µs (the paper's step)": {"integrator.step": 2e-7},
    "adaptive, tolerance 0.01": {"integrator.method": "arkode-explicit", "integrator.rtol": 1e-2, "constitutive.method": "substep"},
}
colours = {"plate": ("#9ecae9", "#D55E00"), "cylinder": ("#bbbbbb", "#222222")}  # whole, separated


def squares(axes, run, frame):
    """Every particle of both halves, in points; separated ones over the others."""
    position = 1e3 * frame["position"]
    separated = frame["decohesion"] >= 1.0
    for number, body in enumerate(run.bodies):
        for broken in (False, True):
            chosen = (run.body == number) & (separated == broken)
            r, z = position[chosen].T
            axes.scatter(np.concatenate([r, -r]), np.concatenate([z, z]), s=1.6, marker="s", linewidths=0, color=colours[body][broken])


def draw():
    runs = {name: vitrum.run(root / "studies/paper/reference.toml", {"output.every": 3e-6, "time.end": 150e-6} | way, threads=1) for name, way in ways.items()}
    count = min(len(run.frames) for run in runs.values())
    figure = plt.figure(figsize=(7.2, 4.4), dpi=90, layout="constrained")
    grid = figure.add_gridspec(2, 2, height_ratios=(2.2, 1))
    views, below = [figure.add_subplot(grid[0, column]) for column in (0, 1)], figure.add_subplot(grid[1, :])

    def show(n):
        below.clear()
        for axes, (name, run), colour in zip(views, runs.items(), (orange, blue)):
            axes.clear()
            squares(axes, run, run.frames[n])
            axes.set(xlim=(-75, 75), ylim=(-45, 65), aspect="equal", title=name)
            axes.axis("off")
            energy, now = run.columns("energy"), run.frames[n].time
            until = energy["time"] <= now + 1e-12
            below.plot(1e6 * energy["time"][until], -100 * energy["residual"][until] / run.summary["energy"]["initial"], color=colour, label=name)
        below.set(xlim=(0, 150), ylim=(-3, 15), xlabel="time, µs", ylabel="energy made, %")
        below.legend(frameon=False, loc="upper left", fontsize=8)

    FuncAnimation(figure, show, frames=range(4, count), cache_frame_data=False).save(root / "docs/pictures/explicit-against-adaptive.gif", PillowWriter(fps=8))


if __name__ == "__main__":
    draw()
