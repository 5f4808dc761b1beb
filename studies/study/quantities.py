"""What a run predicts: numbers by path in its summary, or formulas of such; what every scene has; what their errors are measured by."""
import ast
import math
import operator
import re
from collections.abc import Callable

import numpy as np
from study.file import Quantity
from study.outcome import StudyError


_operations: dict[type, Callable] = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv, ast.Pow: operator.pow,
               ast.USub: operator.neg, ast.UAdd: operator.pos}
_functions: dict[str, Callable] = {"abs": abs, "sqrt": math.sqrt, "log": math.log, "exp": math.exp, "min": min, "max": max, "hypot": math.hypot}
# A path: names, numbers and quoted names, joined by dots; a name with blanks is quoted: bodies."a name".kinetic.
_path = re.compile(r"""(?<![\w."])[A-Za-z_]\w*(?:\.(?:\w+|"[^"]*"))+""")


def of_run(outcome):
    """summary.json, with what follows from the tables: bodies.NAME.velocity (m/s), .largest_fragment (kg), .elastic (J) and contacts.N.duration (s),
    .impulse; of what can break bodies.NAME.second_fragment (kg: the largest piece beside the main one; 0: there is none), and, where `decohesion` is among the
    fields of the last output, .separated_mass (kg). None: the run left none."""
    summary = outcome.summary
    if summary is None:
        return None
    rows = outcome.results.columns("bodies")
    for name, body in summary["bodies"].items():
        body["velocity"] = [momentum / body["mass"] for momentum in body["momentum"]]
        of = np.flatnonzero(rows["body"] == name)
        for key in ("largest_fragment", "elastic"):
            body[key] = float(rows[key][of[-1]]) if of.size else None
    for piece in sorted((summary["failure"] or {}).get("fragments", {}).get("list", []), key=lambda piece: -piece["mass"]):
        body = summary["bodies"][piece["body"]]
        body["pieces"] = [*body.get("pieces", []), piece["mass"]]
    for body in summary["bodies"].values():
        body["second_fragment"] = next(iter(body.get("pieces", [])[1:]), 0.0)
    last = outcome.results.frames[-1] if outcome.results.frames else None
    if last is not None and "decohesion" in last.names:
        separated = last.separated() * outcome.results.mass
        for number, name in enumerate(outcome.results.bodies):
            summary["bodies"][name]["separated_mass"] = float(separated[outcome.results.body == number].sum())
    if summary["contacts"]:
        table = outcome.results.columns("contacts")
        for pair in summary["contacts"]:
            pair["duration"] = _duration(table, pair["bodies"])
    return summary


def _duration(table, bodies):
    """How long two bodies have pressed on each other (s): from the last row before their impulse grows to the first at which it stays. None: never."""
    of = (table["body_a"] == bodies[0]) & (table["body_b"] == bodies[1])
    time, impulse = table["time"][of], np.hypot(table["impulse_r"][of], table["impulse_z"][of])
    moving = np.flatnonzero(np.diff(impulse) != 0.0)
    return float(time[moving[-1] + 1] - time[moving[0]]) if moving.size else None


# What may be null and has more below, once it has happened; None: whatever the reader says.
_event = ("time", "r", "z", "body")
_below = {"first_damage": _event, "first_localisation": _event, "first_separation": _event, "error_estimate": ("total", "position", "velocity", "strain"), "failure": None, "contacts": None}


def _walk(tree, path):
    above = ""
    for part in re.findall(r'"([^"]*)"|([^."]+)', path):
        key = part[0] or part[1]
        if tree is None:  # of what has not happened the summary has no more
            known = _below.get(above, ())
            if known is not None and key not in known:
                raise StudyError(f"{path!r}: found {key!r}, expected one of {', '.join(known) or 'nothing below'}")
            if known is None:
                return None
            above = key
            continue
        above = key
        try:
            tree = tree[int(key)] if isinstance(tree, list) else tree[key]
        except (KeyError, IndexError, ValueError, TypeError):
            names = ", ".join(tree) if isinstance(tree, dict) else f"0 to {len(tree) - 1}" if isinstance(tree, list) else "nothing below"
            raise StudyError(f"{path!r}: found {key!r}, expected one of {names}") from None
    return tree


def value(source, summary):
    """A number, or None where the run has none (null in the summary, or what a formula makes of one). Raises StudyError for what is no path or formula.

    >>> value('2 * bodies."a name".kinetic / energy.initial', {"bodies": {"a name": {"kinetic": 3.0}}, "energy": {"initial": 4.0}})
    1.5
    """
    found: dict[str, float | None] = {}

    def name(match):
        found[f"path_{len(found)}"] = _walk(summary, match[0])
        return f"path_{len(found) - 1}"

    try:
        tree = ast.parse(_path.sub(name, source).strip().removeprefix("=").strip(), mode="eval").body
    except SyntaxError:
        raise StudyError(f"{source!r} is no path in summary.json and no formula of such; names with blanks are quoted: bodies.\"a name\".kinetic") from None
    if any(each is None for each in found.values()):
        _evaluate_anything(tree, found, source)
        return None
    try:
        result = _evaluate(tree, found, source)
    except (ZeroDivisionError, ValueError, OverflowError):
        return None
    if isinstance(result, bool):
        return float(result)
    if not isinstance(result, (int, float)):
        raise StudyError(f"{source!r} is no number but {type(result).__name__}")
    return float(result)


def _evaluate_anything(tree, found, source):
    """Raises StudyError for what is no formula, whatever its numbers."""
    try:
        _evaluate(tree, {name: 1.0 for name in found}, source)
    except (ArithmeticError, ValueError, TypeError):
        pass


def _evaluate(node, found, source):
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return node.value
    if isinstance(node, ast.Name) and node.id in found:
        return found[node.id]
    if isinstance(node, ast.BinOp) and type(node.op) in _operations:
        return _operations[type(node.op)](_evaluate(node.left, found, source), _evaluate(node.right, found, source))
    if isinstance(node, ast.UnaryOp) and type(node.op) in _operations:
        return _operations[type(node.op)](_evaluate(node.operand, found, source))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _functions and not node.keywords:
        return _functions[node.func.id](*(_evaluate(each, found, source) for each in node.args))
    raise StudyError(f"{source!r}: found {ast.unparse(node)!r}, expected paths in summary.json, numbers, + - * / **, and {', '.join(_functions)}")


def of_every_scene(scene):
    """Per body: velocity along the axis (in plane strain along both), kinetic energy; what can fail: localised, separated, area and volume of cracks, largest fragment, first events."""
    axes = {1: "z"} if scene["space"]["geometry"] == "axisymmetric" else {0: "x", 1: "y"}
    for body in scene["body"]:
        name, path = body["name"], f'bodies."{body["name"]}"'
        for axis, letter in axes.items():
            yield Quantity(f"velocity of {name} along {letter}", f"{path}.velocity.{axis}", unit="m/s")
        yield Quantity(f"kinetic energy of {name}", f"{path}.kinetic", unit="J")
        material = scene["material"][body["material"]]
        if "decohesion" in material:
            yield Quantity(f"localised of {name}", f"{path}.localised")
            yield Quantity(f"separated of {name}", f"{path}.separated")
            yield Quantity(f"crack area of {name}", f"{path}.crack_area", unit="m²" if scene["space"]["geometry"] == "axisymmetric" else "m")
            yield Quantity(f"localised volume of {name}", f"{path}.localised_volume", unit="m³" if scene["space"]["geometry"] == "axisymmetric" else "m²")
            yield Quantity(f"largest fragment of {name}", f"{path}.largest_fragment", unit="kg")
            yield Quantity(f"first localisation of {name}", f"{path}.first_localisation.time", unit="s")
            yield Quantity(f"first separation of {name}", f"{path}.first_separation.time", unit="s")
        elif "damage" in material or "johnson_holmquist" in material:
            yield Quantity(f"first damage of {name}", f"{path}.first_damage.time", unit="s")


def speed_of(scene):
    """The largest speed that the scene gives a body or a boundary (m/s); None: nothing moves at the start."""
    speeds = [math.hypot(*each["velocity"]) for each in [*scene["body"], *scene.get("boundary", [])] if all(isinstance(part, (int, float)) for part in each.get("velocity", ["?"]))]
    return max(speeds, default=0.0) or None


small = 0.01  # of a run's energy: what is less is measured by so much


def scale(quantity, scene, summary):
    """What a quantity's errors are measured by: its own `scale`; of velocities the scene's largest speed, of times its duration; of others their own size in the run of
    this `summary`, but of energies at least a hundredth of what it began with or was given. None: it is zero or absent there, and nothing else tells."""
    time, energy = scene["time"], summary["energy"]
    known = {"m/s": speed_of(scene), "s": time["end"] - time["start"]}
    size = abs(value(quantity.source, summary) or 0.0)
    if quantity.unit == "J":
        size = max(size, small * (energy["initial"] or abs(energy["external"])))
    return quantity.scale or known.get(quantity.unit) or size or None
