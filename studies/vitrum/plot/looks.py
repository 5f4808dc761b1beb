"""Colours, scales and sizes that all pictures share. Widths are those of a page: what is written can be read there without enlarging."""
from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap

page_width = 7.2  # inches
dots_per_inch = 200

# A body, and what has separated of it: colours of Okabe and Ito and shades of them, told apart by all kinds of colour vision and in grey.
body_colours = [("#A9D6F0", "#D55E00"), ("#BEBEBE", "#1A1A1A"), ("#F0E442", "#7A6A00"), ("#F3C9E1", "#8E2A6B"), ("#A8DCC5", "#00614A"), ("#F6D08A", "#6B4300")]
# Pieces that have come off, in turn.
piece_colours = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#F0E442", "#D55E00"]
untouched = "#E3EAEF"


def body_look(body, separated=False):
    return body_colours[body % len(body_colours)][int(separated)]


# From light to dark: the worst is the darkest.
worse = LinearSegmentedColormap.from_list("worse", matplotlib.colormaps["magma_r"](np.linspace(0.06, 0.92, 256)))


@dataclass
class Scale:
    """Classes of a field, the same in every picture: their bounds in the field's unit, a decade in two parts."""
    bounds: list
    label: str
    below: str

    @property
    def norm(self):
        return BoundaryNorm(self.bounds, worse.N, extend="max")

    @property
    def mapping(self):
        return matplotlib.cm.ScalarMappable(self.norm, worse)


def decades(first, last):
    """1, 3, 10, 30, ... from 10^first to 10^last."""
    return [factor * 10.0**power for power in range(first, last) for factor in (1.0, 3.0)] + [10.0**last]


damage_scale = Scale([*decades(-3, -1), 0.15, 0.2, 0.3, 0.5, 1.0], "damage D (–)", "D < 0.001")


def opening_scale(cell):
    """From a thousandth of the scene's cell (m) to ten cells, in micrometres."""
    exponent = round(np.log10(1e3 * cell))
    bounds = decades(exponent, exponent + 4)
    return Scale(bounds, "opening |u| (µm)", f"closed, or opening below {bounds[0]:g} µm")
