"""A wave of strips: when each stage of each strip is taken, and what is in the cache at one moment."""
from matplotlib.patches import Rectangle

from look import arrow, blue, green, grey, orange, purple, save, sheet, yellow

stages = ("scatter", "nodes", "gather,\nscatter", "nodes", "strain")  # of an explicit MUSL step
strips = 7


def order(strips, stages):
    """(strip, stage) in the order of one thread: src/parallel/wave.hpp, run_alone."""
    return [(front - stage, stage) for front in range(strips + stages - 1) for stage in range(stages) if stage <= front and front - stage < strips]


def draw():
    figure, axes = sheet(8.2, 3.6)
    colours = (blue, green, yellow, purple, orange)
    taken = order(strips, len(stages))
    for stage, name in enumerate(stages):
        axes.text(1.4 + 0.84 * stage, 3.3, name, ha="center", va="center", fontsize=9)
    for number, (strip, stage) in enumerate(taken, start=1):
        x, y, on_front = 1.4 + 0.84 * stage, 2.85 - 0.42 * strip, strip + stage == 4
        axes.add_patch(Rectangle((x - 0.36, y - 0.17), 0.72, 0.34, facecolor=colours[stage] + ("99" if on_front else "22"), edgecolor=colours[stage]))
        axes.text(x, y, number, ha="center", va="center", fontsize=9, fontweight="bold" if on_front else "normal")
    for strip in range(strips):
        axes.text(0.85, 2.85 - 0.42 * strip, f"strip {strip}", ha="right", va="center", fontsize=9)
    axes.text(5.5, 2.5, "one front: five strips,\neach in a stage of its own,\nall still in the cache", fontsize=9, va="center")
    arrow(axes, (5.45, 2.6), (5.16, 2.8), colour=grey)
    axes.text(5.5, 1.3, "A stage of a strip waits for\nthe stage before of that strip\nand of the two beside it:\nthey share nodes.", fontsize=9, va="center", linespacing=1.5)
    save(figure, "wave")
