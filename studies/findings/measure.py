"""What the findings say of a run."""
import csv
import json
import subprocess

import numpy as np
from study.case import program, studies
from study.outcome import StudyError
from study.tables import number

us, mm = 1e-6, 1e-3


def row(outcome):
    """Of one run: SI but for the names that say otherwise; None where there is nothing to tell."""
    summary = outcome.summary
    energy, plate, cylinder = summary["energy"], summary["bodies"]["plate"], summary["bodies"]["cylinder"]
    return {"status": outcome.status, "until": summary["time"], "max_growth": energy["max_growth"], "residual": energy["relative_residual"],
            "first_steel": cylinder["first_localisation"], "first_glass": plate["first_localisation"], "localised": summary["failure"]["localised"],
            "separated": summary["failure"]["separated"], "outermost": summary["failure"]["localised_radius_max"],
            "cylinder": cylinder["momentum"][1] / cylinder["mass"], "centre": cylinder["centre"][1], "perforated": summary["failure"]["perforated"],
            "steps": summary["integrator"]["steps"], "seconds": summary["wall_seconds"]}


def percent(value, digits=2):
    return number(None if value is None else 100.0 * value, digits)


def time_text(value):
    """Microseconds."""
    return number(value / us)


def ending(found):
    """How a run ended, as a clause."""
    amount = f"{percent(abs(found['residual']))} % of the impact's energy {'made' if found['residual'] < 0.0 else 'lost'} by the numerics"
    if found["status"] == "complete":
        return f"reaches {time_text(found['until'])} µs, with {amount}"
    return f"is stopped by the watchdog at {time_text(found['until'])} µs, with {amount}"


def made(found):
    """For a table: growth and what was made, or when it was stopped."""
    if found["status"] != "complete":
        return f"stopped at {time_text(found['until'])} µs"
    return f"{found['max_growth']:.2f}, {percent(-found['residual'])} %"


def place(first):
    return "none" if first is None else f"{time_text(first['time'])} ({first['r'] / mm:.1f}, {first['z'] / mm:.1f})"


def span(values, scale=1.0, digits=3):
    values = [scale * value for value in values if value is not None]
    return " to ".join(dict.fromkeys(number(value, digits) for value in (min(values), max(values)))) if values else "none"


def kinetic_apart(one, other):
    """Largest relative distance of two runs' kinetic energies, at 1 µs, 10 µs and over all common outputs."""
    count = min(len(one.series("time")), len(other.series("time")))
    time, first, second = one.series("time")[:count], one.series("kinetic")[:count], other.series("kinetic")[:count]
    apart = np.abs(second / first - 1.0)
    return [float(apart[np.argmin(np.abs(time - when))]) for when in (1e-6, 1e-5)] + [float(apart.max())]


def point(name, out, **settings):
    """Columns of `vitrum point` for studies/findings/NAME.toml."""
    overrides = [text for key, value in settings.items() for text in ("--set", f"{key.replace('__', '.')}={value}")]
    done = subprocess.run([program(), "point", studies / "findings" / f"{name}.toml", "--out", out, *overrides], capture_output=True, text=True)
    if done.returncode != 0:
        raise StudyError(f"{name}: exit status {done.returncode}: {done.stderr.strip()}")
    with open(out, newline="") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], np.array(rows[1:], float).T))


def checked(scene):
    """What `vitrum check` says of a scene."""
    done = subprocess.run([program(), "check", "--json", studies / scene], capture_output=True, text=True)
    if done.returncode != 0:
        raise StudyError(f"{scene}: exit status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)
