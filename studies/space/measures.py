"""What a run says of the plate, and how a measure behaves as cells shrink."""
import math

import numpy as np

from space.cases import short_end

punch, thickness = 5e-3, 5e-3  # m, radius of the cylinder, and of the plate
# Key -> (label, unit, scale from SI).
quantities = {
    "first_time": ("first localisation", "µs", 1e6), "first_radius": ("at r", "mm", 1e3), "first_height": ("at z", "mm", 1e3),
    "early_area": ("crack area at 10 µs", "mm²", 1e6), "crack_area": ("crack area", "mm²", 1e6), "inner_area": ("of it within 1.5 radii of the cylinder", "mm²", 1e6),
    "lower_area": ("of it farther out, in the lower three fifths of the plate", "mm²", 1e6), "strength": ("mean strength", "MPa", 1e-6), "localised_volume": ("localised volume", "mm³", 1e9), "localised_particles": ("localised particles", "", 1.0),
    "fracture": ("fracture energy", "J", 1.0), "cylinder_velocity": ("velocity of the cylinder", "m/s", 1.0), "fragments": ("fragments of the plate", "", 1.0),
    "ringing": ("pressures within cells, of the energy", "%", 100.0), "residual": ("residual", "%", 100.0)}
# What belongs together, in tables that a phone can show.
tables = {"where it begins": ("first_time", "first_radius", "first_height", "early_area", "strength"),
          "how much cracks": ("crack_area", "inner_area", "lower_area", "localised_volume", "localised_particles"),
          "energy and motion": ("fracture", "cylinder_velocity", "fragments", "ringing", "residual")}
drawn = ("first_time", "first_radius", "crack_area", "localised_volume", "fracture", "cylinder_velocity")
shipped_quantities = {key: quantities[key] for key in ("first_time", "first_radius", "first_height", "crack_area", "localised_volume", "fracture", "residual")}


def _of_cracks(results, frame):
    """Of the plate's cracked particles: areas (m²), radii now and heights at the start (m), strengths (Pa)."""
    length = np.nan_to_num(frame["effective_length"])
    which = (results.body == 0) & (length > 0.0)
    density = results.scene["material"]["glass"]["density"]
    return results.mass[which] / density / length[which], np.abs(frame.position[which, 0]), results.frames[0].position[which, 1], frame["cohesive_strength"][which]


def of_run(outcome, last):
    """Row of measures in SI; None where there is none, and of a run to less than `last` (s) what holds of it. A run that failed measures nothing."""
    row, summary = dict.fromkeys(quantities), outcome.summary
    if summary is None or not outcome.complete:
        return row
    plate, cylinder, energy = summary["bodies"]["plate"], summary["bodies"]["cylinder"], summary["energy"]
    first = plate["first_localisation"] or {"time": None, "r": None, "z": None}
    row |= {"first_time": first["time"], "first_radius": first["r"], "first_height": first["z"], "residual": energy["relative_residual"]}
    results = outcome.results
    row |= {"early_area": _of_cracks(results, frame)[0].sum() for frame in results.frames if abs(frame.time - short_end) < 1e-9}
    if summary["time"] < last:
        return row
    area, radius, height, strength = _of_cracks(results, results.frames[-1])
    return row | {
        "crack_area": plate["crack_area"], "inner_area": area[radius < 1.5 * punch].sum(),
        "lower_area": area[(radius >= 1.5 * punch) & (height < 0.6 * thickness)].sum(), "strength": np.average(strength, weights=area) if area.size else None,
        "localised_volume": plate["localised_volume"], "localised_particles": plate["localised"], "fracture": energy["fracture"],
        "cylinder_velocity": cylinder["momentum"][1] / cylinder["mass"], "fragments": plate["fragments"],
        "ringing": energy["ringing"] / energy["initial"]}


def of_shipped(outcome):
    """The same of a shipped scene, of all its bodies."""
    summary = outcome.summary
    if summary is None or not outcome.complete:
        return dict.fromkeys(shipped_quantities)
    bodies, first = summary["bodies"].values(), summary["failure"]["first_localisation"] or {"time": None, "r": None, "z": None}
    total = {key: sum(body[key] or 0.0 for body in bodies) for key in ("crack_area", "localised_volume")}
    return {"first_time": first["time"], "first_radius": first["r"], "first_height": first["z"], **total,
            "fracture": summary["energy"]["fracture"], "residual": summary["energy"]["relative_residual"]}


def statistics(values):
    """Number, median, least and largest of the members that have the measure."""
    values = np.array([value for value in values if value is not None], float)
    if not values.size:
        return {"n": 0, "median": None, "least": None, "most": None}
    return {"n": values.size, "median": float(np.median(values)), "least": float(values.min()), "most": float(values.max())}


lowest_order = 0.6  # below, what is left to go is a guess


signed = ("first_time", "cylinder_velocity", "residual")  # all others cannot be negative


def convergence(stats, signed=True):
    """Of the three finest ensembles over halved cells that have the measure: (order, limit) where the medians approach a limit, and what to call it. The
    scatter of members decides whether a change is one. What cannot be negative (not `signed`) and falls towards less than nothing vanishes."""
    stats = [each for each in stats if each["n"]][-3:]
    if len(stats) < 3:
        return None, None, "–"
    first, second = stats[1]["median"] - stats[0]["median"], stats[2]["median"] - stats[1]["median"]
    scatter = max(each["most"] - each["least"] for each in stats)
    if abs(second) <= scatter:
        return None, stats[2]["median"], "within its scatter"
    if first == 0.0 or not 0.0 < second / first < 1.0:
        return None, None, "no limit seen"
    ratio = second / first
    if -math.log2(ratio) < lowest_order:
        return None, None, "no limit seen"
    limit = stats[2]["median"] + second * ratio / (1.0 - ratio)
    return (-math.log2(ratio), limit, "converges") if signed or limit >= 0.0 else (None, 0.0, "vanishes")
