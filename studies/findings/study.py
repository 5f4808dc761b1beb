"""The reference case over steps, schemes, models, speeds and local methods; the pictures and numbers of README.md."""
import sys

from study.command import main
from study.outcome import run as compute
from study.page import paper_title
from study.provenance import commit
from study.tables import markdown, number, write_csv

from findings import figures
from findings.cases import (local_cases, model_cases, models, picture_cases, resolved_step, scene, speed_cases, step_cases, us)
from findings.measure import checked, ending, kinetic_apart, made, percent, place, point, row, span

name = "findings"
page = "docs/reports/findings.md"
pictures = "docs/pictures/findings"
# Blocks of other pages that this study writes: page -> template.
blocks = {"README.md": "readme.md"}
rates = (1e1, 1e2, 1e3, 1e4, 1e5)  # 1/s
groups = {"steps": step_cases, "models": model_cases, "speeds": speed_cases, "local": local_cases, "pictures": picture_cases}


def jobs(quick):
    return list(groups)


def cases(quick):
    return [case for group in groups.values() for case in group(quick).values()]


def run(job, quick, out):
    for case in groups[job](quick).values():
        compute(case, out / "runs")


def _step_table(found):
    header = ["scheme", "step (µs)", "status", "until (µs)", "max growth", "residual (%)", "first localisation in steel: µs (r, z mm)", "in glass", "separated",
              "outermost localised (mm)", "cylinder (m/s)"]
    return markdown(header, [[scheme, f"{step / us:g}", each["status"], number(each["until"] / us), f"{each['max_growth']:.3f}", percent(each["residual"]),
                              place(each["first_steel"]), place(each["first_glass"]), each["separated"],
                              number(None if each["outermost"] is None else 1e3 * each["outermost"]), number(each["cylinder"], 4)] for (scheme, step), each in found.items()])


def _model_table(found, complete, quick):
    columns = list(dict.fromkeys((scheme, step) for _, scheme, step in found))
    rows = [[label, *[made(found[label, scheme, step]) for scheme, step in columns]] for label in dict.fromkeys(key[0] for key in found)]
    rows.append(["complete", *[made(complete[key]) if key in complete else "–" for key in columns]])
    return markdown(["models", *[f"{scheme} {step / us:g} µs" for scheme, step in columns]], rows)


def _speed_table(found):
    header = ["V (m/s)", "scheme", "step (µs)", "status", "until (µs)", "max growth", "residual (%)", "separated", "outermost (mm)", "perforated", "centre of the cylinder z (mm)", "cylinder (m/s)"]
    return markdown(header, [[speed, scheme, f"{step / us:g}", each["status"], number(each["until"] / us), f"{each['max_growth']:.3f}", percent(each["residual"]), each["separated"],
                              number(None if each["outermost"] is None else 1e3 * each["outermost"]), {True: "yes", False: "no", None: "–"}[each["perforated"]],
                              number(1e3 * each["centre"]), number(each["cylinder"], 4)] for (speed, scheme, step), each in found.items()])


def _local_table(outcomes, found):
    closed = outcomes["closed-form", None, None]
    rows = []
    for (method, solver, rtol), each in found.items():
        apart = "" if method == "closed-form" else " / ".join(number(value, 2) for value in kinetic_apart(closed, outcomes[method, solver, rtol]))
        rows.append([" ".join(filter(None, (method, solver))), "" if rtol is None else f"{rtol:g}", number(each["seconds"], 2), number(each["first_steel"]["time"] / us, 6), each["localised"],
                     each["separated"], percent(each["residual"]), apart])
    return markdown(["method", "rtol", "seconds", "first localisation (µs)", "localised", "separated", "residual (%)", "kinetic energy apart at 1 µs / 10 µs / most"], rows)


def _of_steps(found):
    resolved = [each for (scheme, step), each in found.items() if scheme != "usl" and step <= resolved_step]
    usl = [each for (scheme, _), each in found.items() if scheme == "usl"]
    return {"usf_paper": ending(found["usf", 2e-7]), "musl_paper": ending(found["musl", 2e-7]), "musl_growth": percent(found["musl", 2e-7]["max_growth"] - 1.0),
            "resolved_from": f"{resolved_step / us:g}", "resolved_residual": percent(max(abs(each["residual"]) for each in resolved)), "resolved_count": len(resolved),
            "steel_times": span([each["first_steel"]["time"] for each in resolved], 1e6), "glass_times": span([each["first_glass"]["time"] for each in resolved], 1e6),
            "glass_radii": span([each["first_glass"]["r"] for each in resolved], 1e3, 2), "glass_heights": span([each["first_glass"]["z"] for each in resolved], 1e3, 2),
            "cylinder_speeds": span([each["cylinder"] for each in resolved], 1.0, 4), "separated_range": span([each["separated"] for each in resolved]),
            "outermost_range": span([each["outermost"] for each in resolved], 1e3),
            "unresolved_separated": ", ".join(str(found[scheme, 2e-7]["separated"]) for scheme in ("usf", "musl")),
            "unresolved_outermost": span([found[scheme, 2e-7]["outermost"] for scheme in ("usf", "musl")], 1e3),
            "usl_count": len(usl), "usl_complete": sum(each["status"] == "complete" for each in usl)}


def _of_models(found, complete):
    strong = [each for (label, _, step), each in found.items() if "steel elastic" in label or label == "all elastic" if step == 2e-7]
    whole = [each for (scheme, step), each in complete.items() if step == 2e-7 and scheme != "usl"]
    return {"strong_count": len(strong), "strong_stopped": sum(each["status"] != "complete" for each in strong), "whole_count": len(whole),
            "whole_stopped": sum(each["status"] != "complete" for each in whole)}


def _of_local(found):
    late = found["closed-form", None, None]["first_steel"]["time"]
    tight = [found[key]["first_steel"]["time"] for key in (("substep", None, 1e-8), ("cvode", "adams", 1e-8)) if key in found]
    return {"tight_apart": number(abs(tight[0] - tight[1]) * 1e9, 2) if len(tight) == 2 else None, "closed_late": number((late - tight[0]) * 1e9, 2) if tight else None,
            "local_localised": span([each["localised"] for each in found.values()]), "local_separated": span([each["separated"] for each in found.values()])}


def _material_curves(out):
    folder = out / "points"
    folder.mkdir(parents=True, exist_ok=True)
    # The mean strain grows by a third of the strain.
    glass = {rate: point("glass", folder / f"glass-{rate:g}.csv", path__time=f"[0.0, {1e-2 / (3.0 * rate)!r}]") for rate in rates}
    steel = point("steel", folder / "steel.csv")
    figures.material_curves(glass, steel, out / "figures")
    peaks = {rate: columns["s_rr"].max() for rate, columns in glass.items()}
    mises = figures.von_mises(steel)
    return {"slow_rate": f"{rates[0]:g}", "fast_rate": f"{rates[-1]:g}", "slow_peak": number(1e-6 * peaks[rates[0]]), "fast_peak": number(1e-6 * peaks[rates[-1]]),
            "steel_peak": number(1e-6 * mises.max())}


def report(quick, out):
    outcomes = {key: {case_key: compute(case, out / "runs") for case_key, case in group(quick).items()} for key, group in groups.items()}
    found = {key: {case_key: row(outcome) for case_key, outcome in group.items()} for key, group in outcomes.items() if key != "pictures"}
    shown = {key: row(outcome) for key, outcome in outcomes["pictures"].items()}
    for key, group in found.items():
        write_csv(out / "tables" / f"{key}.csv", ["case", *next(iter(group.values()))], [{"case": " ".join(map(str, case if isinstance(case, tuple) else (case,))), **each} for case, each in group.items()])
    figures.of_runs({key: outcome.results for key, outcome in outcomes["pictures"].items()}, out / "figures")
    adaptive, musl = shown["adaptive"], found["steps"]["musl", 5e-8]
    return {
        "full": not quick, "paper": paper_title, "steps": _step_table(found["steps"]), "models": _model_table(found["models"], found["steps"], quick),
        "speeds": _speed_table(found["speeds"]), "local": _local_table(outcomes["local"], found["local"]),
        **_of_steps(found["steps"]), **_of_models(found["models"], found["steps"]), **_of_local(found["local"]), **_material_curves(out),
        "unresolved_run": ending(shown["paper-step"]), "adaptive_steps": number(adaptive["steps"]), "adaptive_seconds": number(adaptive["seconds"], 2),
        "adaptive_residual": ending(adaptive), "musl_steps": number(musl["steps"]), "musl_seconds": number(musl["seconds"], 2), "musl_residual": ending(musl),
        "adaptive_outermost": number(1e3 * adaptive["outermost"]), "reference_outermost": number(1e3 * shown["reference"]["outermost"]),
        "reference_pieces": number(outcomes["pictures"]["reference"].summary["failure"]["fragments"]["count"]),
    }


def block_values(quick, out):
    """What README.md says, from the same runs."""
    steps = {key: row(compute(case, out / "runs")) for key, case in step_cases(quick).items()}
    reference = row(compute(picture_cases(quick)["reference"], out / "runs"))
    return {
        "commit": commit(), "ratio": number(checked(scene)["step_to_critical"], 2), "usf_paper": ending(steps["usf", 2e-7]),
        "residual": percent(abs(reference["residual"])),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
