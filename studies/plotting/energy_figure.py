"""The energy account over time."""
import matplotlib.pyplot as plt
import numpy as np

# Okabe and Ito's colours again, in an order that keeps neighbours of the stack apart.
shares = {"kinetic": "#0072B2", "elastic": "#56B4E9", "plastic": "#E69F00", "damage": "#009E73", "fracture": "#D55E00"}
residual_colour = "#000000"


def energy_history(run):
    """Above, where the energy is (stacked); below, every share on a logarithmic scale."""
    account = run.energy
    time = 1e6 * account["time"]
    unit = "J" if run.axisymmetric else "J/m"
    figure, (stack, lines) = plt.subplots(2, 1, sharex=True, figsize=(7.2, 6.4), layout="constrained",
                                          height_ratios=[1.0, 1.2])
    stack.stackplot(time, [account[name] for name in shares], colors=shares.values(), labels=shares.keys(), linewidth=0)
    put_in = account["kinetic"][0] + account["elastic"][0] + account["external"]
    stack.plot(time, put_in, color=residual_colour, linewidth=1.2, linestyle="--", label="initial + external work")
    stack.set_ylim(0.0, 1.1 * max(np.max(put_in), np.max(sum(account[name] for name in shares))))
    stack.set_ylabel(f"energy ({unit})")
    handles, labels = stack.get_legend_handles_labels()
    stack.legend(handles[::-1], labels[::-1], fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)

    scale = max(np.max(np.abs(put_in)), np.max(account["kinetic"]))
    floor = 1e-6 * scale
    for name, colour in shares.items():
        lines.semilogy(time, np.where(account[name] > floor, account[name], np.nan), color=colour, label=name, linewidth=1.6)
    residual = account["residual"]
    for made, style, label in ((False, "-", "residual (lost)"), (True, ":", "residual (created)")):
        part = np.where((residual < 0.0) == made, np.abs(residual), np.nan)
        lines.semilogy(time, np.where(part > floor, part, np.nan), color=residual_colour, linestyle=style, linewidth=1.0,
                       label=label)
    lines.set_ylim(floor, 2.0 * scale)
    lines.set_xlim(time[0], time[-1])
    lines.set_xlabel("time (µs)")
    lines.set_ylabel(f"energy ({unit})")
    lines.grid(True, which="major", linewidth=0.3, color="#CCCCCC")
    lines.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    worst = 100.0 * residual[-1] / scale
    figure.suptitle(f"{run.title}\nEnergy account; residual at the end {worst:+.2f} %" if run.title else "Energy account",
                    fontsize=10)
    return figure
