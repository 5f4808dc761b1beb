"""The step of each explicit scheme: in which order the grid and the particles speak."""
from look import arrow, blue, box, green, grey, orange, purple, save, sheet, yellow

project, force, move, strain, again = (("project\n$m_i, v_i$", blue), ("force\n$f_i = -\\Sigma\\, V_p \\sigma_p \\nabla N$", orange), ("move\n$v_p, x_p$", green),
                                       ("strain, stress\n$\\varepsilon_p, \\sigma_p$ from $v_i$", yellow), ("project again\n$v_i$ from the new $v_p$", purple))
schemes = {"USF": [project, strain, force, move], "USL": [project, force, move, strain], "MUSL": [project, force, move, again, strain]}


def draw():
    figure, axes = sheet(8.6, 2.9)
    for row, (name, steps) in enumerate(schemes.items()):
        y = 2.4 - 0.9 * row
        axes.text(0.15, y, name, fontsize=11, fontweight="bold", va="center")
        for n, (text, colour) in enumerate(steps):
            box(axes, 1.5 + 1.55 * n, y, text, colour, width=1.38, height=0.58, fontsize=7.5)
            if n:
                arrow(axes, (1.5 + 1.55 * (n - 1) + 0.69, y), (1.5 + 1.55 * n - 0.69, y))
    axes.text(8.45, 2.4, "strain of old velocities", ha="right", va="center", color=grey, fontsize=8)
    axes.text(8.45, 1.5, "strain of new velocities", ha="right", va="center", color=grey, fontsize=8)
    save(figure, "schemes")
