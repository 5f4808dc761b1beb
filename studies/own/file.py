"""A study file: read, checked, and filled with what it leaves out."""
import difflib
import itertools
import json
import pathlib
import re
import subprocess
import tomllib
from dataclasses import dataclass, field

from study.outcome import StudyError
from vitrum.program import overrides, program

kinds = ("trade", "error-bars", "sweep")
bars = ("time", "local", "space", "chaos")
_keys = {"": {"title": str, "scene": str, "set": dict, "vary": dict, "method": list, "reference": list, "ensemble": dict, "quantity": list, "report": dict, "quick": dict, "longest": float},
         "method": {"name": str, "set": dict, "ladder": dict}, "reference": {"name": str, "set": dict}, "ensemble": {"members": int, "amplitude": float},
         "quantity": {"name": str, "from": str, "scale": float, "unit": str}, "report": {"kinds": list, "sweep_bars": list, "converged": float}, "quick": {"set": dict}}
_named = {str: "a string", dict: "a table", list: "a list", int: "an integer", float: "a number"}


class StudyFileError(StudyError):
    """The study file is wrong: FILE:LINE: what."""


@dataclass(frozen=True)
class Method:
    """`rungs`: (label of the setting, settings), from loose to tight."""
    name: str
    rungs: tuple


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
        """At the first line that names the last part of the key."""
        last = re.escape(key.split("|")[-1])
        lines = [n for n, line in enumerate(self.text.splitlines(), 1) if re.search(rf"""(^|[\s{{,\["']){last}["']?\s*(=|\])""", line)]
        return StudyFileError(f"{self.path}{f':{lines[0]}' if lines else ''}: key '{key.replace('|', '.')}': {what}")

    def check(self, table, section, prefix=""):
        for key, value in table.items():
            known = _keys[section]
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                raise self.fault(prefix + key, f"found an unknown key, expected one of {', '.join(known)}" + (f"; did you mean '{near[0]}'?" if near else ""))
            wanted = (int, float) if known[key] is float else known[key]
            if not isinstance(value, wanted) or isinstance(value, bool):
                raise self.fault(prefix + key, f"found {json.dumps(value, default=str)}, expected {_named[known[key]]}")
        return table

    def tables(self, name, required):
        """The items of a list of tables."""
        for n, item in enumerate(self.table.get(name, [])):
            if not isinstance(item, dict):
                raise self.fault(name, f"found {item!r}, expected tables [[{name}]]")
            self.check(item, name, f"{name}.{n}|")
            for key in required:
                if key not in item:
                    raise self.fault(name, f"[[{name}]] {n} has no key '{key}'")
            yield item


def _methods(reader):
    found = []
    for item in reader.tables("method", ("name",)):
        ladder = item.get("ladder", {})
        lengths = {len(values) for values in ladder.values() if isinstance(values, list)}
        if any(not isinstance(values, list) or not values for values in ladder.values()) or len(lengths) > 1:
            raise reader.fault("ladder", "expected lists of values, all of one length, from loose to tight")
        count = lengths.pop() if lengths else 1
        rungs = tuple((", ".join(f"{key.split('.')[-1]} {_text(values[n])}" for key, values in ladder.items()) or "as it is",
                       {**item.get("set", {}), **{key: values[n] for key, values in ladder.items()}}) for n in range(count))
        found.append(Method(item["name"], rungs))
    names = [method.name for method in found]
    if len(set(names)) < len(names):
        raise reader.fault("method", f"found two methods of one name among {', '.join(names)}")
    return found


def _text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def _report(reader, vary):
    table = reader.table.get("report", {})
    reader.check(table, "report", "report|")
    chosen = table.get("kinds", ["trade", "error-bars", *(["sweep"] if vary else [])])
    for what, words, known in (("kinds", chosen, kinds), ("sweep_bars", table.get("sweep_bars", []), bars)):
        for word in words:
            if word not in known:
                raise reader.fault(f"report|{what}", f"found {word!r}, expected some of {', '.join(known)}")
    if "sweep" in chosen and not vary:
        raise reader.fault("report|kinds", "found 'sweep', but there is no table [vary] of what to vary")
    return table, chosen


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
    vary = table.get("vary", {})
    for key, values in vary.items():
        if not isinstance(values, list) or not values:
            raise reader.fault(key, f"found {values!r}, expected a list of values")
    report, chosen = _report(reader, vary)
    quick_table = reader.check(table.get("quick", {}), "quick", "quick|")
    ensemble = reader.check(table.get("ensemble", {}), "ensemble", "ensemble|")
    members = ensemble.get("members", 10)
    if members < 2:
        raise reader.fault("ensemble|members", f"found {members}, expected at least 2")
    references = [(item.get("name", f"reference {n + 1}"), item["set"]) for n, item in enumerate(reader.tables("reference", ("set",)))]
    if len(references) not in (0, 2):
        raise reader.fault("reference", f"found {len(references)} of [[reference]], expected two, of different methods")
    quantities = [Quantity(item["name"], item["from"], item.get("scale"), item.get("unit", "")) for item in reader.tables("quantity", ("name", "from"))] or None
    study = StudyFile(path, table.get("title", ""), scene, {**table.get("set", {}), **(quick_table.get("set", {}) if quick else {})},
                      {key: ([values[0], values[-1]] if len(values) > 1 else values) for key, values in vary.items()} if quick else vary,
                      _methods(reader), references, min(members, 4) if quick else members, ensemble.get("amplitude", 1e-12), quantities, chosen,
                      report.get("sweep_bars", []), report.get("converged", 0.01), float(table.get("longest", 3600.0)))
    study.resolved = resolved(study.scene, study.settings)
    study.title = study.title or f"Study of {study.resolved.get('title') or scene.stem}"
    if quick:
        study.methods = [Method(method.name, method.rungs[:2]) for method in study.methods]
    return study


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
