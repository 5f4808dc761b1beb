"""Energy that the reference case's steps make, over scheme and step."""
from study.case import Case
from study.outcome import run

ladder = (2e-7, 1.5e-7, 1e-7, 7.5e-8, 5e-8, 2.5e-8, 1.25e-8)  # s
tolerances = (1e-1, 1e-2, 1e-3)


def end(quick):
    """s."""
    return 30e-6 if quick else 150e-6


def cases(quick):
    """(scheme, step or tolerance) -> Case; adaptive runs of order 3 stand for comparison."""
    found = {}
    for scheme in ("usf", "musl") if quick else ("usf", "musl", "usl"):
        for step in (2e-7, 5e-8) if quick else ladder:
            found[scheme, step] = Case(f"energy-{scheme}-{step * 1e6:g}", "paper/reference.toml", {
                "integrator.scheme": scheme, "integrator.step": step, "time.end": end(quick)}, fields=False)
    for rtol in (1e-2,) if quick else tolerances:
        found["erk3", rtol] = Case(f"energy-erk3-{rtol:g}", "paper/reference.toml", {
            "integrator.method": "arkode-explicit", "integrator.order": 3, "integrator.rtol": rtol, "time.end": end(quick)}, fields=False)
    return found


def row(key, case, runs):
    outcome = run(case, runs)
    summary = outcome.summary
    energy = summary["energy"]
    plate = summary["bodies"]["plate"]
    return {"scheme": key[0], "setting": key[1], "status": outcome.status, "until_us": 1e6 * summary["time"],
            "max_growth": energy["max_growth"], "made": None if energy["relative_residual"] is None else -energy["relative_residual"],
            "steps": summary["integrator"]["steps"], "seconds": summary["wall_seconds"], "separated_plate": plate["separated"]}
