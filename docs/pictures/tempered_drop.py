"""A ball on tempered and on annealed glass: stress through the thickness before it comes, and what it leaves."""
import pathlib

import numpy as np
import vitrum
from look import blue, grey, orange, plt, save, squares

scene = pathlib.Path(__file__).resolve().parents[2] / "examples/tempered_drop.toml"


def draw():
    figure = plt.figure(figsize=(8.6, 3.9), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1, 2.2))
    profile = figure.add_subplot(grid[:, 0])
    for row, (name, S, colour) in enumerate((("tempered to 100 MPa", 100e6, blue), ("annealed", 0.0, orange))):
        run = vitrum.run(scene, {"parameters.S": S})
        plate, start, end = run.body == 0, run.frames[0], run.frames[-1]
        x, stress = start.position[plate], start["stress"][plate][:, 0]
        for radius, style in ((10e-3, "-"), (49e-3, ":")):
            column = x[:, 0] // run.cell == radius // run.cell
            profile.plot(1e-6 * stress[column], 1e3 * x[column, 1], style, color=colour, label=f"{name}, r = {1e3 * radius:.0f} mm")
        axes = figure.add_subplot(grid[row, 1])
        drawn = squares(axes, end.position, run.side, np.where(plate, end["damage"], 0.0), cmap="inferno_r", clim=(0, 1))
        axes.set(xlim=(0, 50), ylim=(-1, 12), title=f"{name}: a fall of 1.2 m, {1e6 * end.time:.0f} µs")
        figure.colorbar(drawn, ax=axes, label="damage D")
    profile.axvline(0, color=grey, linewidth=0.6)
    profile.set(xlabel="stress $\\sigma_{rr}$ at the start, MPa", ylabel="z, mm")
    profile.legend(frameon=False, fontsize=8.5, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    save(figure, "tempered_drop")
