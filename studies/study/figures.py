"""How the figures of all studies look and where they go."""
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from vitrum.plot import stamp  # noqa: E402
from vitrum.plot.looks import dots_per_inch, page_width  # noqa: E402,F401

from study.provenance import made_by  # noqa: E402

# Okabe and Ito's colours, told apart by all kinds of colour vision; markers tell them apart in grey.
colours = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
markers = ["o", "s", "^", "D", "v", "P", "X"]
style = {
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 8, "xtick.labelsize": 8, "ytick.labelsize": 8,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.6, "lines.linewidth": 1.4, "lines.markersize": 4.5,
    "axes.grid": True, "grid.linewidth": 0.3, "grid.color": "#CCCCCC", "legend.frameon": False, "figure.constrained_layout.use": True,
    "axes.axisbelow": True,
}
plt.rcParams.update(style)


def save(figure, folder, name, of_run=None, made=None):
    """NAME.png, with its origin as text (the study's: `made` where it is told by a file; and the run's where it shows one), and NAME.pdf."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    origin = {**(of_run or {}), **stamp.of_study(*(made or made_by()))}
    for suffix in ("png", "pdf"):
        figure.savefig(folder / f"{name}.{suffix}", dpi=dots_per_inch, metadata=origin if suffix == "png" else {"Creator": origin["Source"]})
    plt.close(figure)


def legend_below(figure, handles, texts=None):
    """One legend for all panels, in a strip below them, of as many columns as there is room for."""
    texts = texts or [handle.get_label() for handle in handles]
    inches = 0.55 + 0.075 * max(len(text) for text in texts)
    columns = max(1, min(len(handles), int(figure.get_figwidth() / inches)))
    room = (0.1 + 0.2 * -(-len(handles) // columns)) / figure.get_figheight()
    figure.set_layout_engine("constrained", rect=(0.0, room, 1.0, 1.0 - room))
    figure.legend(handles, texts, loc="lower center", ncol=columns)
