"""What the drawings of these pages share: colours that colour-blind readers tell apart, arrows, and a file whose text depends on nothing but the drawing."""
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(__file__).resolve().parent / "drawings"
orange, blue, green, yellow, purple, grey = "#D55E00", "#0072B2", "#009E73", "#E69F00", "#CC79A7", "#666666"
matplotlib.rcParams.update({"svg.hashsalt": "vitrum", "svg.fonttype": "path", "font.size": 9, "mathtext.fontset": "cm", "axes.spines.top": False,
                            "axes.spines.right": False, "figure.facecolor": "white"})


def sheet(width, height):
    """Axes without axes, one unit to the inch."""
    figure = plt.figure(figsize=(width, height))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, width), ylim=(0, height))
    axes.set_aspect("equal")
    axes.axis("off")
    return figure, axes


def box(axes, x, y, text, colour, width=1.1, height=0.44, **more):
    """Centred at (x, y)."""
    from matplotlib.patches import FancyBboxPatch
    axes.add_patch(FancyBboxPatch((x - width / 2, y - height / 2), width, height, boxstyle="round,pad=0,rounding_size=0.08", facecolor=colour + "22",
                                  edgecolor=colour, linewidth=1.2))
    axes.text(x, y, text, ha="center", va="center", **({"fontsize": 8.5} | more))


def arrow(axes, start, end, text="", bend=0.0, colour="black", shift=(0, 0), **more):
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "connectionstyle": f"arc3,rad={bend}", "shrinkA": 0, "shrinkB": 0, "linewidth": 1.1})
    if text:
        middle = ((start[0] + end[0]) / 2 + shift[0], (start[1] + end[1]) / 2 + shift[1])
        axes.text(*middle, text, **({"ha": "center", "va": "center", "fontsize": 7.5, "color": colour} | more))


def squares(axes, position, side, values, **more):
    """Particles as squares where they are, mm, coloured by a field; small as a picture within the drawing."""
    from matplotlib.collections import PolyCollection
    half = 0.5e3 * side[:, None, None] * [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    drawn = PolyCollection(1e3 * position[:, None, :] + half, array=values, rasterized=True, linewidth=0, antialiased=False, **more)
    axes.add_collection(drawn)
    axes.autoscale_view()
    axes.set(aspect="equal", xlabel="r, mm", ylabel="z, mm")
    return drawn


def save(figure, name):
    folder.mkdir(exist_ok=True)
    figure.savefig(folder / f"{name}.svg", dpi=120, metadata={"Date": None, "Creator": "vitrum docs/pictures"})
    plt.close(figure)
