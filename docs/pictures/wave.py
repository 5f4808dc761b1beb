"""A wave of strips: when each stage of each strip is taken, and what is in the cache at one moment."""
from matplotlib.patches import Rectangle

from look import arrow, blue, green, grey, orange, save, sheet, yellow

stages = ("scatter", "nodes", "gather", "strain")
strips = 7


def order(strips, stages):
    """(strip, stage) in the order of one thread: src/parallel/wave.hpp, run_alone."""
    return [(front - stage, stage) for front in range(strips + stages - 1) for stage in range(stages) if stage <= front and front - stage < strips]


def draw():
    figure, axes = sheet(8.2, 3.5)
    colours = (blue, green, yellow, orange)
    taken = order(strips, len(stages))
    for stage, name in enumerate(stages):
        axes.text(1.7 + 0.95 * stage, 3.25, name, ha="center", fontsize=9)
    for number, (strip, stage) in enumerate(taken, start=1):
        x, y, on_front = 1.7 + 0.95 * stage, 2.85 - 0.42 * strip, strip + stage == 4
        axes.add_patch(Rectangle((x - 0.4, y - 0.17), 0.8, 0.34, facecolor=colours[stage] + ("99" if on_front else "22"), edgecolor=colours[stage]))
        axes.text(x, y, number, ha="center", va="center", fontsize=9, fontweight="bold" if on_front else "normal")
    for strip in range(strips):
        axes.text(1.0, 2.85 - 0.42 * strip, f"strip {strip}", ha="right", va="center", fontsize=9)
    axes.text(5.25, 2.3, "one front: four strips, each in a stage\nof its own, all still in the cache", fontsize=8.5, va="center")
    arrow(axes, (5.2, 2.2), (4.98, 2.42 - 0.0), colour=grey)
    axes.text(5.25, 1.3, "A stage of a strip waits for the stage before\nof that strip and of the two beside it:\nthey share nodes.", fontsize=8.5, va="center", linespacing=1.5)
    save(figure, "wave")
