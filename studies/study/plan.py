"""Which runs a study is made of: made once, when its file is read, and kept as plan.json; every job looks there. A study of several files (study-KEY.toml) has
a plan of each, plan-KEY.json."""
import json
import pathlib
import re
import sys

from vitrum.errors import Error
from vitrum.program import overrides, studies

from study.case import Case, inputs
from study.file import bars, grid, read
from study.outcome import StudyError
from study.proposals import default_methods, default_references, finer_in_time, perturbed, refinements


def _slug(text):
    return re.sub(r"[^a-z0-9.+-]+", "-", text.lower()).strip("-") or "x"


def _points(study):
    """(number, settings) of each point of what varies."""
    return list(enumerate(grid(study.vary)))


def _trade(study, quick, add):
    methods, references = study.methods or default_methods(study, quick), study.references or default_references(study)
    for point, settings in _points(study) if study.trade_points else [(None, {})]:
        for name, more in references:
            add("reference", {**settings, **more}, method=name, point=point)
        for method in [method for method in methods if method.at(settings)]:
            if method.tight is not None:
                add("tight", {**settings, **method.tight}, method=method.name, point=point)
            for n, rung in enumerate(method.rungs):
                # A job each ladder: repeats are apart in time, so that one disturbance does not meet all.
                add("ladder", {**settings, **rung.settings}, method=method.name, setting=rung.label, rung=n, tightness=rung.tightness, point=point,
                    job=("ladder", point, method.name) if study.repeats > 1 else None)


def _methods(study, add):
    """Every rung of every method at every point."""
    for point, settings in _points(study) if study.vary else [(None, {})]:
        for method in [method for method in study.methods if method.at(settings)]:
            for n, rung in enumerate(method.rungs):
                for member in range(1, rung.members + 1):
                    add("rung", {**settings, **rung.settings, **(perturbed(study, member) if rung.members > 1 else {})}, method=method.name, setting=rung.label, rung=n,
                        tightness=rung.tightness, point=point, **({"member": member, "job": ("rung", point, method.name, rung.label)} if rung.members > 1 else {}))


def _bars(study, kinds, add, point=None, settings={}):
    """The cases of a point's error bars: of the scene itself, or of a point of a sweep."""
    for effort, (kind, more) in (refinements(study, kinds, settings) if set(kinds) - {"chaos"} else {}).items():
        add("refined", {**settings, **more}, effort=effort, kind=kind, point=point)
    if "chaos" in kinds:
        for member in range(1, study.members + 1):
            add("member", {**settings, **perturbed(study, member)}, member=member, point=point)


def make(path, quick):
    """The plan, as JSON takes it: the study's own data, and its cases by name. Cases of the same settings share a run."""
    study = read(path, quick)
    cases: dict[str, dict] = {}
    runs: dict[str, str] = {}

    def add(role, settings, job=None, **facts):
        facts = {key: value for key, value in facts.items() if value is not None}
        name = _slug("-".join([role, *(str(facts[key]) for key in ("point", "method", "setting", "effort", "member", "finer") if key in facts)]))
        while name in cases:
            name += "+"
        settings = {**study.settings, **settings}
        shared = runs.setdefault(json.dumps(settings, sort_keys=True), name)
        cases[name] = {"role": role, "settings": settings, "run": shared, "job": cases[shared]["job"] if shared != name else _job(job, name), **facts}

    if "error-bars" in study.kinds:
        add("base", {})
    if "trade" in study.kinds:
        _trade(study, quick, add)
    if "methods" in study.kinds:
        _methods(study, add)
    if "error-bars" in study.kinds:
        _bars(study, bars, add)
        # Other members, under a finer step or tolerance: do two settings differ by more than chance?
        for member in range(1, study.members + 1):
            add("member", {**finer_in_time(study.resolved, 1), **perturbed(study, study.members + member)}, member=member, finer="finer")
    if "sweep" in study.kinds:
        for n, point in _points(study):
            add("point", point, point=n)
            _bars(study, study.sweep_bars, add, n, point)
    return {"file": str(study.path), "title": study.title, "scene": str(study.scene), "kinds": study.kinds, "points": grid(study.vary) if study.vary else [],
            "varied": list(study.vary), "sweep_bars": study.sweep_bars, "repeats": study.repeats, "converged": study.converged, "members": study.members, "longest": study.longest,
            "titles": {method.name: method.title for method in study.methods}, "variants": {method.name: {**method.variant, "of": method.of} for method in study.methods if method.variant},
            "quantities": [vars(each) for each in study.quantities] if study.quantities else None,
            "resolved": study.resolved, "inputs": inputs(study.scene, [case["settings"] for case in cases.values()]), "cases": cases}


def _job(words, name):
    """Which job of Snakemake computes the run: its own, or one with others."""
    return _slug("-".join(str(word) for word in words if word is not None)) if words else name


def files_of(name):
    """Key -> study file: the one that is named, or those of a study that ships (study.toml, study-KEY.toml; some have none)."""
    if name.endswith(".toml"):
        return {"": pathlib.Path(name)}
    return {path.stem.removeprefix("study").removeprefix("-"): path for path in sorted((studies / name).glob("study*.toml"))}


def write(path, quick, out, key=""):
    """plan.json in the study's folder, whole at any moment and left alone where it is the same: jobs look at its time."""
    target = _place(out, key)
    text = json.dumps({"key": key, **make(path, quick)}, indent=1)
    if not target.exists() or target.read_text() != text:
        following = target.with_name(f".{target.name}.next")
        following.write_text(text)
        following.replace(target)
    return json.loads(text)


def _place(out, key):
    return pathlib.Path(out) / (f"plan-{key}.json" if key else "plan.json")


def main(name, out, quick):
    """Makes the plans; exit status 2 where a file, or the scene with the settings of every case, is wrong."""
    files = files_of(name)
    try:
        for key, path in files.items():
            write(path, quick == "1", out, key)
    except (StudyError, Error) as error:
        lines = str(error).splitlines()
        print("\n".join([lines[0] if lines[0].startswith("error: ") else f"error: {lines[0]}", *lines[1:]]), file=sys.stderr)
        return 2
    for stale in set(pathlib.Path(out).glob("plan*.json")) - {_place(out, key) for key in files}:
        stale.unlink()
    return 0


def load(out, key=""):
    path = _place(out, key)
    if not path.exists():
        raise StudyError(f"{path}: no such file; studies of a file start with ./quickstart study FILE.toml or vitrum-study FILE.toml")
    return json.loads(path.read_text())


def load_all(out):
    """Key -> plan, of every file of the study."""
    return {plan["key"]: plan for path in sorted(pathlib.Path(out).glob("plan*.json")) for plan in [json.loads(path.read_text())]}


# Of the fields only the velocity, unless the study's own settings say otherwise. Times of output stay: steps land on them, so that they are part of the result.
lean = {"output.fields": ["velocity"]}


def case(plan, name):
    """What computes a case: its own run, or the one that it shares."""
    run = plan["cases"][name]["run"]
    settings = plan["cases"][run]["settings"]
    return Case("/".join(filter(None, (plan["key"], run))), plan["scene"], {**lean, **settings}, longest=plan["longest"], told=plan["file"])


def jobs(plan):
    """Job -> names of its runs, each once."""
    found: dict[str, list[str]] = {}
    for name, entry in plan["cases"].items():
        if entry["run"] == name:
            found.setdefault("-".join(filter(None, (plan["key"], entry["job"]))), []).append(name)
    return found


def typed(settings):
    """The settings as one would type them."""
    return " ".join(overrides(settings))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
