"""The two systems of differential equations: unknowns on particles, and unknowns on nodes."""
import numpy as np

from look import arrow, blue, grey, orange, save, sheet


def cloud(axes, left, filled_nodes):
    """Four by three cells with particles of a deformed block; which of them carry the unknowns is solid."""
    for x in range(5):
        axes.plot([left + 0.6 * x] * 2, [1.2, 3.0], color=grey, linewidth=0.6)
    for y in range(4):
        axes.plot([left, left + 2.4], [1.2 + 0.6 * y] * 2, color=grey, linewidth=0.6)
    x, y = np.meshgrid(left + 0.6 * (np.arange(4) + 0.5) + 0.06, 1.2 + 0.6 * (np.arange(3) + 0.5))
    x, y = (x + 0.05 * np.sin(3 * y)).ravel(), (y + 0.06 * np.cos(2 * x)).ravel()
    nodes = np.array([(left + 0.6 * i, 1.2 + 0.6 * j) for i in range(5) for j in range(4)])
    axes.scatter(x, y, s=60, color="none" if filled_nodes else orange, edgecolor=orange, zorder=3)
    axes.scatter(*nodes.T, s=34, marker="s", color=blue if filled_nodes else "none", edgecolor=blue, zorder=3)
    for px, py in zip(*((nodes.T) if filled_nodes else (x, y))):
        arrow(axes, (px, py), (px + 0.2, py - 0.11), colour=blue if filled_nodes else orange)


def draw():
    figure, axes = sheet(8.4, 3.6)
    for left, title, filled, text in (
            (0.8, "particles: arkode-explicit", False, "$x_p' = \\Sigma N v_i,\\;\\; v_p' = \\Sigma N f_i/m_i,\\;\\; e_p' = R^T D R$\nthe grid is scratch:\nevery stage projects anew"),
            (5.2, "grid: arkode-implicit", True, "$u_i' = v_i,\\quad v_i' = \\Sigma_j\\, M_{ij}\\, f_j(u)/(m_i m_j)$\nparticles keep their places for a phase,\nthen take over what the nodes have")):
        axes.text(left + 1.2, 3.3, title, ha="center", fontsize=11, fontweight="bold")
        cloud(axes, left, filled)
        axes.text(left + 1.2, 0.48, text, ha="center", va="center", fontsize=10, linespacing=1.5)
    save(figure, "systems")
