"""How the runs of the study's files end: energy made by the reference case over scheme and step, and extremes."""


def _end(study, name):
    """What a run came to, whether it failed or not; a run that was stopped has no summary."""
    outcome = study.outcome(name)
    summary = outcome.summary
    if summary is None:
        return {"status": outcome.status, "message": outcome.message}
    energy, integrator = summary["energy"], summary["integrator"]
    made = energy["relative_residual"]
    return {"status": outcome.status, "until_us": 1e6 * summary["time"], "steps": integrator["steps"], "max_growth": energy["max_growth"],
            "made": None if made is None else -made, "seconds": summary["wall_seconds"], "message": summary["message"] or ""}


def of_energy(study):
    """A row for each scheme and step (s), or tolerance."""
    for name in study.named_any("rung"):
        case, summary = study.cases[name], study.outcome(name).summary
        yield {"scheme": case["method"], "setting": case["tightness"], **_end(study, name), "separated_plate": summary and summary["bodies"]["plate"]["separated"]}


def of_extremes(*studies):
    """A row for each extreme."""
    for study in studies:
        for name in study.named_any("rung"):
            yield {"extreme": study.cases[name]["setting"], **_end(study, name)}
