"""Failure over time, from the series that every run has."""
import matplotlib.pyplot as plt

from vitrum.plot.looks import page_width



def failure_history(run):
    """Particles that have localised and separated, and how far out; what the outputs stored, which `--no-fields` does not touch. None: nothing can."""
    series = run.columns("series")
    if not any(material.get("decohesion") for material in run.scene["material"].values()):
        return None
    time = 1e6 * series["time"]
    figure, (counts, places) = plt.subplots(1, 2, figsize=(page_width, 3.0), layout="constrained")
    for name, colour, dashes in (("localised", "#0072B2", "-"), ("separated", "#D55E00", "--")):
        counts.step(time, series[name], color=colour, linestyle=dashes, label=name, where="post", linewidth=1.4)
    counts.set_ylabel("particles", fontsize=8.5)
    # Often the same place: the thin line runs inside the thick one.
    for name, colour, width, label in (("localised_radius_max", "#56B4E9", 3.6, "outermost localised"), ("damage_front_radius", "#1A1A1A", 1.0, "outermost D > 0.1")):
        places.step(time, 1e3 * series[name], color=colour, linewidth=width, label=label, where="post")
    places.set_ylabel(("radius" if run.axisymmetric else "|x|") + " (mm)", fontsize=8.5)
    for axes in (counts, places):
        axes.set_xlabel("time (µs)", fontsize=8.5)
        axes.set_ylim(bottom=0.0)
        axes.tick_params(labelsize=7.5)
        axes.grid(True, linewidth=0.3, color="#CCCCCC")
        axes.legend(fontsize=8, frameon=False)
    figure.suptitle(f"{run.title}\nFailure over time" if run.title else "Failure over time", fontsize=9.5)
    return figure
