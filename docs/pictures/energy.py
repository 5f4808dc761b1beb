"""The energy account of an impact: where the ball's kinetic energy goes, and the residual that the numerics make."""
import subprocess

import vitrum
from look import blue, green, grey, orange, plt, purple, save, yellow

parts = {"kinetic": blue, "elastic": "#56B4E9", "contact": grey, "plastic": yellow, "damage": green, "fracture": orange, "friction": purple}


def draw():
    scene = subprocess.run([vitrum.program.program(), "new", "impact"], check=True, capture_output=True, text=True).stdout
    run = vitrum.run(scene, fields=False)
    energy = {name: values[::8] for name, values in run.columns("energy").items()}
    time = 1e6 * energy["time"]
    figure, (account, residual) = plt.subplots(2, 1, figsize=(7.2, 4.2), sharex=True, height_ratios=(3, 1), layout="constrained")
    account.stackplot(time, [energy[part] for part in parts], colors=list(parts.values()), labels=list(parts), alpha=0.85)
    account.set(ylabel="energy, J", title="steel ball, 60 m/s, on a glass plate of 5 mm")
    handles, labels = account.get_legend_handles_labels()
    account.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    residual.plot(time, 100 * energy["residual"] / run.summary["energy"]["initial"], color="black")
    residual.axhline(0, color=grey, linewidth=0.6)
    residual.set(xlabel="time, µs", ylabel="residual, %")
    save(figure, "energy")
