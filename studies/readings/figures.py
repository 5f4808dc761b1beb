"""Figures of the study of readings."""
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from study.figures import colours, legend_below, page_width, plt, save

from readings.factors import counts, factors

# By verdict: what comes out with a sound account, with an unsound one, after a blow-up, not, and what was not judged.
kinds = {"as the text says": colours[0], "… with an account open by more than 5 %": colours[5], "… after a blow-up": colours[4], "otherwise": "#E6E6E6", "ended before": "white"}


def _kind(verdict, sound):
    if verdict["verdict"] == "–":
        return 4
    if verdict["verdict"] == "yes":
        return 0 if abs(verdict["made"]) <= sound else 1
    return 2 if verdict["verdict"] == "blown up" else 3


def matrix(verdicts, design, folder, name, sound=0.05):
    """Statements by readings, a panel for each integration; below, the levels of each reading."""
    ways = list(dict.fromkeys(point.integration for point in design))
    rows = list(dict.fromkeys(point.row for point in design))
    statements = [each.key for each in verdicts.statements]
    height = 0.16 * len(statements) + 0.4
    figure, panels = plt.subplots(len(ways) + 1, 1, figsize=(page_width, height * len(ways) + 0.16 * len(factors) + 0.9), squeeze=False,
                                  gridspec_kw={"height_ratios": [len(statements)] * len(ways) + [len(factors)]})
    for axes, way in zip(panels[:, 0], ways):
        of = {point.row: verdicts.of[point] for point in design if point.integration == way}
        codes = np.array([[_kind(of[row][key], sound) for row in rows] for key in statements])
        axes.imshow(codes, cmap=ListedColormap(list(kinds.values())), vmin=0, vmax=len(kinds) - 1, aspect="auto", interpolation="nearest")
        axes.set_yticks(range(len(statements)), statements, fontsize=6)
        axes.set_xticks([])
        axes.set_title(way.label)
        axes.grid(False)
    axes = panels[-1, 0]
    axes.imshow(np.array(rows).T, cmap="Greys", vmin=0, vmax=max(counts) - 1, aspect="auto", interpolation="nearest")
    axes.set_yticks(range(len(factors)), [factor.label for factor in factors], fontsize=6)
    numbers = range(4, len(rows) + 1, 4)
    axes.set_xticks([number - 1 for number in numbers], numbers, fontsize=6)
    axes.set_xlabel("reading (white: the reference's level; the darker, the later it stands in the table of factors)")
    axes.grid(False)
    legend_below(figure, [Patch(facecolor=colour, edgecolor="#999999", label=label) for label, colour in kinds.items()])
    save(figure, folder, name)


def effects(statements, found, folder, name):
    """Share of each factor of the variance of each statement's verdict between readings; a ring where it is more than chance after correction."""
    shares = np.array([[found[s, f]["share"] for f in range(len(factors))] for s in range(len(statements))])
    figure, axes = plt.subplots(figsize=(page_width, 0.19 * len(statements) + 1.6))
    image = axes.imshow(100 * shares, cmap="Blues", vmin=0, vmax=100, aspect="auto", interpolation="nearest")
    for (s, f), effect in found.items():
        if effect["p"] <= 0.05:
            axes.plot(f, s, marker="o", markersize=6, markerfacecolor="none", markeredgecolor=colours[1])
    axes.set_xticks(range(len(factors)), [factor.label for factor in factors], rotation=40, ha="right", fontsize=7)
    axes.set_yticks(range(len(statements)), statements, fontsize=7)
    axes.grid(False)
    figure.colorbar(image, ax=axes, label="share of the variance between readings (%)")
    save(figure, folder, name)
