"""Figures of the study of the paper's cases."""
import matplotlib
import numpy as np
from matplotlib.lines import Line2D
from vitrum.plot import stamp
from vitrum.plot.crack_figures import cracks, fragment_masses, fragments
from vitrum.plot.particle_figures import damage, opening, snapshots
from study.figures import colours, legend_below, plt, save

from paper.sentences import plate_wave

# The paper shows these: (radius, speed) -> times of its panels (µs).
shown = {(200, 200): (50, 90, 100, 150), (200, 800): (50, 100, 150), (400, 200): (50, 100, 150, 250)}
drawn = {"snapshots": snapshots, "damage": damage, "opening": opening, "cracks": cracks, "fragments": fragments, "fragment-masses": fragment_masses}


def paper_figures(outcomes, folder):
    """In the manner of the paper's figures at its times, as far as a run came: all kinds of the resolved run of either reading, the snapshots of the paper's step.
    `outcomes`: by ((radius, speed), treatment). Each is titled by its case: all have the scene of one, and its title."""
    with matplotlib.rc_context({**matplotlib.rcParamsDefault, "backend": "Agg"}):
        for (case, treatment), outcome in outcomes.items():
            for kind in {"b": drawn, "alternative-b": drawn, "a-usf": ["snapshots"]}.get(treatment.key, []) if case in shown else []:
                run, name = outcome.results, f"R{case[0]}-v{case[1]}-{treatment.key}-{kind}"
                run.title = f"R = {case[0]} mm, {case[1]} m/s: {treatment.label}"
                reached = [1e-6 * time for time in shown[case] if 1e-6 * time <= run.frames[-1].time + 1e-9] or [run.frames[-1].time]
                figure = drawn[kind](run, run.frames_at(reached))
                if figure is not None:
                    save(figure, folder, name, stamp.of_run(run))


def space_time(histories, title, folder, name):
    """Where and when the plate has come apart, a panel for each treatment. `histories`: label -> History."""
    count = len(histories)
    columns = min(count, 3)
    rows = -(-count // columns)
    figure, panels = plt.subplots(rows, columns, figsize=(2.75 * columns + 0.7, 2.5 * rows + 0.4), sharex=True, sharey=True, squeeze=False)
    latest = max(history.time[-1] for history in histories.values())
    mesh = None
    for axes, (label, history) in zip(panels.flat, histories.items()):
        axes.grid(False)
        half = 0.5 * np.diff(history.time, append=2 * history.time[-1] - history.time[-2])
        times = 1e6 * np.concatenate([[history.time[0] - half[0]], history.time + half])
        share = np.ma.masked_less(history.separated_share, 1e-9)
        mesh = axes.pcolormesh(1e3 * history.edges, times, share, vmin=0.0, vmax=1.0, cmap="viridis_r", rasterized=True)
        axes.step(1e3 * np.append(history.damage_front, history.damage_front[-1]), times, where="post", color=colours[1], linewidth=1.3,
                  label="damage front")
        reach = 1e3 * history.plate_radius
        # Out and back again from the held rim.
        axes.plot([0, reach, 0], [0, 1e3 * reach / plate_wave, 2e3 * reach / plate_wave], color="black", linewidth=0.8, linestyle="--",
                  label="plate wave and its reflection")
        if history.time[-1] < latest - 1e-9:
            axes.axhspan(1e6 * history.time[-1], 1e6 * latest, color="#EEEEEE", linewidth=0)
            axes.text(0.5 * reach, 0.5e6 * (history.time[-1] + latest), "the run ended", ha="center", va="center", fontsize=8)
        axes.set_title(label)
        axes.set_xlim(0, reach)
        axes.set_ylim(0, 1e6 * latest)
    for axes in panels.flat[count:]:
        axes.set_visible(False)
    for axes in panels[-1]:
        axes.set_xlabel("radius before impact (mm)")
    for axes in panels[:, 0]:
        axes.set_ylabel("time (µs)")
    bar = figure.colorbar(mesh, ax=panels, shrink=0.8, pad=0.015)
    bar.set_label("separated share of each 5-mm ring")
    handles, texts = panels.flat[0].get_legend_handles_labels()
    legend_below(figure, handles, texts)
    figure.suptitle(title, fontsize=10)
    save(figure, folder, name)


def fronts(by_treatment, folder, name):
    """Fronts of D > 0.1 (thick) and of D > 0.001 (thin) over time for every case. `by_treatment`: label -> {(radius, speed): History}."""
    radii = sorted({radius for runs in by_treatment.values() for radius, _ in runs})
    figure, panels = plt.subplots(len(by_treatment), len(radii), figsize=(2.6 * len(radii) + 0.6, 2.3 * len(by_treatment) + 0.8), squeeze=False, sharex=True,
                                  sharey="col")
    speeds = sorted({speed for runs in by_treatment.values() for _, speed in runs})
    for row, (label, runs) in zip(panels, by_treatment.items()):
        for axes, radius in zip(row, radii):
            for n, speed in enumerate(speeds):
                history = runs.get((radius, speed))
                if history is not None:
                    look = {"where": "post", "color": colours[n], "linestyle": ["-", "--", "-."][n]}
                    axes.step(1e6 * history.time, 1e3 * history.damage_front, linewidth=1.8, **look)
                    axes.step(1e6 * history.time, 1e3 * history.first_damage_front, linewidth=0.8, **look)
            axes.plot([0, 1e3 * radius / plate_wave], [0, radius], color="black", linewidth=0.8, linestyle=":")
            axes.set_xlim(0, min(150.0, 1e6 * max(history.time[-1] for history in runs.values())))
            axes.set_ylim(0, 1.05 * radius)
            axes.set_title(f"{label}, R = {radius} mm", fontsize=8)
        row[0].set_ylabel("damage front (mm)")
    for axes in panels[-1]:
        axes.set_xlabel("time (µs)")
    handles = [Line2D([], [], color=colours[n], linestyle=["-", "--", "-."][n], label=f"{speed} m/s") for n, speed in enumerate(speeds)]
    handles += [Line2D([], [], color="black", linewidth=width, linestyle=dash, label=text) for text, width, dash in
                (("D > 0.1", 1.8, "-"), ("D > 0.001", 0.8, "-"), ("plate wave", 0.8, ":"))]
    legend_below(figure, handles)
    save(figure, folder, name)


def energies(histories, title, folder, name):
    """Energy made or lost by the numerics over time."""
    figure, axes = plt.subplots(figsize=(5.6, 3.4))
    for n, (label, history) in enumerate(histories.items()):
        account = history.outcome.results.columns("energy")
        start = account["kinetic"][0] + account["elastic"][0]
        error = np.abs(account["residual"]) / start
        axes.semilogy(1e6 * account["time"], np.where(error > 1e-6, error, np.nan), color=colours[n % len(colours)], linestyle=["-", "--", "-."][n % 3], label=label)
    axes.axhline(1.0, color="black", linewidth=0.8, linestyle=":")
    axes.set_ylim(1e-5, 1e4)
    axes.set_xlabel("time (µs)")
    axes.set_ylabel("|energy residual| / energy of impact")
    axes.set_title(title)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, folder, name)
