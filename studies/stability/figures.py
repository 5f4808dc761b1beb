"""Figures of the stability study."""
import numpy as np
from matplotlib.lines import Line2D
from study.figures import colours, legend_below, markers, plt, save

shapes = ("linear", "gimp", "bspline2")
names = {"usf": "USF", "musl": "MUSL", "usl": "USL", "erk3": "ERK order 3"}


def limits(rows, folder, name):
    """Largest stable step over particle position: theory as lines, measurements as marks."""
    present = [shape for shape in shapes if any(row["shape"] == shape for row in rows)]
    schemes = [scheme for scheme in ("usf", "musl", "usl") if any(row["scheme"] == scheme for row in rows)]
    counts = sorted({row["particles_per_cell"] for row in rows})
    figure, panels = plt.subplots(len(schemes), len(present), figsize=(2.5 * len(present) + 0.6, 1.9 * len(schemes) + 0.7), sharex=True, sharey="row",
                                  squeeze=False)
    for line, scheme in zip(panels, schemes):
        for axes, shape in zip(line, present):
            for n, count in enumerate(counts):
                chosen = sorted((row for row in rows if (row["scheme"], row["shape"], row["particles_per_cell"]) == (scheme, shape, count)),
                                key=lambda row: row["offset"])
                offset = [row["offset"] for row in chosen]
                axes.semilogx(offset, [row["theory"] for row in chosen], color=colours[n], linewidth=1.2)
                axes.semilogx(offset, [row["measured"] for row in chosen], linestyle="", marker=markers[n], markerfacecolor="none", color=colours[n])
            axes.set_title(f"{names[scheme]}, {shape}")
        line[0].set_ylim(0.0, 1.08 * max(max(row["theory"], row["measured"]) for row in rows if row["scheme"] == scheme))
        line[0].set_ylabel("largest stable\nc Δt / h")
    for axes in panels[-1]:
        axes.set_xlabel("offset of the particles (spacings)")
    handles = [Line2D([], [], color=colours[n], marker=markers[n], markerfacecolor="none", label=f"{count} per cell") for n, count in enumerate(counts)]
    handles.append(Line2D([], [], color="black", linewidth=1.2, label="theory"))
    handles.append(Line2D([], [], color="black", marker="o", markerfacecolor="none", linestyle="", label="measured"))
    legend_below(figure, handles)
    save(figure, folder, name)


def growth(rows, folder, name):
    """Growth per cell of travel over the step."""
    present = [shape for shape in shapes if any(row["shape"] == shape for row in rows)]
    counts = sorted({row["particles_per_cell"] for row in rows})
    speeds = sorted({row["speed"] for row in rows})
    figure, panels = plt.subplots(len(counts), len(present), figsize=(2.5 * len(present) + 0.6, 2.2 * len(counts) + 0.7), sharex=True, sharey=True,
                                  squeeze=False)
    for line, count in zip(panels, counts):
        for axes, shape in zip(line, present):
            for n, speed in enumerate(speeds):
                chosen = sorted((row for row in rows if (row["shape"], row["particles_per_cell"], row["speed"], row["scheme"]) == (shape, count, speed, "musl")),
                                key=lambda row: row["step_us"])
                step = np.array([row["step_us"] for row in chosen])
                axes.loglog(step, [row["theory"] - 1.0 for row in chosen], color=colours[n])
                measured = np.array([np.nan if row["measured"] is None else row["measured"] - 1.0 for row in chosen])
                axes.loglog(step, np.where(measured > 0.0, measured, np.nan), linestyle="", marker=markers[n], markerfacecolor="none", color=colours[n])
            axes.set_title(f"{shape}, {count} per cell")
        line[0].set_ylabel("growth per cell − 1")
    for axes in panels[-1]:
        axes.set_xlabel("step (µs)")
        ticks = sorted({round(row["step_us"], 3) for row in rows})
        axes.set_xticks(ticks[:1] + ticks[1::2] if len(ticks) > 4 else ticks)
        axes.set_xticklabels([f"{tick:g}" for tick in axes.get_xticks()])
        axes.minorticks_off()
    handles = [Line2D([], [], color=colours[n], marker=markers[n], markerfacecolor="none", label=f"{speed:.0f} m/s") for n, speed in enumerate(speeds)]
    handles.append(Line2D([], [], color="black", label="theory"))
    handles.append(Line2D([], [], color="black", marker="o", markerfacecolor="none", linestyle="", label="measured"))
    legend_below(figure, handles)
    save(figure, folder, name)


def energy(rows, folder, name):
    """Energy made or lost by the reference case over the step; hollow: stopped by the watchdog. Beyond `most` a mark stands at the edge."""
    most = 1e3
    figure, axes = plt.subplots(figsize=(5.6, 3.4))
    for n, scheme in enumerate([scheme for scheme in ("usf", "musl", "usl") if any(row["scheme"] == scheme for row in rows)]):
        chosen = sorted((row for row in rows if row["scheme"] == scheme and row["made"] is not None), key=lambda row: row["setting"])
        step, made = np.array([1e6 * row["setting"] for row in chosen]), np.minimum(np.abs([100.0 * row["made"] for row in chosen]), most)
        done = np.array([row["status"] == "complete" for row in chosen])
        axes.loglog(step, made, color=colours[n], linewidth=1.0)
        axes.loglog(step[done], made[done], linestyle="", marker=markers[n], color=colours[n])
        axes.loglog(step[~done], made[~done], linestyle="", marker=markers[n], markerfacecolor="white", color=colours[n])
        axes.plot([], [], marker=markers[n], color=colours[n], linewidth=1.0, label=names[scheme])
    axes.plot([], [], linestyle="", marker="o", markerfacecolor="white", color="black", label="hollow: stopped by the\nwatchdog (≥ 1,000 %: at\nthe upper edge)")
    axes.set_ylim(1e-2, 1.6 * most)
    axes.set_xlabel("step (µs)")
    axes.set_ylabel("|energy residual| (% of the impact's)")
    ticks = sorted({1e6 * row["setting"] for row in rows if row["scheme"] != "erk3"})
    axes.set_xticks(ticks)
    axes.set_xticklabels([f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, folder, name)
