"""Figures of the sensitivity study."""
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator, NullFormatter
from study.figures import colours, legend_below, page_width, plt, save

from sensitivity.predictions import drawn, matters, quantities


def scales(found):
    """Limits of each prediction's axis (in its figure's unit): all ensembles of the study on one scale, so that questions can be compared."""
    limits = {}
    for key in drawn:
        scale = quantities[key][2]
        stats = [each[key] for each in found.values() if each[key]["n"]]
        low, high = min(scale * each["p05"] for each in stats), max(scale * each["p95"] for each in stats)
        # Where all ensembles agree, the axis still spans what would matter.
        middle, half = 0.5 * (low + high), max(0.55 * (high - low), 0.5 * matters[key])
        limits[key] = middle - half, middle + half
    return limits


def question(title, ensembles, members, found, base, limits, folder, name):
    """One question: each prediction over the settings, which stand one below the other. Dots: members. Light band: 5 to 95 % of them. Dark band: the
    median's 95 % confidence interval. The base ensemble's 5 to 95 % run down the panel."""
    rows = len(ensembles)
    figure, panels = plt.subplots(2, 3, figsize=(page_width, 2 * (0.62 + 0.24 * rows) + 0.75), sharey=True)
    random = np.random.default_rng(2)
    for axes, key in zip(panels.flat, drawn):
        label, unit, scale = quantities[key]
        low, high = limits[key]
        if found[base][key]["n"]:
            axes.axvspan(scale * found[base][key]["p05"], scale * found[base][key]["p95"], color="#E6E6E6", linewidth=0.8, zorder=0)
        for n, ensemble in enumerate(ensembles):
            stats = found[ensemble.name][key]
            if not stats["n"]:
                axes.text(0.5, n, "all failed", transform=axes.get_yaxis_transform(), ha="center", va="center", fontsize=7, color="#666666")
                continue
            values = scale * np.array([row[key] for row in members[ensemble.name] if row[key] is not None], float)
            axes.barh(n, scale * (stats["p95"] - stats["p05"]), left=scale * stats["p05"], height=0.62, color=colours[5], alpha=0.45, linewidth=0)
            axes.barh(n, scale * (stats["median_high"] - stats["median_low"]), left=scale * stats["median_low"], height=0.62, color=colours[0], alpha=0.45, linewidth=0)
            axes.plot(2 * [scale * stats["median"]], [n - 0.31, n + 0.31], color=colours[0], linewidth=1.6)
            inside = np.clip(values, low, high)
            axes.plot(inside, n + random.uniform(-0.2, 0.2, values.size), linestyle="", marker=".", markersize=2.5, color="black", alpha=0.6)
            # A member beyond the scale stands at its edge, as an arrow.
            for edge, marker, beyond in ((low, "<", values < low), (high, ">", values > high)):
                if beyond.any():
                    axes.plot([edge], [n], marker=marker, markersize=4, color="black", clip_on=False)
        axes.set_title(f"{label} ({unit})" if unit else label, fontsize=8)
        axes.set_xlim(low, high)
        axes.grid(False, axis="y")
        axes.xaxis.set_major_locator(MaxNLocator(4))
        axes.ticklabel_format(axis="x", useOffset=False)
        axes.set_yticks(range(rows))
        axes.set_yticklabels([" ".join(ensemble.label.split()) for ensemble in ensembles], fontsize=8)
        axes.set_ylim(rows - 0.4, -0.6)
    figure.suptitle(title[0].upper() + title[1:], fontsize=9.5)
    legend_below(figure, [Line2D([], [], color="black", linestyle="", marker=".", label="member"), Patch(color=colours[5], alpha=0.45, label="5–95 % of members"),
                          Patch(color=colours[0], alpha=0.45, label="95 % confidence of the median"), Patch(color="#E6E6E6", label="5–95 %, base")])
    save(figure, folder, name)


def fragment_masses(by_label, folder, name):
    """Left: fragments of the plate heavier than a mass, mean number in a run, all members of an ensemble together. Right: mass of the plate that has come off,
    as fragments and as separated particles; bars: mean, whiskers: 5 to 95 % of the members. `by_label`: label -> list of (masses of fragments, separated mass) (kg)."""
    figure, (counts, balance) = plt.subplots(1, 2, figsize=(page_width, 3.6), width_ratios=[1.25, 1.0])
    dashes = ["-", "--", "-.", ":", (0, (5, 1, 1, 1))]
    for n, (label, runs) in enumerate(by_label.items()):
        pooled = np.sort(np.concatenate([masses for masses, _ in runs]))[::-1]
        colour = colours[n % len(colours)]
        if pooled.size:
            # From the lightest piece, below which there is none, up the stairs.
            number = np.arange(1, pooled.size + 1) / len(runs)
            counts.step(1e3 * np.append(pooled, 0.8 * pooled[-1]), np.append(number, number[-1]), where="pre", color=colour, linestyle=dashes[n % 5], label=label)
        fragments, separated = (np.array([1e3 * each for each in values]) for values in zip(*((masses.sum(), loose) for masses, loose in runs)))
        y = n
        balance.barh(y, separated.mean(), height=0.6, color=colour, alpha=0.45)
        balance.barh(y, fragments.mean(), left=separated.mean(), height=0.6, color=colour)
        total = fragments + separated
        balance.plot(np.quantile(total, [0.05, 0.95]), [y, y], color="black", linewidth=1.0, marker="|", markersize=5)
    counts.set_xscale("log")
    counts.set_yscale("log")
    counts.set_xlabel("mass (g)")
    counts.set_ylabel("fragments a run, at least as heavy")
    for axis in (counts.xaxis, counts.yaxis):
        axis.set_major_formatter(lambda value, _: f"{value:g}")
        axis.set_minor_formatter(NullFormatter())
    balance.set_yticks(range(len(by_label)))
    balance.set_yticklabels(list(by_label))
    balance.set_ylim(len(by_label) - 0.4, -0.6)
    balance.set_xlabel("mass come off the plate (g)")
    balance.grid(False, axis="y")
    handles = [Line2D([], [], color=colours[n % len(colours)], linestyle=dashes[n % 5], label=label) for n, label in enumerate(by_label)]
    handles += [Patch(color="#333333", alpha=0.45, label="separated particles"), Patch(color="#333333", label="fragments")]
    legend_below(figure, handles)
    save(figure, folder, name)


def spread(spreads, folder, name):
    """Distance of an ensemble's members from its first one over time: median, and band from least to most. `spreads`: label -> (time, rows)."""
    figure, axes = plt.subplots(figsize=(page_width, 3.9))
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
