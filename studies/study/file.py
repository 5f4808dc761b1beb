"""A study file: read, checked, and filled with what it leaves out."""
import difflib
import itertools
import json
import pathlib
import re
import tomllib
from dataclasses import dataclass, field, replace

from study.methods import read_methods
from study.reader import Reader, StudyFileError
from study.scene import resolved

kinds = ("trade", "error-bars", "sweep", "methods")
bars = ("time", "local", "space", "chaos")
# Columns of the tables that are no quantity: study.results, study.sweep.
_columns = ("case", "role", "method", "setting", "effort", "kind", "point", "member", "status", "seconds", "steps", "rejected", "rhs_evaluations", "tolerance_idle", "residual",
            "estimate", "message", "settings", "velocity field")


@dataclass(frozen=True)
class Quantity:
    """`source`: a path in summary.json, or a formula of such. `scale`: what its errors are measured by; None: its own size."""
    name: str
    source: str
    scale: float | None = None
    unit: str = ""


@dataclass
class StudyFile:
    path: pathlib.Path
    title: str
    scene: pathlib.Path
    settings: dict  # of every case
    vary: dict
    methods: list
    references: list  # (name, settings): two
    members: int
    amplitude: float  # cells
    quantities: list | None  # None: what every scene has
    kinds: list
    sweep_bars: list
    trade_points: bool  # a trade at each point of `vary`, not of the scene as it is
    repeats: int  # of each rung of a trade, whose median time counts
    converged: float  # relative: a bar that does not matter
    longest: float  # s
    resolved: dict = field(default_factory=dict)  # the scene with `settings`


def _report(reader, vary, methods):
    table = reader.table.get("report", {})
    reader.check(table, "report", "report|")
    chosen = table.get("kinds", ["trade", "error-bars", *(["sweep"] if vary else [])])
    for what, words, known in (("kinds", chosen, kinds), ("sweep_bars", table.get("sweep_bars", []), bars)):
        for word in words:
            if word not in known:
                raise reader.fault(f"report|{what}", f"found {word!r}, expected some of {', '.join(known)}")
    if not chosen:
        raise reader.fault("report|kinds", f"found an empty list, expected some of {', '.join(kinds)}")
    if table.get("trade_points") and not vary:
        raise reader.fault("report|trade_points", "found true, but there is no table [vary] of what to vary")
    if "sweep" in chosen and not vary:
        raise reader.fault("report|kinds", "found 'sweep', but there is no table [vary] of what to vary")
    if "methods" in chosen and not reader.table.get("method"):
        raise reader.fault("report|kinds", "found 'methods', but there is no [[method]]")
    if {"methods", "trade"} & set(chosen) and reader.table.get("method") and not methods:
        raise reader.fault("method.0|quick", "every [[method]] has quick = [], so that a quick study has no methods left; expected some rungs")
    return table, chosen


def _comparable(reader, chosen, trade_points):
    """A trade measures every method against the same references, of the model as it is: at a point, or of the scene."""
    if reader.table.get("variant") and ("trade" in chosen or "methods" not in chosen):
        raise reader.fault("variant.0|variant", "variants are of another model than a trade's references, and no part of other kinds, expected report.kinds = [\"methods\"]; "
                                                "for a trade of the variant, a study file of its own with `set`")
    for prefix, item in reader.tables("method", ("name",)):
        if "only" in item and "trade" in chosen and not trade_points:
            raise reader.fault(prefix + "only", f"a trade of the scene as it is has no points, and would leave {item['name']!r} out, expected report.trade_points = true, or no `only`")


def _vary(reader, quick, quick_table):
    """What varies; a quick study takes the values that it names, or the first and the last."""
    for name, table in (("vary", reader.table.get("vary", {})), ("quick", quick_table.get("vary", {}))):
        for key, values in table.items():
            if not isinstance(values, list) or not values:
                raise reader.fault(f"{name}|{key}", f"found {values!r}, expected a list of values")
    vary = reader.table.get("vary", {})
    for key in quick_table.get("vary", {}):
        if key not in vary:
            raise reader.fault(f"quick|{key}", f"found a key that does not vary, expected one of {', '.join(vary) or 'none: there is no [vary]'}")
    return {key: quick_table.get("vary", {}).get(key, values[:1] + values[1:][-1:]) for key, values in vary.items()} if quick else vary


def _only(reader, quick_table):
    """Points to which a method keeps are some of those that vary."""
    vary = reader.table.get("vary", {})
    for prefix, item in reader.tables("method", ("name",)):
        for key, values in item.get("only", {}).items():
            known = [*vary.get(key, []), *quick_table.get("vary", {}).get(key, [])]
            if key not in vary:
                raise reader.fault(prefix + key, f"found a key that does not vary, expected one of {', '.join(vary) or 'none: there is no [vary]'}")
            if not isinstance(values, list) or not values or any(value not in known for value in values):
                raise reader.fault(prefix + key, f"found {values!r}, expected a list of some of {known}")


def _settings(table):
    """(words of `fault` before the key, settings) of all in the file that changes the scene."""
    yield from (("set|", table.get("set", {})), ("vary|", table.get("vary", {})), ("quick|", table.get("quick", {}).get("set", {})), ("quick|", table.get("quick", {}).get("vary", {})))
    for name in ("method", "variant", "reference"):
        for n, item in enumerate(table.get(name, [])):
            for each in (item, *item.get("rung", [])):
                yield from ((f"{name}.{n}|", each.get(key, {})) for key in ("set", "ladder", "each", "tight"))


def _parameters(reader, scene):
    """The program takes new parameters; in a study one that neither the scene defines nor a formula of the study uses is a slip."""
    try:
        defined = tomllib.loads(scene.read_text(encoding="utf-8")).get("parameters", {})
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError):
        return  # the program says so, with the place
    formulas = [text for _, settings in _settings(reader.table) for text in re.findall(r'"=([^"]*)"', json.dumps(settings, default=str))]
    known = {*defined, *re.findall(r"[A-Za-z_]\w*", " ".join(formulas))}
    for where, settings in _settings(reader.table):
        for key in settings:
            name = key.removeprefix("parameters.")
            if name != key and name not in known:
                near = difflib.get_close_matches(name, defined, 1)
                raise reader.fault(where + key, f"the scene has no such parameter, expected one of {', '.join(defined) or 'none'}" + (f"; did you mean '{near[0]}'?" if near else ""))


def _quantities(reader, vary):
    tables = [item for _, item in reader.tables("quantity", ("name", "from"))]
    reader.twice("quantity", [item["name"] for item in tables], "two quantities of one name")
    for n, item in enumerate(tables):
        if item["name"] in (*_columns, *vary):
            raise reader.fault(f"quantity.{n}|name", f"found {item['name']!r}, which is a column of the tables, expected another name")
    return [Quantity(item["name"], item["from"], item.get("scale"), item.get("unit", "")) for item in tables] or None


def _references(reader):
    """Two, or none: those that the study proposes."""
    tables = [item for _, item in reader.tables("reference", ("set",))]
    references = [(item.get("name", f"reference {n + 1}"), item["set"]) for n, item in enumerate(tables)]
    if len(references) not in (0, 2):
        raise reader.fault("reference", f"found {len(references)} of [[reference]], expected two, of different methods")
    reader.twice("reference", [name for name, _ in references], "two references of one name")
    reader.twice("reference", [settings for _, settings in references], "the same settings twice, expected two of different methods")
    return references


def read(path, quick=False):
    """The study; raises StudyFileError with the place in the study file, or with the program's message where the scene is refused."""
    path = pathlib.Path(path).resolve()
    reader = Reader(path)
    table = reader.check(reader.table, "")
    if "scene" not in table:
        raise StudyFileError(f"{path}: key 'scene' is missing: the scene's file, relative to this one")
    scene = (path.parent / table["scene"]).resolve()
    if not scene.is_file():
        raise reader.fault("scene", f"found {table['scene']!r}, which is no file; expected one relative to {path.parent}")
    quick_table = reader.check(table.get("quick", {}), "quick", "quick|")
    vary, methods = _vary(reader, quick, quick_table), read_methods(reader, quick)
    report, chosen = _report(reader, vary, methods)
    ensemble = reader.check(table.get("ensemble", {}), "ensemble", "ensemble|")
    members = ensemble.get("members", 10)
    _only(reader, quick_table)
    _comparable(reader, chosen, report.get("trade_points", False))
    _parameters(reader, scene)
    fewest = quick_table.get("members", 4)
    if quick:
        methods = [replace(method, rungs=tuple(replace(rung, members=min(rung.members, fewest)) for rung in method.rungs)) for method in methods]
    references, quantities = _references(reader), _quantities(reader, vary)
    study = StudyFile(path, table.get("title", ""), scene, {**table.get("set", {}), **(quick_table.get("set", {}) if quick else {})}, vary,
                      methods, references, min(members, fewest) if quick else members, ensemble.get("amplitude", 1e-12), quantities, chosen,
                      report.get("sweep_bars", []), report.get("trade_points", False), 1 if quick else report.get("repeats", 1), report.get("converged", 0.01),
                      float(table.get("longest", 3600.0)))
    try:
        study.resolved = resolved(study.scene, study.settings)
    except StudyFileError as error:
        raise placed(reader, error) from error
    study.title = study.title or f"Study of {study.resolved.get('title') or scene.stem}"
    return study


def placed(reader, error):
    """The program's refusal of a setting, with the place in the study file before it; of what the scene itself says, as it is."""
    where = _place_of(reader.table, re.findall(r"--set ([\w.]+)=", str(error)))
    return error if where is None else StudyFileError(f"{reader.fault(where, 'the program refuses it:')} {error}")


def _place_of(table, keys):
    """The first of some keys that the file sets, in the words of `fault`."""
    return next((where + key for key in keys for where, settings in _settings(table) if key in settings), None)


def explained(case, fault):
    """What the program says of a case, with the place in the study file: of the setting that it refuses, or of one that varies, where it names none."""
    if not case.told:
        return fault
    reader = Reader(pathlib.Path(case.told))
    varied = [key for key in reader.table.get("vary", {}) if key in case.settings]
    where = _place_of(reader.table, re.findall(r"--set ([\w.]+)=", fault)) or (f"vary|{varied[0]}" if varied else None)
    point = f" at {', '.join(f'{key} = {json.dumps(case.settings[key])}' for key in varied)}" if varied else ""
    return str(reader.fault(where, f"the program refuses the scene{point}:") if where else f"{case.told}: the program refuses the scene:") + " " + fault


def grid(vary):
    """Every combination of the varied values, as settings."""
    return [dict(zip(vary, values)) for values in itertools.product(*vary.values())]
