"""The automaton of modes of the paper's model: its plane, and beside it damage and flow, each with the guards that switch it (materials/composite/mode.hpp)."""
from look import arrow, blue, box, green, grey, orange, purple, save, sheet, yellow


def draw():
    figure, axes = sheet(8.2, 4.2)
    axes.text(0.2, 3.95, "the plane", fontsize=10, fontweight="bold")
    places = {"intact": (0.9, 3.2, blue), "held": (3.1, 3.2, green), "decohering": (5.5, 3.2, yellow), "open": (7.4, 3.2, orange), "closed": (7.4, 1.7, purple)}
    for name, (x, y, colour) in places.items():
        box(axes, x, y, name, colour, width=1.1, height=0.5, fontsize=9.5)
    arrow(axes, (1.45, 3.2), (2.55, 3.2), "localisation", shift=(0, 0.13))
    arrow(axes, (3.65, 3.28), (4.95, 3.28), "strength reached", shift=(0, 0.13))
    arrow(axes, (4.95, 3.12), (3.65, 3.12), "opening stops", shift=(0, -0.14))
    arrow(axes, (6.05, 3.2), (6.85, 3.2), "separation,\nsnap-back", shift=(0, 0.24))
    arrow(axes, (7.3, 2.95), (7.3, 1.95), "closure", shift=(-0.36, 0))
    arrow(axes, (7.5, 1.95), (7.5, 2.95), "opening", shift=(0.36, 0))
    axes.annotate("", (5.15, 2.93), (5.85, 2.93), arrowprops={"arrowstyle": "-|>", "connectionstyle": "arc3,rad=-0.9", "shrinkA": 0, "shrinkB": 0})
    axes.text(5.5, 2.42, "normal traction changes sign:\npulled, or sheared under pressure", ha="center", va="center", fontsize=7.5)
    axes.text(0.2, 1.75, "and at the same time", fontsize=10, fontweight="bold")
    for x, off, on, forth, back, colour, note in (
            (0.9, "undamaged,\nor unloading", "damaging", "eq. 7 reaches $\\rho_d$", "unloading, limit,\nlocalisation", orange, "only in tension, only while intact"),
            (4.3, "elastic", "flowing", "yield", "unloading", purple, "hardening, softening, residual: branch by branch")):
        box(axes, x, 1.05, off, grey, width=1.2, height=0.5)
        box(axes, x + 2.0, 1.05, on, colour, width=0.95, height=0.5, fontsize=9.5)
        arrow(axes, (x + 0.6, 1.14), (x + 1.52, 1.14), forth, shift=(0, 0.15))
        arrow(axes, (x + 1.52, 0.96), (x + 0.6, 0.96), back, shift=(0.0, -0.24 if "\n" in back else -0.14))
        axes.text(x + 1.0, 0.3, note, ha="center", fontsize=7.5, color=grey)
    save(figure, "modes")
