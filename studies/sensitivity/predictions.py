"""What a run predicts of the failure, and what an ensemble of runs does."""
import h5py
import numpy as np

# Key -> (label, unit, scale from SI). Times are judged by the time of a wave through the plate, others by themselves.
quantities = {
    "first_time": ("first localisation of the plate", "µs", 1e6), "first_radius": ("place of first localisation", "mm", 1e3),
    "separated_mass": ("separated mass of the plate", "g", 1e3), "outermost_radius": ("outermost localised radius", "mm", 1e3),
    "cylinder_velocity": ("velocity of the cylinder", "m/s", 1.0), "fragments": ("fragments of the plate", "", 1.0),
    "largest_fragment": ("largest fragment of the plate", "g", 1e3), "perforated": ("perforated", "share", 1.0),
    "made": ("energy made by the numerics", "%", 100.0)}
drawn = ("first_time", "first_radius", "separated_mass", "outermost_radius", "cylinder_velocity", "fragments")
wave_time = 5e-3 / 5879.0  # s
# The least that an axis spans, in its unit: a fifth of a wave's way through the plate, a cell, and so on.
matters = {"first_time": 0.17, "first_radius": 1.0, "separated_mass": 1.0, "outermost_radius": 5.0, "cylinder_velocity": 5.0, "fragments": 4.0}


def of_run(outcome):
    """Row of predictions in SI; None where there is none. A run that failed predicts nothing but its energy."""
    summary = outcome.summary
    if summary is None or not outcome.complete:
        return dict.fromkeys(quantities)
    plate, cylinder, failure = summary["bodies"]["plate"], summary["bodies"]["cylinder"], summary["failure"]
    first = plate["first_localisation"]
    pieces = sorted((piece["mass"] for piece in failure["fragments"]["list"] if piece["body"] == "plate"), reverse=True)
    with h5py.File(outcome.folder / "result.h5") as result:
        body, mass = result["particles/body"][()], result["particles/mass"][()]
        last = result["steps"][max(result["steps"])]["particles/decohesion"][()]
    separated = (body == 0) & (np.nan_to_num(last) >= 1.0)
    return {"first_time": first and first["time"], "first_radius": first and first["r"], "separated_mass": float(mass[separated].sum()),
            "outermost_radius": plate["localised_radius_max"], "cylinder_velocity": cylinder["momentum"][1] / cylinder["mass"],
            "fragments": plate["fragments"], "largest_fragment": pieces[1] if len(pieces) > 1 else 0.0,
            "perforated": None if failure["perforated"] is None else float(failure["perforated"]),
            "made": -summary["energy"]["relative_residual"]}


def fragment_masses(outcome):
    """Masses (kg) of the plate's pieces but for the plate itself, largest first; the summary lists a hundred pieces."""
    pieces = sorted((piece["mass"] for piece in outcome.summary["failure"]["fragments"]["list"] if piece["body"] == "plate"), reverse=True)
    return np.array(pieces[1:])


def statistics(values):
    """Median, 5 and 95 % of the members, and a 95 % confidence interval of the median (bootstrap)."""
    values = np.array([value for value in values if value is not None], float)
    if not values.size:
        return {"n": 0}
    draws = np.random.default_rng(1).choice(values, (2000, values.size))
    low, high = np.quantile(np.median(draws, axis=1), [0.025, 0.975])
    return {"n": values.size, "median": float(np.median(values)), "p05": float(np.quantile(values, 0.05)), "p95": float(np.quantile(values, 0.95)),
            "median_low": float(low), "median_high": float(high), "mean": float(values.mean()), "std": float(values.std(ddof=1)) if values.size > 1 else 0.0}


def size(key, found):
    """What differences of a prediction are measured by."""
    if key == "first_time":
        return wave_time
    if key in ("perforated", "made"):
        return 1.0
    return abs(found["median"]) or 1.0
