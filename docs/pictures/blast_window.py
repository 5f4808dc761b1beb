"""A blast on laminated glass: damage of the panes, and how the middle of the window goes, in cells twice as large as the scene's."""
import pathlib

import vitrum
from look import blue, green, plt, save, squares

scene = pathlib.Path(__file__).resolve().parents[2] / "examples/blast_window.toml"


def draw():
    run = vitrum.run(scene, {"space.cell": 1.52e-3})
    figure, (window, middle) = plt.subplots(2, 1, figsize=(7.2, 4.0), layout="constrained", height_ratios=(1, 1.4))
    frame = run.frames[-1]
    drawn = squares(window, frame.position, run.side, frame["damage"], cmap="inferno_r", clim=(0, 1))
    window.set(xlabel="x, mm", ylabel="y, mm", title=f"2 kg of TNT at 2 m: damage after {1e6 * frame.time:.0f} µs, right of the middle of the span")
    figure.colorbar(drawn, ax=window, label="damage D", shrink=0.8)
    probe = run.columns("probes")
    time = 1e6 * probe["time"]
    middle.plot(time, 1e3 * (probe["z"] - probe["z"][0]), color=blue)
    middle.set_xlabel("time, µs")
    middle.set_ylabel("deflection of the inner face\nin the middle of the span, mm", color=blue)
    energy = run.columns("energy")
    spent = middle.twinx()
    spent.spines["right"].set_visible(True)
    spent.plot(1e6 * energy["time"], energy["fracture"], color=green)
    spent.set_ylabel("fracture energy, J/m", color=green)
    save(figure, "blast_window")
