"""What a run says of the plate, and how a measure behaves as cells shrink."""
import math

import numpy as np

# Key -> (label, unit, scale from SI).
quantities = {
    "first_time": ("first localisation", "µs", 1e6), "first_radius": ("at r", "mm", 1e3), "first_height": ("at z", "mm", 1e3),
    "crack_area": ("crack area", "mm²", 1e6), "localised_volume": ("localised volume", "mm³", 1e9), "localised_particles": ("localised particles", "", 1.0),
    "fracture": ("fracture energy", "J", 1.0), "cylinder_velocity": ("velocity of the cylinder", "m/s", 1.0), "fragments": ("fragments of the plate", "", 1.0),
    "residual": ("residual", "%", 100.0)}
drawn = ("first_time", "first_radius", "crack_area", "localised_volume", "fracture", "cylinder_velocity")


def of_run(outcome):
    """Row of measures in SI; None where there is none. A run that failed measures nothing."""
    summary = outcome.summary
    if summary is None or not outcome.complete:
        return dict.fromkeys(quantities)
    plate, cylinder, energy = summary["bodies"]["plate"], summary["bodies"]["cylinder"], summary["energy"]
    first = plate["first_localisation"] or {"time": None, "r": None, "z": None}
    return {"first_time": first["time"], "first_radius": first["r"], "first_height": first["z"], "crack_area": plate["crack_area"],
            "localised_volume": plate["localised_volume"], "localised_particles": plate["localised"], "fracture": energy["fracture"],
            "cylinder_velocity": cylinder["momentum"][1] / cylinder["mass"], "fragments": plate["fragments"], "residual": energy["relative_residual"]}


def statistics(values):
    """Number, median, least and largest of the members that have the measure."""
    values = np.array([value for value in values if value is not None], float)
    if not values.size:
        return {"n": 0, "median": None, "least": None, "most": None}
    return {"n": values.size, "median": float(np.median(values)), "least": float(values.min()), "most": float(values.max())}


def convergence(stats):
    """Of three ensembles over halved cells: (order, limit) where the medians approach a limit, and what to call it. The scatter of members decides
    whether a change is one."""
    if len(stats) < 3 or any(each["n"] == 0 for each in stats):
        return None, None, "–"
    first, second = stats[1]["median"] - stats[0]["median"], stats[2]["median"] - stats[1]["median"]
    scatter = max(each["most"] - each["least"] for each in stats[1:])
    if abs(second) <= scatter:
        return None, stats[2]["median"], "within its scatter"
    if first == 0.0 or not 0.0 < second / first < 1.0:
        return None, None, "no limit seen"
    ratio = second / first
    return -math.log2(ratio), stats[2]["median"] + second * ratio / (1.0 - ratio), "converges"
