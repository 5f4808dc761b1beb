"""Which reading of the paper explains its results? Combinations of readings under several integrations, judged by the statements of the study of the paper."""
import json
import sys

import numpy as np
from paper.history import History
from paper.sentences import judge, made_energy, sentences
from study.command import main
from study.outcome import run as compute
from study.page import paper_title
from study.tables import markdown, number, write_csv

from readings import analysis, figures
from readings.cases import cases_of, ensembles, integrations, points, reference, resolved, shown
from readings.factors import by_key, departures, factors, full, words

name = "readings"
sound = 0.05  # of the impact's energy: a verdict counts where the numerics have made or lost less by then
significant = 0.05


def jobs(quick):
    return [point.name for point in points(quick)]


def cases(quick):
    return [case for point in points(quick) for case in cases_of(point, quick).values()]


def run(job, quick, out):
    """The runs of a point, and its verdicts. What was stopped has no summary: nothing is said of it."""
    point = next(point for point in points(quick) if point.name == job)
    outcomes = {key: compute(case, out / "runs") for key, case in cases_of(point, quick).items()}
    histories = {key: History(outcome) for key, outcome in outcomes.items() if outcome.summary is not None}
    verdicts = {}
    for sentence in sentences:
        found, verdict = judge(sentence, histories)
        made = made_energy(sentence, histories) if verdict != "–" else None
        verdicts[sentence.key] = {"verdict": verdict, "found": found, "made": made}
    path = out / "verdicts" / f"{job}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(verdicts, indent=1))


def hit(verdict, lenient=False):
    """Whether a statement comes out as the text says, with a sound account; lenient: or after a blow-up."""
    if verdict["verdict"] == "yes":
        return lenient or abs(verdict["made"]) <= sound
    return lenient and verdict["verdict"] == "blown up"


class Verdicts:
    """Of all points; statements that no point can judge are left out."""

    def __init__(self, quick, out):
        self.points = points(quick)
        self.of = {point: json.loads((out / "verdicts" / f"{point.name}.json").read_text()) for point in self.points}
        self.statements = [each for each in sentences if any(verdicts[each.key]["verdict"] != "–" for verdicts in self.of.values())]

    def part(self, part, *ways):
        return [point for point in self.points if point.part == part and (not ways or point.integration in ways)]

    def hits(self, chosen, lenient=False):
        """Statements x points."""
        return np.array([[hit(self.of[point][each.key], lenient) for point in chosen] for each in self.statements])

    def number_of_hits(self, point, lenient=False):
        return sum(hit(self.of[point][each.key], lenient) for each in self.statements)

    def table(self, statement, ways):
        """Rows of the design x integrations."""
        rows = list(dict.fromkeys(point.row for point in self.part("design")))
        found = {(point.row, point.integration): hit(self.of[point][statement.key]) for point in self.part("design")}
        return np.array([[float(found[row, way]) for way in ways] for row in rows])


def _ways(verdicts):
    present = {point.integration for point in verdicts.part("design")}
    return [way for way in integrations if way in present]


def _shares(verdicts):
    """Statement -> shares of its verdict's variance; None: it does not vary."""
    ways = _ways(verdicts)
    again = {point.row: point for point in verdicts.part("member")}
    rows = [n for n, row in enumerate(dict.fromkeys(point.row for point in verdicts.part("design"))) if row in again]
    found = {}
    for each in verdicts.statements:
        second = np.array([float(hit(verdicts.of[point][each.key])) for point in again.values()])
        found[each.key] = analysis.shares(verdicts.table(each, ways)[rows], second, ways.index(resolved))
    return found


def _cell_changes(verdicts):
    """Statement -> (verdicts that finer cells change, of how many)."""
    coarse = {point.row: point for point in verdicts.part("design", resolved)}
    pairs = [(point, coarse[point.row]) for point in verdicts.part("cell")]
    return {each.key: (sum(hit(verdicts.of[a][each.key]) != hit(verdicts.of[b][each.key]) for a, b in pairs), len(pairs)) for each in verdicts.statements}


def _effects(verdicts, out):
    ways = _ways(verdicts)
    rows = np.array(list(dict.fromkeys(point.row for point in verdicts.part("design"))))
    means = np.array([verdicts.table(each, ways).mean(axis=1) for each in verdicts.statements])
    effects = analysis.main_effects(means, rows)
    write_csv(out / "tables" / "effects.csv", ["statement", "factor", "share", "p", "levels"],
              [{"statement": verdicts.statements[s].key, "factor": factors[f].key, **effect, "levels": " ".join(f"{value:.2f}" for value in effect["levels"])}
               for (s, f), effect in effects.items()])
    return effects


def _interactions(verdicts, out):
    """Of the full factorial: statement -> {factors: share}."""
    chosen = verdicts.part("full")
    columns = [n for n, factor in enumerate(factors) if factor.key in full]
    if not chosen:
        return {}
    rows = np.array([[point.row[n] for n in columns] for point in chosen])
    found = {}
    for each, values in zip(verdicts.statements, verdicts.hits(chosen).astype(float)):
        if np.var(values) > 0.0:
            found[each.key] = {" × ".join(factors[columns[n]].label for n in of): share for of, share in analysis.factorial_effects(values, rows).items()}
    write_csv(out / "tables" / "interactions.csv", ["statement", "factors", "share"],
              [{"statement": key, "factors": of, "share": share} for key, shares in found.items() for of, share in shares.items()])
    return found


def _best_readings(verdicts, lenient):
    """Least departures for most hits, over all points: with a resolved step, or (lenient) with any and blow-ups counted."""
    chosen = [point for point in verdicts.points if point.part != "cell" and (lenient or point.integration.resolved)]
    return analysis.frontier([(len(departures(point.row)), verdicts.number_of_hits(point, lenient), point) for point in chosen])


def _frontier_table(verdicts, lenient):
    rows = [[n, f"{count} of {len(verdicts.statements)}", words(point.row), point.integration.label] for n, count, point in _best_readings(verdicts, lenient)]
    return markdown(["departures", "statements", "reading", "integration"], rows)


def _ensemble_table(verdicts):
    rows = []
    for row in ensembles:
        members = [point for point in verdicts.part("ensemble") if point.row == row]
        if members:
            hits = verdicts.hits(members)
            rows.append([words(row), f"{hits.sum(axis=0).min()} to {hits.sum(axis=0).max()}",
                         ", ".join(each.key for each, row in zip(verdicts.statements, hits) if row.all()) or "–",
                         ", ".join(f"{each.key} ({row.sum()}/{row.size})" for each, row in zip(verdicts.statements, hits) if row.any() and not row.all()) or "–"])
    return markdown(["reading", "statements", "in every member", "in some"], rows)


def _verdict_of(key, shares, cell):
    """What most of a statement's verdict is."""
    if shares is None:
        return "none varies"
    finer = cell[0] / cell[1] if cell[1] else 0.0
    names = {"reading": "reading", "integration": "step", "together": "reading and step", "chance": "chance"}
    most = max(shares, key=shares.get)
    return names[most] + ("; cell" if finer > 0.3 else "")


def _statement_table(verdicts, shares, cells, effects):
    ways, rows = _ways(verdicts), []
    strict, lenient = verdicts.hits(verdicts.points), verdicts.hits(verdicts.points, True)
    for n, each in enumerate(verdicts.statements):
        part = shares[each.key]
        what = [f"{factor.label} ({number(100 * effects[n, f]['share'], 2)} %)" for f, factor in enumerate(factors) if effects[n, f]["p"] <= significant]
        rows.append([each.key, each.text, *[f"{int(verdicts.table(each, [way]).sum())}/{len(verdicts.table(each, [way]))}" for way in ways],
                     *[number(100 * part[kind], 2) if part else "–" for kind in ("reading", "integration", "together", "chance")],
                     "{}/{}".format(*cells[each.key]), ", ".join(what) or "–", _verdict_of(each.key, part, cells[each.key]),
                     "yes" if strict[n].any() else "blown up" if lenient[n].any() else "never"])
    return markdown(["", "the paper says", *[f"hits, {way.label}" for way in ways], "reading (%)", "step (%)", "both (%)", "chance (%)", "cell changes",
                     "by factor (corrected p ≤ 0.05)", "mostly", "reached"], rows)


def _singles_table(verdicts):
    base = [point for point in verdicts.part("design", resolved) if point.row == reference]
    rows = [[words(point.row), verdicts.number_of_hits(point), *_changes(verdicts, base[0], point)] for point in [*base, *verdicts.part("single")]]
    return markdown(["reading", "statements", "gained", "lost"], rows)


def _changes(verdicts, base, point):
    gained = [each.key for each in verdicts.statements if hit(verdicts.of[point][each.key]) and not hit(verdicts.of[base][each.key])]
    lost = [each.key for each in verdicts.statements if hit(verdicts.of[base][each.key]) and not hit(verdicts.of[point][each.key])]
    return ", ".join(gained) or "–", ", ".join(lost) or "–"


def _decisions_table(verdicts, effects):
    """What print would have decided: factors by the statements that hang on them."""
    rows = []
    for f, factor in enumerate(factors):
        hung = [verdicts.statements[s].key for s in range(len(verdicts.statements)) if effects[s, f]["p"] <= significant]
        rows.append([factor.decides, factor.label, len(hung), ", ".join(hung) or "–"])
    return markdown(["what print would have decided", "factor", "statements", "which"], sorted(rows, key=lambda row: -row[2]))


def report(quick, out):
    verdicts = Verdicts(quick, out)
    write_csv(out / "tables" / "verdicts.csv", ["part", "integration", "member", *[factor.key for factor in factors], "statement", "verdict", "found", "made"],
              [{"part": point.part, "integration": point.integration.key, "member": point.member,
                **{factor.key: factor.levels[level].label for factor, level in zip(factors, point.row)}, "statement": each.key, **verdicts.of[point][each.key]}
               for point in verdicts.points for each in verdicts.statements])
    effects, shares, cells = _effects(verdicts, out), _shares(verdicts), _cell_changes(verdicts)
    write_csv(out / "tables" / "shares.csv", ["statement", "reading", "integration", "together", "chance"],
              [{"statement": key, **(part or {})} for key, part in shares.items()])
    interactions = _interactions(verdicts, out)
    design = verdicts.part("design")
    figures.matrix(verdicts, design, out / "figures", "matrix")
    figures.effects([each.key for each in verdicts.statements], effects, out / "figures", "effects")
    return _page_values(quick, verdicts, effects, shares, cells, interactions)


def _page_values(quick, verdicts, effects, shares, cells, interactions):
    design = verdicts.part("design")
    steady = [point for point in verdicts.points if point.integration.resolved and point.part != "cell"]
    hits = verdicts.hits(steady)
    best, expected, chance = analysis.best_by_chance(hits)
    lenient = verdicts.hits(verdicts.points, True)
    never = [each.key for each, row in zip(verdicts.statements, lenient) if not row.any()]
    blown = [each.key for each, row, soft in zip(verdicts.statements, verdicts.hits(verdicts.points), lenient) if soft.any() and not row.any()]
    pairs = sorted(((share, key, of) for key, parts in interactions.items() for of, share in parts.items() if "×" in of), reverse=True)[:12]
    group = analysis.cover(hits)
    return {
        "full": not quick, "paper": paper_title, "factors": markdown(["", "reference", "other readings"], [[f.label, f.levels[0].label, ", ".join(x.label for x in f.levels[1:])] for f in factors]),
        "points": len(verdicts.points), "runs": sum(len(cases_of(point, quick)) for point in verdicts.points), "rows": len({point.row for point in design}),
        "readings_tried": len({point.row for point in verdicts.points}), "total": len(verdicts.statements), "tests": len(effects),
        "significant": sum(effect["p"] <= significant for effect in effects.values()),
        "statements": _statement_table(verdicts, shares, cells, effects), "best": best, "expected": number(expected, 3), "chance": number(chance, 2),
        "sound": number(100 * sound), "frontier": _frontier_table(verdicts, False), "frontier_blown": _frontier_table(verdicts, True),
        "never": ", ".join(never) or "none", "blown": ", ".join(blown) or "none", "decisions": _decisions_table(verdicts, effects),
        "ensembles": _ensemble_table(verdicts), "singles": _singles_table(verdicts),
        "interactions": markdown(["share of the variance (%)", "statement", "factors"], [[number(100 * share, 2), key, of] for share, key, of in pairs]),
        "cover": markdown(["combination", "adds"], [[words(steady[n].row) + f" ({steady[n].integration.label})", ", ".join(verdicts.statements[s].key for s in added)]
                                                    for n, added in group]),
        "full_factors": ", ".join(by_key[key].label for key in full), "cases": "; ".join(f"R = {r} mm at {v} m/s" for r, v in (shown[:2] if quick else shown)),
    }


if __name__ == "__main__":
    sys.exit(main(sys.modules[__name__]))
