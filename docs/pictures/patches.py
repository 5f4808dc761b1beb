"""Contact: patches of two surfaces that face each other, and the pressure between them over their penetration."""
import numpy as np
from matplotlib.patches import Rectangle

from look import blue, grey, orange, plt, save


def draw():
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.2, 3.1), width_ratios=(1.6, 1), layout="constrained")
    left.set(xlim=(0, 6.4), ylim=(0, 3.2))
    left.set_aspect("equal")
    left.axis("off")
    for colour, base, rows, direction, shift in ((blue, 1.35, (0.35, -0.65), 1, 0.0), (orange, 1.65, (1.65, 2.65), -1, 0.37)):
        for n in range(5):
            x = 0.5 + n + shift
            for row in rows:
                left.add_patch(Rectangle((x - 0.5, row), 1, 1, facecolor=colour + "14", edgecolor=colour, linewidth=0.5))
                if 0 < row + 0.5 < 3.4:
                    left.plot(x, row + 0.5, "o", color=colour, markersize=5)
            left.plot([x - 0.46, x + 0.46], [base] * 2, color=colour, linewidth=3.2, solid_capstyle="butt")
            if n == 2:
                left.annotate("", (x, base + 0.55 * direction), (x, base), arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.4})
                left.text(x - 0.1 * direction, base + 0.42 * direction, "$n_a$" if direction > 0 else "$n_b$", color=colour, va="center",
                          ha="right" if direction > 0 else "left", fontsize=12)
                left.plot([x, x], [base - 0.5 * direction, base], color=colour, linewidth=0.9, linestyle=":")
    left.annotate("", (1.08, 1.65), (1.08, 1.35), arrowprops={"arrowstyle": "<->", "shrinkA": 0, "shrinkB": 0})
    left.text(1.18, 1.5, "gap g", va="center", fontsize=10)
    left.text(5.42, 2.5, "body b", color=orange, va="center", fontsize=10)
    left.text(5.06, 0.5, "body a", color=blue, va="center", fontsize=10)
    p = np.linspace(0, 2.1, 400)
    right.axhline(0, color="black", linewidth=0.6)
    right.plot(p, np.select([p < 0.5, p < 1.5, p < 2.0], [p, 1 - p, p - 2], 0.0), color=grey)  # src/mpm/contact/pair_law.hpp, Barrier
    right.set(xlabel="penetration / depth", ylabel="pressure / (k depth)", xlim=(0, 2.1), ylim=(-0.6, 0.75), xticks=[0, 0.5, 1, 1.5, 2], yticks=[-0.5, 0, 0.5])
    right.text(0.5, 0.57, "pressed back", ha="center", fontsize=9)
    right.text(1.5, 0.12, "let through: gets\nits energy back", ha="center", va="bottom", fontsize=9)
    save(figure, "patches")
