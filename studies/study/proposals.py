"""What a study proposes itself, as far as the program takes it for the scene: ladders, references, and the refinements that error bars are made of."""
from study.methods import Method, Rung
from study.scene import answer, resolved

tight_rtol, tight_courant = 1e-7, 0.0125


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
        return tuple(Rung(f"{each:g}", settings(each), each) for each in values[:count])

    proposed = [Method("MUSL", rungs((0.4, 0.2, 0.1, 0.05), explicit)), Method("ERK 3", rungs((1e-1, 1e-2, 1e-3, 1e-4), lambda rtol: adaptive("explicit", 3, rtol)))]
    if not quick:
        proposed += [Method("DIRK 3", rungs((1e-1, 1e-2, 1e-3), lambda rtol: adaptive("implicit", 3, rtol)))]
        proposed += [Method(f"MUSL, {kind}", rungs((1e-2, 1e-4, 1e-6), lambda rtol, kind=kind: {**explicit(0.2), **local(kind, rtol)})) for kind in ("substep", "cvode")]
    return [method for method in proposed if admitted(study, method.rungs[0].settings)]


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


def refinements(study, kinds, point):
    """Effort -> (kind of error that it shows, settings): what the error bars of these kinds are made of, at a point."""
    scene = resolved(study.scene, {**study.settings, **point}) if point else study.resolved
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
    return {effort: (kind, settings) for effort, (kind, settings) in found.items() if kind in kinds and admitted(study, {**point, **settings})}


def perturbed(study, member):
    return {f"body.{n}.perturbation": {"amplitude": study.amplitude, "seed": 1000 * n + member} for n in range(len(study.resolved["body"]))}
