"""A study file: read, checked, and filled with what it leaves out."""
import difflib
import itertools
import json
import pathlib
import re
import subprocess
import tomllib
from dataclasses import dataclass, field, replace

from study.outcome import StudyError
from vitrum.program import overrides, program

kinds = ("trade", "error-bars", "sweep", "methods")
bars = ("time", "local", "space", "chaos")
_keys: dict[str, dict[str, type]] = {"": {"title": str, "scene": str, "set": dict, "vary": dict, "method": list, "reference": list, "ensemble": dict, "quantity": list, "report": dict, "quick": dict, "longest": float},
         "method": {"name": str, "title": str, "each": dict, "set": dict, "ladder": dict, "rung": list, "tight": dict, "only": dict, "quick": list}, "rung": {"name": str, "set": dict, "members": int},
         "reference": {"name": str, "set": dict}, "ensemble": {"members": int, "amplitude": float}, "quantity": {"name": str, "from": str, "scale": float, "unit": str},
         "report": {"kinds": list, "sweep_bars": list, "trade_points": bool, "repeats": int, "converged": float}, "quick": {"set": dict, "vary": dict, "members": int}}
_falling = ("courant", "step", "fixed_step", "max_step", "rtol", "atol", "cell")  # the less, the tighter
# Columns of the tables that are no quantity: study.results, study.sweep.
_columns = ("case", "role", "method", "setting", "effort", "kind", "point", "member", "status", "seconds", "steps", "rejected", "rhs_evaluations", "tolerance_idle", "residual",
            "estimate", "message", "settings", "velocity field")
_least: dict[tuple[str, str], int] = {("", "longest"): 0, ("quantity", "scale"): 0, ("ensemble", "members"): 2, ("ensemble", "amplitude"): 0, ("report", "repeats"): 1, ("report", "converged"): 0,
          ("quick", "members"): 2, ("rung", "members"): 1}  # 0: more than that
_named = {str: "a string", dict: "a table", list: "a list", int: "an integer", float: "a number", bool: "true or false"}


class StudyFileError(StudyError):
    """The study file is wrong: FILE:LINE: what."""


@dataclass(frozen=True)
class Rung:
    """`tightness`: the number that a ladder turns, a step or a tolerance. `members`: of an ensemble; 1: the run as it is."""
    label: str
    settings: dict = field(hash=False)
    tightness: float | None = None
    members: int = 1


@dataclass(frozen=True)
class Method:
    """`rungs` from loose to tight; `tight`: settings of a run of the same kind that the others are measured against besides the references; `only`: points at which it
    is asked for, as lists of varied values."""
    name: str
    rungs: tuple
    title: str = ""
    tight: dict | None = field(hash=False, default=None)
    only: dict = field(hash=False, default_factory=dict)

    def at(self, point):
        return all(point.get(key) in values for key, values in self.only.items())


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


class _Reader:
    def __init__(self, path):
        self.path = path
        try:
            self.text = path.read_text(encoding="utf-8")
            self.table = tomllib.loads(self.text)
        except OSError as error:
            raise StudyFileError(f"{path}: {error.strerror}") from error
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise StudyFileError(f"{path}: {error}") from error

    def fault(self, key, what):
        """At the line of the key `table|key`, or `tables.N|key` of the Nth of a list: the first that names it after the head of its table."""
        table, _, last = key.rpartition("|")
        name, _, number = table.partition(".")
        lines = self.text.splitlines()
        heads = [n for n, line in enumerate(lines) if table and re.match(rf"\s*\[+{re.escape(name)}\]", line)]
        first = heads[min(int(number or 0), len(heads) - 1)] if heads else 0
        named = [n for n, line in enumerate(lines[first:], first + 1) if re.search(rf"""(^|[\s{{,\["']){re.escape(last)}["']?\s*(=|\])""", line)]
        place = named[0] if named else first + 1 if heads else None
        return StudyFileError(f"{self.path}{f':{place}' if place else ''}: key '{key.replace('|', '.')}': {what}")

    def check(self, table, section, prefix=""):
        for key, value in table.items():
            known = _keys[section]
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                raise self.fault(prefix + key, f"found an unknown key, expected one of {', '.join(known)}" + (f"; did you mean '{near[0]}'?" if near else ""))
            wanted: tuple[type, ...] = (int, float) if known[key] is float else (known[key],)
            if not isinstance(value, wanted) or (isinstance(value, bool) and known[key] is not bool):
                raise self.fault(prefix + key, f"found {json.dumps(value, default=str)}, expected {_named[known[key]]}")
            least = _least.get((section, key))
            if least is not None and not (value > 0.0 if least == 0 else value >= least):
                raise self.fault(prefix + key, f"found {value}, expected {'a positive number' if least == 0 else f'at least {least}'}")
        return table

    def twice(self, name, values, what):
        """Refuses a list of tables of which two say the same; at the second."""
        for n, value in enumerate(values):
            if value in values[:n]:
                raise self.fault(f"{name}.{n}|{name}", f"found {what}: {value}")

    def tables(self, name, required):
        """(how `fault` calls its keys, table) of each of a list of tables."""
        for n, item in enumerate(self.table.get(name, [])):
            if not isinstance(item, dict):
                raise self.fault(name, f"found {item!r}, expected tables [[{name}]]")
            self.check(item, name, f"{name}.{n}|")
            for key in required:
                if key not in item:
                    raise self.fault(f"{name}.{n}|{name}", f"[[{name}]] {n} has no key '{key}'")
            yield f"{name}.{n}|", item


def _ladder(reader, prefix, item):
    """The rungs of a method: those of its lists of values, those that are named one by one, or the method as it is."""
    ladder, common = item.get("ladder", {}), item.get("set", {})
    lengths = {len(values) for values in ladder.values() if isinstance(values, list)}
    if any(not isinstance(values, list) or not values for values in ladder.values()) or len(lengths) > 1:
        raise reader.fault(prefix + "ladder", "expected lists of values, all of one length, from loose to tight")
    if "rung" in item and ladder:
        raise reader.fault(prefix + "ladder", f"[[method]] {item['name']!r} has a ladder and [[method.rung]], expected one of both")
    for key, values in ladder.items():
        if key.split(".")[-1] in _falling and any(not isinstance(value, (int, float)) or value >= before for before, value in zip(values, values[1:])):
            raise reader.fault(prefix + key, f"found {values}, expected values that fall: a ladder leads from loose to tight")
    if "rung" in item:
        rows = [reader.check(row, "rung", prefix) for row in item["rung"]]
        return tuple(Rung(row.get("name", str(n)), {**common, **row.get("set", {})}, members=row.get("members", 1)) for n, row in enumerate(rows))
    if not ladder:
        return (Rung("as it is", common),)
    first = next(iter(ladder))
    return tuple(Rung(", ".join(f"{key.split('.')[-1]} {_text(values[n])}" for key, values in ladder.items()), {**common, **{key: values[n] for key, values in ladder.items()}},
                      ladder[first][n] if isinstance(ladder[first][n], (int, float)) else None) for n in range(len(ladder[first])))


def _each(reader, prefix, item):
    """A method for each value of the key in `each`, which stands for {} in its name."""
    if "each" not in item:
        return [item]
    (key, values), *more = item["each"].items() or [(None, None)]
    if more or not isinstance(values, list) or not values or "{}" not in item["name"]:
        raise reader.fault(prefix + "each", f"found {item['each']}, expected one key with a list of values, and {{}} in the method's name")
    return [{**item, "name": item["name"].replace("{}", _text(value)), "set": {**item.get("set", {}), key: value}} for value in values]


def _methods(reader, quick):
    """A quick study takes the rungs that `quick` counts from 0, or the first two; of none the method is left out."""
    found = []
    for prefix, item in [(prefix, each) for prefix, table in reader.tables("method", ("name",)) for each in _each(reader, prefix, table)]:
        rungs, chosen = _ladder(reader, prefix, item), item.get("quick", [0, 1])
        if any(not isinstance(n, int) or not 0 <= n < len(rungs) for n in item.get("quick", [])):
            raise reader.fault(prefix + "quick", f"found {chosen}, expected numbers of rungs from 0 to {len(rungs) - 1}")
        found.append(Method(item["name"], tuple(rungs[n] for n in chosen if n < len(rungs)) if quick else rungs, item.get("title", item["name"]), item.get("tight"), item.get("only", {})))
    names = [method.name for method in found]
    if len(set(names)) < len(names):
        raise reader.fault("method", f"found two methods of one name among {', '.join(names)}")
    return [method for method in found if method.rungs]


def _text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


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
    if "methods" in chosen and not methods:
        raise reader.fault("report|kinds", "found 'methods', but there is no [[method]]")
    return table, chosen


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
    for name in ("method", "reference"):
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
    reader = _Reader(path)
    table = reader.check(reader.table, "")
    if "scene" not in table:
        raise StudyFileError(f"{path}: key 'scene' is missing: the scene's file, relative to this one")
    scene = (path.parent / table["scene"]).resolve()
    if not scene.is_file():
        raise reader.fault("scene", f"found {table['scene']!r}, which is no file; expected one relative to {path.parent}")
    quick_table = reader.check(table.get("quick", {}), "quick", "quick|")
    vary, methods = _vary(reader, quick, quick_table), _methods(reader, quick)
    report, chosen = _report(reader, vary, methods)
    ensemble = reader.check(table.get("ensemble", {}), "ensemble", "ensemble|")
    members = ensemble.get("members", 10)
    _only(reader, quick_table)
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
    key = next((key for key in re.findall(r"--set ([\w.]+)=", str(error))), None)
    where = next((where for where, settings in _settings(reader.table) if key in settings), None)
    return error if where is None else StudyFileError(f"{reader.fault(where + key, 'the program refuses it:')} {error}")


def resolved(scene, settings):
    """The scene as the program reads it; StudyError with its message and place where it is refused."""
    checked = answer(scene, settings)
    if checked.returncode != 0:
        raise StudyFileError(checked.stderr.strip())
    return tomllib.loads(json.loads(checked.stdout)["resolved"])


def answer(scene, settings):
    return subprocess.run([program(), "check", scene, "--json", *overrides(settings)], capture_output=True, text=True)


def grid(vary):
    """Every combination of the varied values, as settings."""
    return [dict(zip(vary, values)) for values in itertools.product(*vary.values())]
