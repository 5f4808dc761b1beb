"""The energy account over time."""
import matplotlib.pyplot as plt
import numpy as np

from vitrum.plot.looks import page_width

# Okabe and Ito's colours, in an order that keeps neighbours of the stack apart.
shares = {"kinetic": "#0072B2", "elastic": "#56B4E9", "plastic": "#E69F00", "damage": "#009E73", "fracture": "#D55E00"}
others = {"contact": "#F0E442", "friction": "#CC79A7", "filtered": "#999999", "removed": "#000000"}  # shown where there is any
beside = {"fontsize": 8, "loc": "center left", "bbox_to_anchor": (1.0, 0.5), "frameon": False}


def shares_of(account):
    return shares | {name: colour for name, colour in others.items() if np.any(account.get(name, 0.0))}


def _stack(axes, time, account, put_in):
    """Where the energy is: shares on top of each other, and what is missing of, or beyond, what was put in."""
    present = shares_of(account)
    axes.stackplot(time, [account[name] for name in present], colors=present.values(), labels=present.keys(), linewidth=0)
    total = sum(account[name] for name in present)
    axes.fill_between(time, total, put_in, facecolor="none", edgecolor="black", hatch="//////", linewidth=0.0, label="residual")
    axes.plot(time, put_in, color="black", linewidth=1.2, linestyle="--", label="initial + external work")
    axes.set_ylim(0.0, 1.08 * max(np.max(put_in), np.max(total)))
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], **beside)


def _lines(axes, time, account, scale):
    """Every share by itself, six decades down from `scale`."""
    floor = 1e-6 * scale

    def line(values, **style):
        axes.semilogy(time, np.where(values > floor, values, np.nan), **style)

    for name, colour in shares_of(account).items():
        line(account[name], color=colour, linewidth=1.6)
    line(account["residual"], color="black", linewidth=1.0, label="residual: lost")
    line(-account["residual"], color="black", linewidth=1.0, linestyle=":", label="residual: created")
    axes.set_ylim(floor, 2.0 * scale)
    axes.grid(True, which="major", linewidth=0.3, color="#CCCCCC")
    axes.legend(**beside)


def energy_history(run):
    """Above the shares stacked, below each on a logarithmic scale."""
    account = run.columns("energy")
    time = 1e6 * account["time"]
    put_in = account["kinetic"][0] + account["elastic"][0] + account["external"]
    scale = max(np.max(np.abs(put_in)), np.max(account["kinetic"]))
    figure, (stack, lines) = plt.subplots(2, 1, sharex=True, figsize=(page_width, 6.0), layout="constrained", height_ratios=[1.0, 1.2])
    _stack(stack, time, account, put_in)
    _lines(lines, time, account, scale)
    for axes in (stack, lines):
        axes.set_ylabel("energy (J)" if run.axisymmetric else "energy (J/m)")
    lines.set_xlim(time[0], time[-1])
    lines.set_xlabel("time (µs)")
    # As in summary.json: relative to what was put in, however much energy a run has made since.
    reference = max(account["kinetic"][0] + account["elastic"][0], abs(account["external"][-1]))
    percent = 100.0 * account["residual"][-1] / reference if reference > 0.0 else 0.0
    what = f"Energy account; residual at the end {percent:+.3g} %".replace("-", "\u2212")
    figure.suptitle(f"{run.title}\n{what}" if run.title else what, fontsize=10)
    return figure
