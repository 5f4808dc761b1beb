"""The paper's nine cases: which of its sentences does each way of integrating reproduce?"""
import sys

from paper.cases import read
from paper.figures import energies, fronts, paper_figures, shown, space_time
from paper.history import History
from paper.sentences import judge, made_energy, overall, sentences, turns_with
from study import plan as plans
from study.case import as_typed
from study.command import main
from study.files import cases, jobs, run  # noqa: F401
from study.page import paper_title
from study.tables import markdown, number, write_csv

name = "paper"
severe_times = (50, 100, 150)  # µs


def _case_row(radius, speed, treatment, history):
    summary = history.outcome.summary
    plate, cylinder = summary["bodies"]["plate"], summary["bodies"]["cylinder"]
    severe = {time: history.outermost_severe(1e-6 * time) for time in severe_times}
    return {"radius_mm": radius, "speed": speed, "treatment": treatment.key, "status": history.outcome.status,
            "end_us": 1e6 * summary["time"], "steps": summary["integrator"]["steps"], "rejected": summary["integrator"]["rejected"],
            "seconds": summary["wall_seconds"], "max_growth": summary["energy"]["max_growth"],
            "residual": summary["energy"]["relative_residual"],
            "first_decohesion_us": None if history.first_decohesion is None else 1e6 * history.first_decohesion,
            "localised": plate["localised"], "separated": plate["separated"],
            **{f"severe_mm_{time}": None if value is None else 1e3 * value for time, value in severe.items()},
            "largest_opening_mm": None if history.largest_opening_radius is None else 1e3 * history.largest_opening_radius,
            "damage_front_mm": 1e3 * history.damage_front[-1],
            "first_damage_speed": history.front_speed(history.first_damage_front, 30e-6), "front_speed": history.front_speed(history.damage_front, 100e-6),
            "perforated": summary["failure"]["perforated"], "cylinder_velocity": cylinder["momentum"][1] / cylinder["mass"],
            "fragments": summary["failure"]["fragments"]["count"]}


def _sentence_rows(histories, treatments):
    for sentence in sentences:
        row = {"sentence": sentence.key, "case": sentence.case, "text": sentence.text, "criterion": sentence.criterion}
        verdicts, by_reading = [], {}
        for treatment in treatments:
            runs = {key[:2]: history for key, history in histories.items() if key[2] == treatment}
            found, verdict = judge(sentence, runs)
            by_reading[treatment.alternative, treatment.method] = verdict
            if not treatment.alternative and not treatment.probe:
                verdicts.append((treatment.resolved, verdict))
            row |= {f"{treatment.key}": verdict, f"{treatment.key} found": found,
                    f"{treatment.key} energy made": made_energy(sentence, runs) if verdict not in ("–",) else None}
        yield row | {"overall": overall(verdicts), "turns with": ", ".join(turns_with(by_reading)) or "–"}


def _verdict_cell(row, key):
    error = row[f"{key} energy made"]
    if error is None:
        return row[f"{key} found"] or "–"
    amount = f"{number(100 * error, 2)} %" if abs(error) < 10 else f"× {number(error, 1)}"
    return f"{row[key]}: {row[f'{key} found']} ({amount})"


def _sentence_table(rows, treatments):
    treatments = [treatment for treatment in treatments if not treatment.alternative and not treatment.probe]
    header = ["", "case", "the paper says", "counts as the same", *[treatment.label for treatment in treatments], "in all"]
    return markdown(header, [[row["sentence"], row["case"], f"“{row['text']}”", row["criterion"],
                              *[_verdict_cell(row, treatment.key) for treatment in treatments], f"**{row['overall']}**"] for row in rows])


def _reading_table(rows, treatments):
    """Both readings side by side."""
    shown_methods = [key for key in ("b", "alternative-b", "alternative-c-1e-2", "alternative-a-usf") if any(treatment.key == key for treatment in treatments)]
    names = {"b": "reference", "alternative-b": "alternative", "alternative-c-1e-2": "alternative, ERK 3", "alternative-a-usf": "alternative, USF 0.2 µs"}

    def causes(row):
        return f"**{row['turns with']}**" + (" (one ring)" if "chance" in row["turns with"] else "")

    return markdown(["", "the paper says", *[names[key] for key in shown_methods], "turns with"],
                    [[row["sentence"], f"“{row['text']}”", *[_verdict_cell(row, key) for key in shown_methods], causes(row)] for row in rows])


def _case_table(rows, labels):
    times = [time for time in severe_times if any(row[f"severe_mm_{time}"] is not None for row in rows)]
    header = ["R (mm)", "v (m/s)", "treatment", "until (µs)", "steps", "seconds", "energy made (%)", "first decohesion (µs)", "separated",
              f"severe up to, at {' / '.join(map(str, times))} µs (mm)", "damage front (mm)", "perforated", "cylinder (m/s)"]
    return markdown(header, [[int(row["radius_mm"]), int(row["speed"]), labels[row["treatment"]],
                              number(row["end_us"]), row["steps"], number(row["seconds"], 2), number(-100 * row["residual"], 2),
                              number(row["first_decohesion_us"], 3), row["separated"],
                              " / ".join(number(row[f"severe_mm_{time}"]) for time in times), number(row["damage_front_mm"]),
                              {True: "yes", False: "no", None: "–"}[row["perforated"]], number(row["cylinder_velocity"], 4)] for row in rows])


def report(quick, out):
    study, every = read(out)
    treatments = list(dict.fromkeys(treatment for _, _, treatment in every))
    outcomes = {key: study.outcome(case) for key, case in every.items()}
    histories = {key: History(outcome) for key, outcome in outcomes.items() if outcome.summary is not None}  # of a run that was stopped nothing is said
    case_rows = [_case_row(radius, speed, treatment, history) for (radius, speed, treatment), history in histories.items()]
    write_csv(out / "tables" / "cases.csv", list(case_rows[0]), case_rows)
    rows = list(_sentence_rows(histories, treatments))
    write_csv(out / "tables" / "sentences.csv", list(rows[0]), rows)

    figures = out / "figures"
    for radius, speed in {key[:2] for key in every} & set(shown):
        runs = {key[2].label: history for key, history in histories.items() if key[:2] == (radius, speed) and not key[2].probe}
        space_time(runs, f"R = {radius} mm, {speed} m/s", figures, f"space-time-R{radius}-v{speed}")
        energies(runs, f"R = {radius} mm, {speed} m/s", figures, f"energy-R{radius}-v{speed}")
    resolved = [treatment for treatment in treatments if treatment.key in ("b", "c-1e-2", "alternative-b")]
    fronts({treatment.label: {key[:2]: history for key, history in histories.items() if key[2] == treatment} for treatment in resolved},
           figures, "fronts")
    paper_figures({(key[:2], key[2]): history.outcome for key, history in histories.items()}, figures)
    return _page_values(study, every, histories, rows, case_rows, treatments, quick)


def _listed(values):
    texts = [str(value) for value in values]
    return " and ".join(filter(None, [", ".join(texts[:-1]), *texts[-1:]]))


def _page_values(study, every, histories, rows, case_rows, treatments, quick):
    labels = {treatment.key: treatment.label for treatment in treatments}
    counts = {verdict: [row["sentence"] for row in rows if row["overall"] == verdict] for verdict in
              ("reproduced", "depends on the integration", "only with an unresolved step", "only after a blow-up", "not reproduced", "undecided")}
    by_key = {treatment.key: treatment for treatment in treatments}
    own = [row for row in case_rows if not by_key[row["treatment"]].alternative]
    resolved = [row for row in own if by_key[row["treatment"]].resolved]
    unresolved = [row for row in own if row not in resolved]
    other = [row for row in case_rows if by_key[row["treatment"]].alternative and by_key[row["treatment"]].resolved]
    variant = next(iter(study.plan["variants"].values()))
    causes = {cause: [row["sentence"] for row in rows if cause in row["turns with"]] for cause in ("reading", "step", "cell", "chance", "none", "undecided", "–")}
    wins = {key: [row["sentence"] for row in rows if row.get(key) == "yes"] for key in ("b", "alternative-b")}
    decohesion = [row["first_decohesion_us"] for row in resolved if row["speed"] == 200]
    first = plans.case(study.plan, next(case for key, case in every.items() if key[2].key == "b"))
    radii, speeds = (sorted({key[n] for key in every}) for n in (0, 1))
    ends = sorted({round(1e6 * history.outcome.results.scene["time"]["end"]) for history in histories.values()})
    return {
        "full": not quick, "paper": paper_title, "which": "The nine cases" if not quick else f"{number(len(radii) * len(speeds))} of its nine cases",
        "radii": _listed(radii), "speeds": _listed(speeds), "ends": _listed(ends), "latest": ends[-1],
        "resolved_step": f"{1e6 * first.settings['integrator.step']:g}",
        "sentences": _sentence_table(rows, treatments),
        "cases": _case_table(case_rows, labels),
        "counts": markdown(["outcome", "sentences", "which"], [[verdict, len(keys), ", ".join(keys) or "–"] for verdict, keys in counts.items()]),
        "total": len(rows), "reproduced_count": len(counts["reproduced"]), "blown_count": len(counts["only after a blow-up"]),
        "integration_count": len(counts["depends on the integration"]) + len(counts["only with an unresolved step"]),
        "missed_count": len(counts["not reproduced"]), "undecided_count": len(counts["undecided"]),
        "worst_resolved": number(100 * max(abs(row["residual"]) for row in resolved), 2),
        "unresolved_ended": sum(row["status"] != "complete" for row in unresolved),
        "unresolved_count": len(unresolved),
        "unresolved_blown": sum(abs(row["residual"]) > 0.05 for row in unresolved),
        "earliest_decohesion": number(min(decohesion), 3), "latest_decohesion": number(max(decohesion), 3),
        "farthest_resolved": number(max(row["damage_front_mm"] for row in resolved)),
        "farthest_severe": number(1e3 * max(history.separation_front[-1] for key, history in histories.items() if key[2].resolved and not key[2].alternative)),
        "readings": _reading_table(rows, treatments),
        "causes": markdown(["turns with", "statements", "which"], [[cause, len(keys), ", ".join(keys) or "–"] for cause, keys in causes.items() if keys or cause not in ("undecided", "–")]),
        "alternative": variant["title"], "alternative_settings": f"`{plans.typed(variant['set'])}`",
        "reference_hits": len(wins["b"]), "alternative_hits": len(wins["alternative-b"]),
        "gained": ", ".join(key for key in wins["alternative-b"] if key not in wins["b"]) or "none", "lost": ", ".join(key for key in wins["b"] if key not in wins["alternative-b"]) or "none",
        "alternative_worst": number(100 * max(abs(row["residual"]) for row in other), 2),
        "longest": number(study.plan["longest"]), "stopped": _listed(f"R = {radius} mm, {speed} m/s, {treatment.label}" for radius, speed, treatment in every if (radius, speed, treatment) not in histories) or "none",
        "command": as_typed(first),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
