"""Figures of the sensitivity study."""
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from study.figures import colours, legend_below, plt, save

from sensitivity.predictions import drawn, quantities


def question(title, ensembles, members, found, base, folder, name):
    """One question: each prediction over the settings. Dots: members. Light band: 5 to 95 % of them. Dark band: the median's 95 % confidence
    interval. The base ensemble's 5 to 95 % run across."""
    figure, panels = plt.subplots(2, 3, figsize=(8.6, 5.0), sharex=True)
    random = np.random.default_rng(2)
    for axes, key in zip(panels.flat, drawn):
        label, unit, scale = quantities[key]
        if found[base][key]["n"]:
            axes.axhspan(scale * found[base][key]["p05"], scale * found[base][key]["p95"], color="#EEEEEE", linewidth=0, zorder=0)
        for n, ensemble in enumerate(ensembles):
            stats = found[ensemble.name][key]
            if not stats["n"]:
                axes.text(n, 0.5, "all failed", transform=axes.get_xaxis_transform(), rotation=90, ha="center", va="center", fontsize=7, color="#666666")
                continue
            values = scale * np.array([row[key] for row in members[ensemble.name] if row[key] is not None], float)
            axes.bar(n, scale * (stats["p95"] - stats["p05"]), bottom=scale * stats["p05"], width=0.6, color=colours[5], alpha=0.45, linewidth=0)
            axes.bar(n, scale * (stats["median_high"] - stats["median_low"]), bottom=scale * stats["median_low"], width=0.6, color=colours[0], alpha=0.45, linewidth=0)
            axes.plot([n - 0.3, n + 0.3], 2 * [scale * stats["median"]], color=colours[0], linewidth=1.6)
            axes.plot(n + random.uniform(-0.18, 0.18, values.size), values, linestyle="", marker=".", markersize=3, color="black", alpha=0.6)
        axes.use_sticky_edges = False
        axes.margins(y=0.15)
        axes.set_title(label)
        axes.set_ylabel(unit or "number")
        axes.set_xlim(-0.6, len(ensembles) - 0.4)
        axes.grid(False, axis="x")
        axes.set_xticks(range(len(ensembles)))
        labels = [ensemble.label for ensemble in ensembles]
        crowded = sum(map(len, labels)) > 30
        axes.set_xticklabels(labels, fontsize=7.5, rotation=20 if crowded else 0, ha="right" if crowded else "center")
        axes.ticklabel_format(axis="y", useOffset=False)
    figure.suptitle(title[0].upper() + title[1:], fontsize=10)
    legend_below(figure, [Line2D([], [], color="black", linestyle="", marker=".", label="member"), Patch(color=colours[5], alpha=0.45, label="5–95 % of members"),
                          Patch(color=colours[0], alpha=0.45, label="95 % confidence of the median"), Patch(color="#EEEEEE", label="5–95 %, base")])
    save(figure, folder, name)


def fragment_masses(by_label, folder, name):
    """Number of fragments heavier than a mass: median of the members, band 5 to 95 %. `by_label`: label -> list of arrays (kg)."""
    figure, axes = plt.subplots(figsize=(5.6, 3.4))
    heaviest = max((masses.max() for runs in by_label.values() for masses in runs if masses.size), default=1e-3)
    lightest = min((masses.min() for runs in by_label.values() for masses in runs if masses.size), default=1e-6)
    grid = np.geomspace(0.9 * lightest, 1.1 * heaviest, 200)
    for n, (label, runs) in enumerate(by_label.items()):
        counts = np.array([[np.count_nonzero(masses > mass) for mass in grid] for masses in runs])
        if not counts.size:
            continue
        median = np.median(counts, axis=0)
        axes.fill_between(1e3 * grid, np.quantile(counts, 0.05, axis=0), np.quantile(counts, 0.95, axis=0), color=colours[n], alpha=0.2, linewidth=0)
        axes.plot(1e3 * grid, median, color=colours[n], linestyle=["-", "--", "-.", ":"][n % 4], label=label)
    axes.set_xscale("log")
    axes.set_xlabel("mass (g)")
    axes.set_ylabel("fragments of the plate that are heavier")
    axes.set_ylim(bottom=0)
    axes.legend(title="median, band 5–95 %", loc="upper right")
    save(figure, folder, name)


def spread(spreads, folder, name):
    """Distance of an ensemble's members from its first one over time: median, and band from least to most. `spreads`: label -> (time, rows)."""
    figure, axes = plt.subplots(figsize=(6.6, 3.9))
    for n, (label, (time, rows)) in enumerate(spreads.items()):
        floor = np.maximum(rows, 1e-17)
        axes.fill_between(1e6 * time, floor.min(axis=0), floor.max(axis=0), color=colours[n], alpha=0.2, linewidth=0)
        axes.plot(1e6 * time, np.median(floor, axis=0), color=colours[n], linestyle=["-", "--", "-.", ":", (0, (5, 1, 1, 1))][n % 5], label=label)
    axes.set_yscale("log")
    axes.set_ylim(1e-16, 1.0)
    axes.set_xlabel("time (µs)")
    axes.set_ylabel("distance between members\n(RMS velocity, of 200 m/s)")
    legend_below(figure, axes.get_lines())
    save(figure, folder, name)
