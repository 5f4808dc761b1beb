"""Pictures of the findings."""
import matplotlib
import numpy as np
from vitrum.plot import stamp
from vitrum.plot.crack_figures import cracks, fragment_masses, fragments
from vitrum.plot.energy_figure import energy_history
from vitrum.plot.looks import page_width
from vitrum.plot.panels import Panel
from vitrum.plot.particle_figures import damage, in_a_row, side_by_side, snapshots
from vitrum.plot.views import View
from study.figures import colours, plt, save

reference_times = (-15e-6, 20e-6, 50e-6, 150e-6)  # s
impact = View(-40e-3, 40e-3, -30e-3, 20e-3)  # m: where the cylinder goes through


def of_runs(runs, folder):
    """`runs`: name -> runs of the cases that have pictures."""
    with matplotlib.rc_context({**matplotlib.rcParamsDefault, "backend": "Agg"}):
        reference = runs["reference"]
        frames, last = reference.frames_at(reference_times), reference.frames_at(reference_times[1:])
        for name, figure in (("reference_case", snapshots(reference, frames)), ("reference_case_in_a_row", in_a_row(reference, frames, impact)),
                             ("cracks", cracks(reference, last[:1] + last[-1:])),
                             ("fragments", fragments(reference, last[:1] + last[-1:])), ("fragment-masses", fragment_masses(reference, last)),
                             ("damage", damage(reference, last[:1] + last[-1:]))):
            save(figure, folder, name, stamp.of_run(reference))
        unresolved = runs["paper-step"]
        reached = [time for time in (20e-6, 50e-6, 100e-6, 150e-6) if time <= unresolved.frames[-1].time + 1e-9]
        save(snapshots(unresolved, unresolved.frames_at(reached)), folder, "paper_step", stamp.of_run(unresolved))
        save(energy_history(runs["musl-paper-step"]), folder, "paper_step_energy", stamp.of_run(runs["musl-paper-step"]))
        labels = {"reference": "MUSL 0.025 µs", "adaptive": "ERK 3, rtol 1e-2", "paper-step": "USF 0.2 µs"}
        panels = [Panel(runs[name], frame, f"{label}, t = {1e6 * frame.time:.3g} µs") for time in (20e-6, 50e-6, 150e-6) for name, label in labels.items()
                  for frame in runs[name].frames_at([min(time, runs[name].frames[-1].time)])]
        save(side_by_side(panels, "Explicit steps and adaptive integration"), folder, "side_by_side")


def von_mises(columns):
    rr, zz, tt, rz = (columns[f"s_{name}"] for name in ("rr", "zz", "tt", "rz"))
    return np.sqrt(0.5 * ((rr - zz) ** 2 + (zz - tt) ** 2 + (tt - rr) ** 2) + 3.0 * rz**2)


def material_curves(glass, steel, folder):
    """Stress and damage over strain. `glass`: rate (1/s) -> columns of the path; `steel`: columns."""
    figure, (stress, harm, ductile) = plt.subplots(1, 3, figsize=(page_width, 3.0))
    for n, (rate, columns) in enumerate(glass.items()):
        look = {"color": colours[n], "linestyle": ["-", "--", "-.", ":", (0, (5, 1, 1, 1))][n % 5]}
        # Until it has separated, and the fall to zero where that comes at once.
        bearing = np.cumsum(columns["decohesion"] >= 1.0) <= 1
        stress.plot(100.0 * columns["e_rr"][bearing], 1e-6 * columns["s_rr"][bearing], label=f"1e{np.log10(rate):.0f} /s", **look)
        harm.plot(100.0 * columns["e_rr"][bearing], columns["damage"][bearing], **look)
        localised = np.flatnonzero(columns["effective_length"] > 0.0)
        if localised.size:
            for axes, values in ((stress, 1e-6 * columns["s_rr"]), (harm, columns["damage"])):
                axes.plot(100.0 * columns["e_rr"][localised[0] - 1], values[localised[0] - 1], marker="o", markersize=3.5, color=colours[n])
    mises = von_mises(steel)
    ductile.plot(100.0 * steel["e_rr"], 1e-6 * mises, color="black")
    localised = np.flatnonzero(steel["effective_length"] > 0.0)
    if localised.size:
        ductile.plot(100.0 * steel["e_rr"][localised[0] - 1], 1e-6 * mises[localised[0] - 1], marker="o", markersize=3.5, color="black")
    stress.set_title("glass, uniaxial strain")
    harm.set_title("its damage")
    ductile.set_title("steel, pure shear")
    stress.set_ylabel("stress (MPa)")
    harm.set_ylabel("damage D (–)")
    ductile.set_ylabel("von Mises stress (MPa)")
    for axes in (stress, harm, ductile):
        axes.set_xlabel("strain (%)")
        axes.set_xlim(left=0.0)
        axes.set_ylim(bottom=0.0)
    stress.legend(title="mean rate", fontsize=7.5)
    save(figure, folder, "material_curves")
