"""What a run predicts of the failure, and what differences are measured by."""
import numpy as np

# Key -> (name in the study's file, unit, scale from SI).
quantities = {
    "first_time": ("first localisation of the plate", "µs", 1e6), "first_radius": ("place of first localisation", "mm", 1e3),
    "separated_mass": ("separated mass of the plate", "g", 1e3), "outermost_radius": ("outermost localised radius", "mm", 1e3),
    "cylinder_velocity": ("velocity of the cylinder", "m/s", 1.0), "fragments": ("fragments of the plate", "", 1.0),
    "largest_fragment": ("largest fragment of the plate", "g", 1e3), "perforated": ("perforated", "share", 1.0),
    "made": ("energy made by the numerics", "%", 100.0)}
drawn = ("first_time", "first_radius", "separated_mass", "outermost_radius", "cylinder_velocity", "fragments")
# The least that an axis spans, in its unit: a fifth of a wave's way through the plate, a cell, and so on.
matters = {"first_time": 0.17, "first_radius": 1.0, "separated_mass": 1.0, "outermost_radius": 5.0, "cylinder_velocity": 5.0, "fragments": 4.0}


def of_ensemble(study, ensemble):
    """A row of predictions in SI for each member; None where there is none: a run that failed predicts nothing."""
    of = {quantity.name: quantity for quantity in study.quantities}
    return [{key: study.value(name, of[label]) for key, (label, _, _) in quantities.items()} for name in ensemble.cases]


def fragment_masses(outcome):
    """Masses (kg) of the plate's pieces but for the plate itself, largest first; the summary lists a hundred pieces."""
    pieces = sorted((piece["mass"] for piece in outcome.summary["failure"]["fragments"]["list"] if piece["body"] == "plate"), reverse=True)
    return np.array(pieces[1:])


def sizes(study, base):
    """What differences of each prediction are measured by: the scale that the file gives, or its median in the base ensemble. `base`: distributions by key."""
    of = {quantity.name: quantity for quantity in study.quantities}
    return {key: of[label].scale or abs(base[key].get("median", 0.0)) or 1.0 for key, (label, _, _) in quantities.items()}
