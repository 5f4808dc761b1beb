"""What a study file may hold, and where in it something is wrong."""
import difflib
import json
import re
import tomllib

from study.outcome import StudyError

_keys: dict[str, dict[str, type]] = {"": {"title": str, "scene": str, "set": dict, "vary": dict, "method": list, "variant": list, "reference": list, "ensemble": dict, "quantity": list, "report": dict, "quick": dict, "longest": float},
         "method": {"name": str, "title": str, "each": dict, "set": dict, "ladder": dict, "rung": list, "tight": dict, "only": dict, "quick": list}, "rung": {"name": str, "set": dict, "members": int},
         "variant": {"name": str, "title": str, "set": dict, "methods": list}, "reference": {"name": str, "set": dict}, "ensemble": {"members": int, "amplitude": float}, "quantity": {"name": str, "from": str, "scale": float, "unit": str},
         "report": {"kinds": list, "sweep_bars": list, "trade_points": bool, "repeats": int, "converged": float}, "quick": {"set": dict, "vary": dict, "members": int}}
_least: dict[tuple[str, str], int] = {("", "longest"): 0, ("quantity", "scale"): 0, ("ensemble", "members"): 2, ("ensemble", "amplitude"): 0, ("report", "repeats"): 1, ("report", "converged"): 0,
          ("quick", "members"): 2, ("rung", "members"): 1}  # 0: more than that
_named = {str: "a string", dict: "a table", list: "a list", int: "an integer", float: "a number", bool: "true or false"}


class StudyFileError(StudyError):
    """The study file is wrong: FILE:LINE: what."""


class Reader:
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
