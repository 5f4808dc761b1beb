"""Which runs a study is made of: made once, when its file is read, and kept as plan.json; every job looks there."""
import json
import pathlib
import re
import sys

from study.case import Case
from study.outcome import StudyError
from vitrum.program import overrides

from own.file import Method, answer, grid, read

tight_rtol, tight_courant = 1e-7, 0.0125


def _slug(text):
    return re.sub(r"[^a-z0-9.+-]+", "-", text.lower()).strip("-") or "x"


def explicit(courant, scheme="musl"):
    return {"integrator.method": "explicit", "integrator.scheme": scheme, "integrator.courant": courant}


def adaptive(kind, order, rtol):
    return {"integrator.method": f"arkode-{kind}", "integrator.order": order, "integrator.rtol": rtol}


def local(kind, rtol):
    return {"constitutive.method": kind, "constitutive.rtol": rtol, "constitutive.atol": 1e-3 * rtol}


def admitted(study, settings):
    """Whether the program takes the scene so: of what a study proposes itself, that which is refused is left out."""
    return answer(study.scene, {**study.settings, **settings}).returncode == 0


def default_methods(study, quick):
    """MUSL by Courant number, ERK and DIRK of order 3 by rtol, local methods by rtol: as many as the scene admits."""
    count = 2 if quick else None

    def rungs(values, settings):
        return tuple((label, settings(each)) for label, each in [(f"{each:g}", each) for each in values][:count])

    proposed = [Method("MUSL", rungs((0.4, 0.2, 0.1, 0.05), explicit)), Method("ERK 3", rungs((1e-1, 1e-2, 1e-3, 1e-4), lambda rtol: adaptive("explicit", 3, rtol)))]
    if not quick:
        proposed += [Method("DIRK 3", rungs((1e-1, 1e-2, 1e-3), lambda rtol: adaptive("implicit", 3, rtol)))]
        proposed += [Method(f"MUSL, {kind}", rungs((1e-2, 1e-4, 1e-6), lambda rtol, kind=kind: {**explicit(0.2), **local(kind, rtol)})) for kind in ("substep", "cvode")]
    return [method for method in proposed if admitted(study, method.rungs[0][1])]


def default_references(study):
    """Two tight ways of different kinds: Runge-Kutta methods of orders 5 and 3; where the scene admits no ARKODE, two explicit schemes."""
    both = [("ERK 5, rtol 1e-7", adaptive("explicit", 5, tight_rtol)), ("ERK 3, rtol 1e-7", adaptive("explicit", 3, tight_rtol))]
    if all(admitted(study, settings) for _, settings in both):
        return both
    return [(f"{scheme.upper()}, Courant {tight_courant:g}", explicit(tight_courant, scheme)) for scheme in ("musl", "usl")]


def finer_in_time(scene, times):
    """The scene's own method, `times` as fine: in its step, or in its tolerance by 10^times."""
    integrator = scene["integrator"]
    if integrator["method"] == "explicit":
        key = "courant" if "courant" in integrator else "step"
        return {f"integrator.{key}": integrator[key] / 2**times}
    key = "fixed_step" if "fixed_step" in integrator else "rtol"
    return {f"integrator.{key}": integrator[key] / (2**times if key == "fixed_step" else 10.0**times)}


def _with_step(scene, factor):
    """A fixed step keeps its Courant number when the cell changes."""
    integrator = scene["integrator"]
    return {"integrator.step": integrator["step"] * factor} if integrator["method"] == "explicit" and "step" in integrator else {}


def refinements(study):
    """Effort -> (kind of error that it shows, settings): what the error bars are made of."""
    scene = study.resolved
    found = {"half the step" if scene["integrator"]["method"] == "explicit" else "a tenth of the tolerance": ("time", finer_in_time(scene, 1)),
             "a quarter of the step" if scene["integrator"]["method"] == "explicit" else "a hundredth of the tolerance": ("time", finer_in_time(scene, 2))}
    method = scene["constitutive"]["method"]
    if method == "closed-form":
        found["local equations under a tolerance of 1e-6"] = ("local", local("substep", 1e-6))
    else:
        found["a hundredth of the local tolerance"] = ("local", local(method, 1e-2 * scene["constitutive"]["rtol"]))
    found["half the cell"] = ("space", {"space.cell": 0.5 * scene["space"]["cell"], **_with_step(scene, 0.5)})
    finer = {1: 4, 4: 16}
    if all(body["particles_per_cell"] in finer for body in scene["body"]):
        found["four times the particles"] = ("space", {f"body.{n}.particles_per_cell": finer[body["particles_per_cell"]] for n, body in enumerate(scene["body"])})
    smoother = "gimp" if scene["space"]["shape_functions"] != "gimp" else "bspline2"
    found[f"shape functions {smoother}"] = ("space", {"space.shape_functions": smoother})
    return {effort: (kind, settings) for effort, (kind, settings) in found.items() if admitted(study, settings)}


def perturbed(study, member):
    return {f"body.{n}.perturbation": {"amplitude": study.amplitude, "seed": 1000 * n + member} for n in range(len(study.resolved["body"]))}


def _trade(study, quick, add):
    methods = study.methods or default_methods(study, quick)
    references = study.references or default_references(study)
    for name, settings in references:
        add("reference", settings, method=name)
    for method in methods:
        for rung, (label, settings) in enumerate(method.rungs):
            add("ladder", settings, method=method.name, setting=label, rung=rung)


def _bars(study, efforts, kinds, add, point=None, settings=None):
    """The cases of a point's error bars: of the scene itself, or of a point of a sweep."""
    settings = settings or {}
    for effort, (kind, more) in efforts.items():
        if kind in kinds:
            add("refined", {**settings, **more}, effort=effort, kind=kind, point=point)
    if "chaos" in kinds:
        for member in range(1, study.members + 1):
            add("member", {**settings, **perturbed(study, member)}, member=member, point=point)


def make(path, quick):
    """The plan, as JSON takes it: the study's own data, and its cases by name."""
    study = read(path, quick)
    cases = {}

    def add(role, settings, **facts):
        facts = {key: value for key, value in facts.items() if value is not None}
        name = _slug("-".join([role, *(str(facts[key]) for key in ("point", "method", "setting", "effort", "member", "finer") if key in facts)]))
        while name in cases:
            name += "+"
        cases[name] = {"role": role, "settings": {**study.settings, **settings}, **facts}

    add("base", {})
    if "trade" in study.kinds:
        _trade(study, quick, add)
    efforts = refinements(study) if "error-bars" in study.kinds or study.sweep_bars else {}
    if "error-bars" in study.kinds:
        _bars(study, efforts, ("time", "local", "space", "chaos"), add)
        # The same members under a finer step or tolerance: do two settings differ by more than chance?
        for member in range(1, study.members + 1):
            add("member", {**finer_in_time(study.resolved, 1), **perturbed(study, member)}, member=member, finer="finer")
    if "sweep" in study.kinds:
        for n, point in enumerate(grid(study.vary)):
            add("point", point, point=n)
            _bars(study, efforts, study.sweep_bars, add, n, point)
    return {"file": str(study.path), "title": study.title, "scene": str(study.scene), "kinds": study.kinds, "points": grid(study.vary) if "sweep" in study.kinds else [],
            "varied": list(study.vary), "sweep_bars": study.sweep_bars, "converged": study.converged, "members": study.members, "longest": study.longest,
            "quantities": [vars(each) for each in study.quantities] if study.quantities else None, "resolved": study.resolved, "cases": cases}


def write(path, quick, out):
    """plan.json in the study's folder, whole at any moment and left alone where it is the same: jobs look at its time."""
    target = pathlib.Path(out) / "plan.json"
    text = json.dumps(make(path, quick), indent=1)
    if not target.exists() or target.read_text() != text:
        following = target.with_name(".plan.json.next")
        following.write_text(text)
        following.replace(target)
    return json.loads(text)


def main(path, out, quick):
    """Makes the plan; exit status 2 where the file, or the scene with the settings of every case, is wrong."""
    try:
        write(path, quick == "1", out)
    except StudyError as error:
        lines = str(error).splitlines()
        print("\n".join([lines[0] if lines[0].startswith("error: ") else f"error: {lines[0]}", *lines[1:]]), file=sys.stderr)
        return 2
    return 0


def load(out):
    path = pathlib.Path(out) / "plan.json"
    if not path.exists():
        raise StudyError(f"{path}: no such file; studies of a file start with ./quickstart study FILE.toml or vitrum-study FILE.toml")
    return json.loads(path.read_text())


# Only the last state, and of its fields the velocity, unless the study's own settings say otherwise.
lean = {"output.every": 1.0, "output.fields": ["velocity"]}


def case(plan, name):
    entry = plan["cases"][name]
    return Case(name, plan["scene"], {**lean, **entry["settings"]}, longest=plan["longest"])


def typed(settings):
    """The settings as one would type them."""
    return " ".join(overrides(settings))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
