"""What performance.md says of the program's aims: each with what was just measured, and whether that meets it."""
import statistics

from linear_solvers import rows as linear_solver_rows
from roofline import median
from tables import table


class Aim:
    """An aim, what was measured, as text, and how far: a share of the aim that is 1 or less if it is met. A share of None: not measured, as with --quick."""

    def __init__(self, name, measured="", share=None):
        self.name, self.measured, self.share = name, measured, share

    @property
    def row(self):
        return self.name, self.measured, "met" if self.share <= 1.0 else "**missed**"


def rate(benchmarks, name):
    """Million particle-steps a second, or None where it did not run."""
    entries = next((entries for key, entries in benchmarks.items() if key.startswith(name)), None)
    return 1e-6 * median(entries, "items_per_second") if entries else None


def at_least(name, aim, value):
    return Aim(name, f"{value:.3g}", aim / value) if value else Aim(name)


def more_particles(benchmarks):
    name = "500k particles at most 20 % slower a particle than 80k"
    slower = {}
    for scene in ("elastic_bar", "colliding_disks"):
        many, some = (rate(benchmarks, f"{scene}/thousand:{thousands}/threads:1") for thousands in (500, 80))
        if many and some:
            slower[scene] = some / many - 1.0
    if len(slower) < 2:
        return Aim(name)
    return Aim(name, f"{100 * slower['elastic_bar']:.0f} % (bar), {100 * slower['colliding_disks']:.0f} % (disks)", max(slower.values()) / 0.2)


def two_cores(threads):
    name = "two cores, explicit steps of 19,990 particles and more: 1.8 times"
    gained = [float(two) for scene, particles, two, *_ in threads if scene in ("bar", "disks") and particles > 19_000]
    return Aim(name, f"{min(gained):.2f} to {max(gained):.2f}: [below](#two-cores)", 1.8 / min(gained)) if gained else Aim(name)


def small_scenes(threads):
    chosen = float(threads[0][3])
    return Aim("threads never slow a small scene down", f"{chosen:.2f} ({threads[0][1]:,} particles, as many threads as the program chooses)", 0.97 / chosen)


def small_columns(memory):
    models = {name: int(size) for name, _, size, _ in memory if not name.startswith("arkode")}
    return Aim("bytes a particle: 400", ", ".join(f"{size} {name}" for name, size in models.items()), max(models.values()) / 400)


def right_hand_side(benchmarks):
    of_a_step = median(benchmarks["explicit_step/scheme:2"], "items_per_second") / median(benchmarks["arkode_explicit_rhs"], "items_per_second")
    return Aim("right-hand side of `arkode-explicit`: 1.3 explicit steps", f"{of_a_step:.2f}", of_a_step / 1.3)


def damaging_increment(benchmarks):
    taken = {e[0]["label"].split(", ")[1]: 1e6 / median(e, "items_per_second") for name, e in benchmarks.items()
             if name.startswith("response") and e[0]["label"].startswith("damaging")}
    return Aim("CVODE at 1e-6, a damaging increment: 30 µs", ", ".join(f"{us:.2g} ({method})" for method, us in taken.items()), taken["CVODE (BDF)"] / 30.0)


def share_of_factors(solvers):
    shares = ", ".join(f"{100 * size.share:.0f} % ({size.particles:,})" for size in solvers)
    return Aim("KLU, factor and solve: half of an implicit step", f"{shares} of so many particles: [below](#klu)", max(s.share for s in solvers) / 0.5)


def all_aims(benchmarks, memory, threads, solvers, whole):
    """In the order of the table; those that --quick does not measure are left out."""
    aims = [
        at_least("bar of 81,920 particles, elastic MUSL, one core: 20 million particle-steps/s", 20.0, rate(benchmarks, "elastic_bar/thousand:80/threads:1")),
        small_columns(memory),
        at_least("complete reference case, one core: 12 million", 12.0, rate(benchmarks, "reference_run")),
        at_least("the same, plate of 800 mm at 800 m/s: 12 million", 12.0, rate(benchmarks, "large_plate")),
        two_cores(threads),
        small_scenes(threads),
        more_particles(benchmarks),
        Aim("reference run of `./quickstart`, whole process: 1 s", f"{statistics.median(whole):.2f} s ({min(whole):.2f} to {max(whole):.2f})", statistics.median(whole)),
        right_hand_side(benchmarks),
        share_of_factors(solvers),
        damaging_increment(benchmarks),
    ]
    return [aim for aim in aims if aim.share is not None]


def blocks(measured, benchmarks, memory, threads, solvers, whole):
    """The text of performance.md's places."""
    aims = all_aims(benchmarks, memory, threads, solvers, whole)
    missed = [aim.name.split(":")[0] for aim in aims if aim.share > 1.0]
    said = {name: rate(benchmarks, bench) for name, bench in (("an elastic bar", "elastic_bar/thousand:80/threads:1"), ("the reference case with all laws", "reference_run"))}
    rates = " and ".join(f"{value:.0f} for {name}" for name, value in said.items() if value)
    answer = f"**Answer.** Million particle-steps a second and core: {rates}. " if rates else ""
    answer += f"{len(aims) - len(missed)} of {len(aims)} aims are met. " + ("Missed: " + "; ".join(missed) + "." if missed else "")
    return (f"<!-- block measured -->\n{measured}\n\nHow fast is a step, what bounds it, and where does it fall short of its aims?\n\n{answer}\n"
            f"<!-- block aims -->\n{table(['aim', 'measured', ''], [aim.row for aim in aims])}\n"
            f"<!-- block linear_solvers -->\n{linear_solver_rows(solvers)}\n")
