"""Ring-on-ring bending to failure by the implicit method: force over deflection beside a thin plate's, and the stress before it breaks."""
import math
import pathlib

import numpy as np
import vitrum
from look import blue, grey, orange, plt, save, squares

scene = pathlib.Path(__file__).resolve().parents[2] / "examples/ring_on_ring.toml"


def draw():
    run = vitrum.run(scene)
    p = run.scene["parameters"]
    h, a, b, speed, rise, R, E, nu = p["h"], p["a"], p["b"], p["speed"], p["rise"], 0.036, 72e9, 0.25
    reactions = run.columns("reactions")
    of_ring = reactions["boundary"] == "load ring"
    time, impulse = reactions["time"][of_ring], -reactions["impulse_z"][of_ring]
    middle = 0.5 * (time[1:] + time[:-1])
    way = speed * (middle - np.where(middle < rise, rise / (2 * math.pi) * np.sin(math.pi * middle / rise) + 0.5 * middle, 0.5 * rise))
    events = run.columns("events")
    breaks = events["time"][events["kind"] == "localisation"].min()
    figure, (force, field) = plt.subplots(1, 2, figsize=(8.6, 2.6), layout="constrained", width_ratios=(1, 1.6))
    force.plot(1e6 * way, np.diff(impulse) / np.diff(time), color=blue, label="run")
    shape = (1 - nu) * (a * a - b * b) / (2 * (1 + nu) * R * R)
    D, moment = E * h**3 / (12 * (1 - nu * nu)), (1 + nu) / (4 * math.pi) * (math.log(a / b) + shape)
    rings = ((a * a - b * b) * (1 + shape) - b * b * math.log(a / b)) / (8 * math.pi * D) - moment / (D * (1 + nu)) * b * b / 2
    broken = 1e6 * speed * (breaks - rise / 2)
    force.plot([0, broken], [0, 1e-6 * broken / rings], "--", color=grey, label="thin plate")
    force.axvline(broken, color=orange, linewidth=0.8, label="first localisation")
    force.set(xlabel="travel of the load ring, µm", ylabel="force, N")
    force.legend(frameon=False, fontsize=8)
    frame = max((f for f in run.frames if f.time < breaks), key=lambda f: f.time)
    drawn = squares(field, frame.position, run.side, 1e-6 * frame["stress"][:, 0], cmap="RdBu_r", clim=(-100, 100))
    field.plot([1e3 * a, 1e3 * b], [-0.4, 1e3 * h + 0.1], linestyle="", marker="^", color="black")
    field.set(title=f"$\\sigma_{{rr}}$ at {1e6 * frame.time:.0f} µs, {1e6 * (breaks - frame.time):.0f} µs before it breaks")
    figure.colorbar(drawn, ax=field, label="MPa", location="bottom", shrink=0.6, aspect=30)
    save(figure, "ring_on_ring")
