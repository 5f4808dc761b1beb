"""The tables of docs/reports/performance-measurements.md."""
import datetime
import math
import os
import platform
import statistics
import subprocess

import counts
import runs
from roofline import ceilings, median, scene_points


def table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def spread(entries, key):
    values = [entry[key] for entry in entries]
    low, _, high = statistics.quantiles(values, n=4)
    return 0.5 * (high - low) / statistics.median(values)


def percent(part):
    return f"{100 * part:.0f} %"


def version(program):
    """The program's first line about itself."""
    return subprocess.run([program, "--version"], capture_output=True, text=True).stdout.splitlines()[0]


def measured(program):
    """By what, when, of which program and where all was measured."""
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.splitlines()
    processor = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.processor())
    return (f"*Measured by `studies/performance/measure.py`, {datetime.date.today()}; {version[0]}; {' '.join(version[1].split())}; "
            f"{processor.strip()}, {os.cpu_count()} cores.*")


def header(program, repetitions):
    return (f"# Performance: every measurement\n\n{measured(program)}\n\nMedians of {repetitions} runs. The spread is half the distance of the quartiles. "
            "What the figures mean: [performance](performance.md).")


def machine_and_scenes(benchmarks):
    bandwidth, scalar, vector = ceilings(benchmarks)
    flops, moved = counts.flops(4), counts.bytes_moved()
    rows = [(label, f"{rate / 1e6:.1f}", f"{rate * flops / 1e9:.1f}", percent(rate * flops / scalar), percent(rate * flops / vector),
             f"{rate * moved / 1e9:.1f}", percent(rate * moved / bandwidth)) for label, rate in scene_points(benchmarks)]
    text = (f"## Machine and roofline\n\nOne core: memory {bandwidth / 1e9:.1f} GB/s (triad), scalar peak {scalar / 1e9:.1f}, vector peak "
            f"{vector / 1e9:.1f} Gflop/s. The bar with MUSL takes {flops:.0f} flops and {moved} bytes a particle-step (counted, "
            "`studies/performance/counts.py`). Bytes leave the caches only where the scene is larger than these.\n\n")
    text += table(["bar", "M particle-steps/s", "Gflop/s", "of scalar peak", "of vector peak", "GB/s", "of memory"], rows)
    scenes = [(name.removesuffix("/real_time"), f"{median(e, 'items_per_second') / 1e6:.2f}", percent(spread(e, "items_per_second")))
              for name, e in benchmarks.items() if name.startswith(("elastic_bar", "colliding_disks", "reference_run", "large_plate"))]
    return text + "\n\n## Scenes\n\n" + table(["scene", "M particle-steps/s", "spread"], scenes)


def parts_of_a_step(benchmarks):
    names = ("scatter", "gather", "rebuild", "explicit_step", "arkode", "implicit", "klu", "result_output", "checkpoint")
    rows = [(name, e[0].get("label", ""), f"{1e9 / median(e, 'items_per_second'):.1f}", percent(spread(e, "items_per_second")))
            for name, e in benchmarks.items() if name.startswith(names)]
    return "## Parts of a step\n\n" + table(["part", "of", "ns a particle", "spread"], rows)


def responses(benchmarks):
    rows = [(*e[0]["label"].split(", "), f"{1e6 / median(e, 'items_per_second'):.3g}", percent(spread(e, "items_per_second")),
             f"{e[0]['solver_steps']:.3g}") for name, e in benchmarks.items() if name.startswith("response")]
    return "## Responses\n\n" + table(["increment", "method", "us", "spread", "solver steps"], rows)


def required_cases(quick):
    settings = runs.bar_settings(0.625e-3 if quick else 0.15625e-3, 20 if quick else 400)
    models = {
        "damage too small to matter": [runs.slight_damage],
        "von Mises, never reached": ["material.steel.von_mises={yield=1e15, peak=1e15, hardening=0, softening=0}"],
        "Drucker-Prager, never reached": ["material.steel.drucker_prager={yield=1e15, beta=1.0}"],
        "damage too small to matter and decohesion": [runs.slight_damage, "material.steel.decohesion={opening=1e-6, mode_ratio=1.0}"],
    }
    step = float(settings[1].split("=")[1])
    steps = 20 if quick else 400
    cases = [runs.Case("elastic, axisymmetric", runs.bar, settings),
             runs.Case("plane strain (no hoop terms)", runs.bar, [*settings, 'space.geometry="plane-strain"', 'boundary.0.fix.0="y"'])]
    cases += [runs.Case(f"with {name}", runs.bar, settings + more, elastic=True) for name, more in models.items()]
    cases += [runs.Case("with 4 outputs of all fields", runs.bar, [*settings, f"output.every={step * steps / 4!r}"], fields=True),
              runs.Case("gimp", runs.bar, [*settings, 'space.shape_functions="gimp"']),
              runs.Case("bspline2", runs.bar, [*settings, 'space.shape_functions="bspline2"'])]
    return cases


def required(program, repetitions, quick, memory):
    timings = runs.measure(program, required_cases(quick), repetitions)
    base = timings["elastic, axisymmetric"]
    rows = [(name, f"{t.rate:.1f}", percent(t.spread), f"{t.ratio(base):.2f}") for name, t in timings.items()]
    musl = ['integrator.scheme="musl"', "integrator.step=5e-8", "output.every=200e-6"]
    flight = runs.measure(program, [
        runs.Case("free flight (t < 0)", runs.reference, [*musl, "time.end=-0.1e-6"]),
        runs.Case("whole run", runs.reference, [*musl, "time.end=10e-6" if quick else "time.end=150e-6"]),
        runs.Case("whole run, R = 800 mm", runs.reference, [*musl, "time.end=10e-6" if quick else "time.end=150e-6",
                                                            "body.0.box.max.0=0.8", "boundary.0.box.min.0=0.8",
                                                            "boundary.0.box.max.0=0.9"])], repetitions)
    more = [(name, t.particles, t.steps, f"{t.median:.3f}", percent(t.spread), f"{1e9 * t.median / t.work:.0f}")
            for name, t in flight.items()]
    return ("## Only what the scene requires\n\nTime a particle-step relative to the elastic bar, runs side by side.\n\n" +
            table(["scene", "M particle-steps/s", "spread", "ratio"], rows) + "\n\n" +
            table(["reference case", "particles", "steps", "s", "spread", "ns a particle-step"], more) + "\n\n" +
            "Memory:\n\n" + table(["model", "particles", "bytes a particle", "process, MB"], memory))


def memory(program, quick):
    """Rows of model, particles, bytes a particle and megabytes of the process. Bytes: what 3 of 4 particles of the larger scene add to the process."""
    damage = [runs.slight_damage]
    # Both so large that the program itself and its outputs are not what decides.
    large = [0.625e-3, 0.3125e-3] if quick else [0.078125e-3, 0.0390625e-3]
    small = [0.625e-3, 0.3125e-3]  # factors grow faster than the scene
    rows = []
    for name, cells, more in [
            ("elastic", large, []), ("with damage", large, damage),
            ("with damage, Drucker-Prager, decohesion", large,
             [*damage, "material.steel.drucker_prager={yield=1e15, beta=1.0}", "material.steel.decohesion={opening=1e-6, mode_ratio=1.0}"]),
            ("arkode-explicit, elastic", large, ['integrator.method="arkode-explicit"']),
            ("arkode-implicit, elastic", small, ['integrator.method="arkode-implicit"'])]:
        a, b = (runs.once(program, runs.Case(name, runs.bar, runs.bar_settings(cell, 3) + more)) for cell in cells)
        rows.append((name, b["particles"], f"{(b['memory'] - a['memory']) / (b['particles'] - a['particles']):.0f}",
                     f"{b['memory'] / 1e6:.0f}"))
    return rows


def exponent(x, y):
    """Slope of the least-squares line through the logarithms, as text. What grows may be less than what the machine's noise takes away."""
    if min(y) <= 0.0:
        return "lost in the noise"
    lx, ly = [math.log(v) for v in x], [math.log(v) for v in y]
    mx, my = statistics.mean(lx), statistics.mean(ly)
    return f"{sum((a - mx) * (b - my) for a, b in zip(lx, ly)) / sum((a - mx) ** 2 for a in lx):.2f}"


def memory_exponent(timings):
    """Of what scenes take beyond the program itself: those that show among its own megabytes."""
    program_itself = min(t.memory for t in timings)
    large = [t for t in timings if t.memory > program_itself + 2e6]
    return exponent([t.particles for t in large], [t.memory - program_itself for t in large]) if len(large) > 1 else "-"


def growth(program, repetitions, quick, threads):
    cells = [0.625e-3, 0.3125e-3] if quick else [0.625e-3, 0.3125e-3, 0.15625e-3, 0.078125e-3, 0.0390625e-3, 0.01953125e-3]
    steps = {cell: max(60, int(60e6 * (cell / 0.625e-3) ** 2 / 1280)) if not quick else 20 for cell in cells}
    sizes = runs.measure(program, [runs.Case(f"{cell}", runs.bar, runs.bar_settings(cell, steps[cell])) for cell in cells], repetitions)
    rows = [(t.particles, f"{t.rate:.1f}", percent(t.spread), f"{1e6 * t.median / t.steps:.0f}", f"{t.memory / 1e6:.0f}") for t in sizes.values()]
    particles = [t.particles for t in sizes.values()]
    lines = [("particles, time a step", exponent(particles, [t.median / t.steps for t in sizes.values()])),
             ("particles, memory beyond the smallest", memory_exponent(list(sizes.values())))]
    cell = 0.625e-3 if quick else 0.15625e-3
    counted = [20, 40] if quick else [100, 200, 400, 800]
    by_steps = runs.measure(program, [runs.Case(f"{n}", runs.bar, runs.bar_settings(cell, n)) for n in counted], repetitions)
    lines.append(("steps, time", exponent(counted, [t.median for t in by_steps.values()])))
    musl = ['integrator.scheme="musl"', "integrator.step=5e-8", "output.every=200e-6", f"time.end={'0.0' if quick else '50e-6'}"]
    radii = [0.2, 0.4, 0.8]
    by_radius = runs.measure(program, [runs.Case(f"R = {R} m", runs.reference, [
        *musl, f"body.0.box.max.0={R}", f"boundary.0.box.min.0={R}", f"boundary.0.box.max.0={R + 0.1}"]) for R in radii], repetitions)
    lines.append(("radius of the plate at the same impact, time", exponent(radii, [t.median for t in by_radius.values()])))
    cases, what_cases_take = study_cases(program, repetitions, quick)
    lines.append(("cases of a study beyond the first two, time", what_cases_take))
    return ("## Growth\n\n" + table(["particles", "M particle-steps/s", "spread", "us a step", "process, MB"], rows) + "\n\n" +
            table(["what grows", "exponent"], lines) + "\n\n" + cases + "\n\nSpeed relative to one thread:\n\n" +
            table(["scene", "particles", "two threads", "as the program chooses", "two processes of one thread side by side"], threads))


def study_cases(program, repetitions, quick):
    """A table of studies of so many cases, and the exponent of the time that all but the first two of them take."""
    counts = [2, 4, 6] if quick else [2, 4, 8, 16, 32]
    seconds = runs.study_seconds(program, counts, 0.0 if quick else 150e-6, repetitions)
    median = {count: statistics.median(times) for count, times in seconds.items()}
    rows = [(count, f"{median[count]:.1f}", f"{median[count] / count:.2f}") for count in counts]
    more = counts[1:]
    return ("Studies: cases of the reference run, two processes at a time, by Snakemake:\n\n" + table(["cases", "s", "s a case"], rows),
            exponent([count - 2 for count in more], [median[count] - median[2] for count in more]))


def threads(program, repetitions, quick):
    """Rows of scene, particles, and what a second core gives: to a second thread, as the program chooses, and, as the bound that the machine sets, to a
    second process."""
    bars = [0.625e-3] if quick else [0.625e-3, 0.3125e-3, 0.15625e-3, 0.078125e-3, 0.03125e-3]
    scenes = [("bar", runs.bar, runs.bar_settings(cell, 20 if quick else max(20, int(60e6 * (cell / 0.625e-3) ** 2 / 1280))))
              for cell in bars]
    scenes += [] if quick else [("disks", runs.disks, runs.disks_settings(cells, steps)) for cells, steps in [(141, 2500), (282, 1000), (705, 160)]]
    scenes += [] if quick else [(f"bar, {method}", runs.bar, runs.adaptive_settings(method, cell, steps)) for method, all_steps in
                                (("arkode-explicit", (1200, 500, 160)), ("arkode-implicit", (300, 120, 40)))
                                for cell, steps in zip((0.3125e-3, 0.15625e-3, 0.078125e-3), all_steps)]
    scenes += [] if quick else [("reference case, 150 us", runs.reference, ['integrator.scheme="musl"', "integrator.step=2.5e-8"])]
    rows = []
    for name, scene, settings in scenes:
        t = runs.measure(program, [runs.Case("1", scene, settings), runs.Case("2", scene, settings, threads=2),
                                   runs.Case("chosen", scene, settings, threads=0),
                                   runs.Case("side by side", scene, settings, processes=2)], repetitions)
        rows.append((name, t["1"].particles, *(f"{1.0 / t[case].ratio(t['1']):.2f}" for case in ("2", "chosen", "side by side"))))
    return rows
