"""Damage and softening of glass, flow and softening of steel: what `vitrum point` computes, with its events."""
import pathlib

import vitrum
from look import blue, green, grey, orange, plt, purple, save

events = {"damage": (green, "o"), "yield": (purple, "s"), "peak": (blue, "^"), "localisation": (orange, "D"), "separation": ("black", "X")}
root = pathlib.Path(__file__).resolve().parents[2]
points = root / "tests/cli/points/glass.toml", root / "studies/findings/steel.toml"


def draw():
    figure, panels = plt.subplots(1, 3, figsize=(8.6, 3.0), layout="constrained")
    glass = {rate: vitrum.point(points[0], {"path.time": [0.0, 3e-3 / (3 * rate)]}) for rate in (1e2, 1e3, 1e4)}
    for (rate, point), colour in zip(glass.items(), (blue, green, orange)):
        label = f"$\\dot\\varepsilon_v = 10^{len(str(int(rate))) - 1}$ /s"
        for axes, column, scale in ((panels[0], "s_rr", 1e-6), (panels[1], "damage", 1.0)):
            axes.plot(1e3 * point["e_rr"], scale * point[column], color=colour, label=label)
            mark(axes, point, "e_rr", column, 1e3, scale)
    panels[0].set(xlabel="strain $\\varepsilon_{rr}$, 1/1000", ylabel="stress $\\sigma_{rr}$, MPa", title="glass, uniaxial strain")
    panels[1].set(xlabel="strain $\\varepsilon_{rr}$, 1/1000", ylabel="damage D", title="damage, eqs. 7 and 8")
    panels[0].legend(frameon=False, fontsize=9.5, loc="upper left", borderaxespad=0.1, handlelength=1.2)
    panels[0].set_ylim(0, 350)
    steel = vitrum.point(points[1])
    panels[2].plot(1e3 * steel["e_rr"], 1e-6 * steel["s_rr"], color=grey)
    mark(panels[2], steel, "e_rr", "s_rr", 1e3, 1e-6)
    panels[2].set(xlabel="strain $\\varepsilon_{rr} = -\\varepsilon_{zz}$, 1/1000", ylabel="stress $\\sigma_{rr}$, MPa", title="steel, pure shear")
    marks = [plt.Line2D([], [], color=colour, marker=marker, linestyle="", label=name) for name, (colour, marker) in events.items()]
    panels[2].legend(handles=marks, frameon=False, fontsize=9)
    save(figure, "curves")


def mark(axes, point, x, y, x_scale, y_scale):
    for time, name in point.events:
        n = int(abs(point["t"] - time).argmin())
        colour, marker = events[name]
        axes.plot(x_scale * point[x][n], y_scale * point[y][n], color=colour, marker=marker, markersize=5.5, linestyle="", zorder=4)
