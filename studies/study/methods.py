"""The methods of a study file: each a ladder of rungs, from loose to tight."""
from dataclasses import dataclass, field, replace

_falling = ("courant", "step", "fixed_step", "max_step", "rtol", "atol", "cell")  # the less, the tighter


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
    is asked for, as lists of varied values; `variant`: the table of the variant that it belongs to, `of`: the method that this repeats."""
    name: str
    rungs: tuple
    title: str = ""
    tight: dict | None = field(hash=False, default=None)
    only: dict = field(hash=False, default_factory=dict)
    variant: dict = field(hash=False, default_factory=dict)
    of: str = ""

    def at(self, point):
        return all(point.get(key) in values for key, values in self.only.items())


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


def _variants(reader, methods):
    """Methods once more with other settings of the scene, named VARIANT-METHOD: those that `methods` names, or all."""
    found, known = [], {method.name: method for method in methods}
    for prefix, item in reader.tables("variant", ("name", "set")):
        title = item.get("title", item["name"])
        for name in item.get("methods", list(known)):
            if name not in known:
                raise reader.fault(prefix + "methods", f"found {name!r}, expected some of {', '.join(known)}")
            method = known[name]
            rungs = tuple(replace(rung, settings={**rung.settings, **item["set"]}) for rung in method.rungs)
            found.append(replace(method, name=f"{item['name']}-{name}", rungs=rungs, title=f"{method.title}, {title}", tight=None, variant=item, of=name))
    return found


def read_methods(reader, quick):
    """A quick study takes the rungs that `quick` counts from 0, or the first two; of none the method is left out."""
    found = []
    for prefix, item in [(prefix, each) for prefix, table in reader.tables("method", ("name",)) for each in _each(reader, prefix, table)]:
        rungs, chosen = _ladder(reader, prefix, item), item.get("quick", [0, 1])
        if any(not isinstance(n, int) or not 0 <= n < len(rungs) for n in item.get("quick", [])):
            raise reader.fault(prefix + "quick", f"found {chosen}, expected numbers of rungs from 0 to {len(rungs) - 1}")
        found.append(Method(item["name"], tuple(rungs[n] for n in chosen if n < len(rungs)) if quick else rungs, item.get("title", item["name"]), item.get("tight"), item.get("only", {})))
    found += _variants(reader, found)
    names = [method.name for method in found]
    if len(set(names)) < len(names):
        raise reader.fault("method", f"found two methods of one name among {', '.join(names)}")
    return [method for method in found if method.rungs]


def _text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)
