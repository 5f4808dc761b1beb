"""Timed runs of the program: medians of interleaved repetitions, so that a slow minute of the machine meets all of them."""
import concurrent.futures
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

here = pathlib.Path(__file__).resolve().parent
bar = here / "elastic_bar.toml"
disks = here / "colliding_disks.toml"
reference = here.parent / "paper" / "reference.toml"
# Tension damages at once (eq. 7 has no threshold): flaws so few that it is below 1e-50.
slight_damage = "material.steel.damage={toughness=1e6, k=1e-30, m=6}"
step_of_80k, cell_of_80k = 3.095e-9, 0.078125e-3


class Case:
    """A scene with settings. threads: 0 lets the program choose. processes: so many runs of it side by side. elastic: a run that dissipates
    anything, or localises, is none of this case."""

    def __init__(self, name, scene, settings=(), threads=1, fields=False, processes=1, elastic=False):
        self.name, self.scene, self.settings, self.threads, self.fields = name, scene, list(settings), threads, fields
        self.processes, self.elastic = processes, elastic


def bar_settings(cell, steps):
    """The bar with cells of this side, for a number of steps of 0.2 cells of the wave speed."""
    step = step_of_80k * cell / cell_of_80k
    return [f"space.cell={cell!r}", f"integrator.step={step!r}", f"time.end={step * steps!r}"]


def adaptive_settings(method, cell, steps):
    """The bar with an adaptive method, for as long as so many explicit steps take."""
    return [s for s in bar_settings(cell, steps) if not s.startswith("integrator.step")] + [f'integrator.method="{method}"']


def disks_settings(cells_per_metre, steps):
    """The disks with so many cells a metre, for a number of steps of 0.2 cells of the wave speed."""
    step = 0.2 / cells_per_metre
    return [f"space.cell={1.0 / cells_per_metre!r}", f"integrator.step={step!r}", f"time.end={step * steps!r}"]


def once(program, case):
    """What all processes of a case did: the longest times (s) of loop and process, all particles, steps, the integrator's counts, and the largest memory."""
    with concurrent.futures.ThreadPoolExecutor(case.processes) as pool:
        done = list(pool.map(lambda _: run(program, case), range(case.processes)))
    return {**{key: max(d[key] for d in done) for key in ("seconds", "process", "memory")}, "particles": sum(d["particles"] for d in done),
            "steps": done[0]["steps"], "integrator": done[0]["integrator"]}


def run(program, case):
    """One run: seconds of its time loop and of its process, particles, steps, the integrator's counts, and the largest memory of its process (bytes)."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", case.scene, "--out", folder, "--quiet"]
        if case.threads:
            command += ["--threads", str(case.threads)]
        if not case.fields:
            command += ["--no-fields"]
        for setting in case.settings:
            command += ["--set", setting]
        begun = time.perf_counter()
        done = subprocess.run([sys.executable, "-I", "-S", here / "launch.py", *command], capture_output=True, text=True)
        process = time.perf_counter() - begun
        if done.returncode != 0:
            raise SystemExit(f"{case.name}: exit status {done.returncode}\n{done.stderr}")
        summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
    energy = summary["energy"]
    lost = energy["plastic"] + energy["damage"] + energy["fracture"]
    if case.elastic and (lost > 1e-12 * energy["initial"] or summary["failure"]["localised"] > 0):
        raise SystemExit(f"{case.name}: does not stay elastic: {lost} J of {energy['initial']} lost, {summary['failure']['localised']} localised")
    return {"seconds": summary["wall_seconds"], "process": process, "particles": summary["particles"], "steps": summary["integrator"]["steps"],
            "integrator": summary["integrator"], "memory": int(done.stdout)}


class Timing:
    """What several runs of a case took."""

    def __init__(self, case, runs):
        self.case, self.runs = case, runs
        self.particles, self.steps = runs[0]["particles"], runs[0]["steps"]
        self.seconds, self.whole = ([run[key] for run in runs] for key in ("seconds", "process"))
        self.memory = statistics.median(run["memory"] for run in runs)

    @property
    def work(self):
        return self.particles * self.steps

    @property
    def median(self):
        return statistics.median(self.seconds)

    @property
    def rate(self):
        """Million particle-steps a second."""
        return 1e-6 * self.work / self.median

    @property
    def spread(self):
        """Half the distance of the quartiles, relative to the median."""
        low, _, high = statistics.quantiles(self.seconds, n=4)
        return 0.5 * (high - low) / self.median

    def ratio(self, other):
        """Time a particle-step relative to another case: the median of the ratios of runs that stood next to each other."""
        return statistics.median((a / self.work) / (b / other.work) for a, b in zip(self.seconds, other.seconds))


def measure(program, cases, repetitions):
    """Timings by name. Every repetition runs all cases, forwards and backwards in turn."""
    runs = {case.name: [] for case in cases}
    for repetition in range(repetitions):
        for case in cases if repetition % 2 == 0 else reversed(cases):
            runs[case.name].append(once(program, case))
    return {case.name: Timing(case, runs[case.name]) for case in cases}


def whole_processes(program, repetitions):
    """Seconds of the whole process of the run of `./quickstart`, with its outputs and with as many threads as the program chooses."""
    case = Case("quickstart", reference, ['integrator.scheme="musl"', "integrator.step=2.5e-8"], threads=0, fields=True)
    return measure(program, [case], repetitions)[case.name].whole


def study_seconds(program, counts, end, repetitions):
    """Wall times by number of cases: the reference case to `end` (s), two processes at a time by Snakemake, as studies run theirs."""
    seconds = {count: [] for count in counts}
    for _ in range(repetitions):
        for count in counts:
            with tempfile.TemporaryDirectory() as folder:
                command = ["snakemake", "--snakefile", here / "cases.smk", "--directory", folder, "--cores", "2", "--quiet", "--config",
                           f"cases={count}", f"program={pathlib.Path(program).resolve()}", f"scene={reference}", f"end={end!r}"]
                begun = time.perf_counter()
                done = subprocess.run(command, capture_output=True, text=True)
                seconds[count].append(time.perf_counter() - begun)
                if done.returncode != 0:
                    raise SystemExit(f"{count} cases: exit status {done.returncode}\n{done.stderr}")
    return seconds
