"""The step of each explicit scheme: in which order the grid and the particles speak."""
from look import arrow, blue, box, green, grey, orange, purple, save, sheet, yellow

project, force, move, strain, again = (("project\n$m_i, v_i$", blue), ("force\n$f_i = -\\Sigma\\, V_p \\sigma_p \\nabla N$", orange), ("move\n$v_p, x_p$", green),
                                       ("strain, stress\n$\\varepsilon_p, \\sigma_p$ from $v_i$", yellow), ("project again\n$v_i$ from the new $v_p$", purple))
schemes = {"USF": [project, strain, force, move], "USL": [project, force, move, strain], "MUSL": [project, force, move, again, strain]}


def draw():
    figure, axes = sheet(8.6, 3.1)
    for row, (name, steps) in enumerate(schemes.items()):
        y = 2.6 - 1.0 * row
        axes.text(0.15, y, name, fontsize=11, fontweight="bold", va="center")
        for n, (text, colour) in enumerate(steps):
            box(axes, 1.45 + 1.53 * n, y, text, colour, width=1.4, height=0.66, fontsize=9)
            if n:
                arrow(axes, (1.45 + 1.53 * (n - 1) + 0.7, y), (1.45 + 1.53 * n - 0.7, y))
    axes.text(8.45, 2.6, "strain from\nold velocities", ha="right", va="center", color=grey, fontsize=9)
    axes.text(8.45, 1.6, "strain from\nnew velocities", ha="right", va="center", color=grey, fontsize=9)
    save(figure, "schemes")
