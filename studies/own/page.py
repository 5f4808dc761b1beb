"""Tables, figures and the page of a study that is told by files; while it runs, the page of what is there."""
import datetime
import pathlib

import jinja2
import matplotlib
from study import bars, ladders, plan as plans, sweep
from study.figures import plt, save, style
from study.page import machine, run_times
from study.provenance import commit, version
from study.results import Study, case_rows, work
from study.tables import number, write_csv
from vitrum.report import charts

from own import figures

here = pathlib.Path(__file__).resolve().parent
css = here.parent / "vitrum/report/page.css"
_screen: dict = {**charts.style, "font.size": 9, "axes.titlesize": 8.5}
shown_of_failed = 50  # runs that did not come to their end, in the page


def command(study, quick):
    """What makes the study of a file."""
    return f"vitrum-study {study.plan['file']}{' --quick' if quick else ''}"


class Sheet:
    """Where a study's tables and figures go: into files and the page, or, of a study that is under way, into the page alone."""

    def __init__(self, study, write, quick):
        self.study, self.write = study, write
        self.made = command(study, quick), version(), commit()

    def _name(self, name):
        return "-".join(filter(None, (self.study.plan["key"], name)))

    def table(self, name, rows):
        if self.write:
            write_csv(self.study.out / "tables" / f"{self._name(name)}.csv", list(dict.fromkeys(key for row in rows for key in row)), rows)

    def figure(self, name, draw):
        """SVG for the page; PNG and PDF for paper. None where there is nothing to draw."""
        figure = draw()
        if figure is None:
            return None
        if self.write:
            save(figure, self.study.out / "figures", self._name(name), made=self.made)
        plt.close(figure)
        with matplotlib.rc_context({**matplotlib.rcParamsDefault, **_screen}):
            figure = draw()
            text = charts.svg(figure, self._name(name))
            plt.close(figure)
        return text


def _percent(share, digits=2):
    return "–" if share is None else f"{number(100.0 * share, digits)} %"


def _with_unit(value, unit):
    """A value in a unit that keeps its digits short."""
    if value is None:
        return "–"
    if unit == "s":
        return f"{number(1e6 * value, 4)} µs"
    return f"{number(value, 4)} {unit}".strip()


def _trade(study, sheet):
    rows = list(ladders.trade_rows(study))
    # While a reference is to come, nothing can be said of errors.
    awaited = any(study.outcome(name) is None for name in study.named_any("reference"))
    advice = [] if awaited else list(ladders.recommendations(rows))
    sheet.table("trade", rows)
    sheet.table("recommendations", advice)
    labels = {point: sweep.label(study, point) for point in dict.fromkeys(row["point"] for row in rows)}
    several = len(labels) > 1

    def rung(row):
        return ", ".join(filter(None, (labels[row["point"]], row["method"], row["setting"])))

    def figure(point):
        of = [row for row in rows if row["point"] == point]
        return sheet.figure("trade" if point is None else f"trade-{point}", lambda: figures.work_precision(of, labels[point]))

    idle = {rung(row): row["tolerance_idle"] for row in rows if row.get("tolerance_idle")}
    failed = {rung(row): row["status"] for row in rows if row["status"] not in ("complete", "to come")}
    return {"awaited": awaited, "figures": [figure(point) for point in labels], "points": several,
            "references": list(dict.fromkeys(study.cases[name]["method"] for name in study.named_any("reference"))),
            "advice": [(*([labels[row["point"]]] if several else []), row["quantity"], _percent(row["level"]), row["advice"], number(row.get("seconds")), _percent(row.get("error")),
                        _percent(row["references_apart"])) for row in advice],
            "idle": [f"{where}: the tolerance was idle in {_percent(share)} of the steps, which stability limited" for where, share in idle.items()],
            "failed": [f"{where}: {status}" for where, status in failed.items()]}


def _error_bars(study, sheet):
    if study.outcome(study.named("base")[0]) is None:
        return {"awaited": True}
    found = list(bars.bar_rows(study))
    rows, every, converged = [row for _, row in found], [each for each, _ in found], study.plan["converged"]
    sheet.table("error_bars", rows)

    def bar(row, kind):
        return "" if row[kind] is None else f"±{_with_unit(row[kind], row['unit'])}"

    return {"awaited": False, "figure": sheet.figure("error-bars", lambda: figures.error_bars(every, converged)), "members": sheet.figure("members", lambda: figures.members(every)),
            "rows": [(row["quantity"], _with_unit(row["value"], row["unit"]), *[bar(row, kind) for kind in bars.kinds], row["verdict"], row["effort"]) for row in rows],
            "distributions": [_compared(each, row) for each, row in found if row["verdict"] == "chaotic" and row["same_distribution"] is not None],
            "idle": list(_idle(study)), "best": bars.best_of_all(every, converged), "count": study.plan["members"], "converged": _percent(converged)}


def _idle(study):
    """Where stability limited steps, a finer tolerance moves nothing: the bar of time is less than the error of time."""
    base = study.named("base")[0]
    for what, name in (("the scene as it is", base), *((study.cases[name]["effort"], name) for name in study.there("refined", point=None, kind="time"))):
        if share := work(study, name).get("tolerance_idle"):
            yield f"{what}: the tolerance was idle in {_percent(share)} of the steps, which stability limited"


def _compared(each, row):
    """What the two ensembles of a chaotic quantity say of each other."""
    least, counts = each.least_probability, f"{len(each.members)} and {len(each.finer)} members"
    differ = "differ" if row["same_distribution"] < 0.05 else "do not differ more than chance"
    said = f"{differ} (Kolmogorov-Smirnov, p = {row['same_distribution']:.2g}, {counts})" if least < 0.05 else f"cannot be told apart by {counts} (Kolmogorov-Smirnov, p at least {least:.2g})"
    return f"{row['quantity']}: mean {_with_unit(row['mean'], row['unit'])}; as it is and finer in time {said}"


def _sweep(study, sheet):
    rows = list(sweep.sweep_rows(study))
    sheet.table("sweep", rows)
    shown = [*study.plan["varied"], "status", *[quantity.name for quantity in study.quantities]]

    units = {quantity.name: quantity.unit for quantity in study.quantities}

    def cell(row, key):
        if isinstance(row.get(key), str):
            return row[key]
        bar = row.get(f"± {key}")
        return _with_unit(row.get(key), units.get(key, "")) + (f" ±{_with_unit(bar, units[key])}" if bar is not None else "")

    return {"figure": sheet.figure("sweep", lambda: figures.sweep(rows, study.plan["varied"], study.quantities)), "header": shown, "rows": [[cell(row, key) for key in shown] for row in rows]}


def _methods(study, sheet):
    rows = list(sweep.method_rows(study))
    sheet.table("methods", rows)
    units = {quantity.name: quantity.unit for quantity in study.quantities}
    lines: dict[tuple, dict] = {}  # of the page: a point, a method, a rung
    for row in rows:
        where = *(row[key] for key in study.plan["varied"]), study.plan["titles"][row["method"]], row["setting"], row["status"], row["members"]
        lines.setdefault(where, {})[row["quantity"]] = _distribution(row, units[row["quantity"]])
    return {"header": [*study.plan["varied"], "method", "setting", "status", "members", *units],
            "rows": [[*(number(each, 4) for each in where), *[line.get(name, "–") for name in units]] for where, line in lines.items()]}


def _distribution(row, unit):
    """The median of members, and 5 to 95 % of them where there are several."""
    if not row["n"]:
        return "–"
    return _with_unit(row["median"], unit) + (f" ({_with_unit(row['p05'], unit)} … {_with_unit(row['p95'], unit)})" if row["n"] > 1 else "")


_parts = {"trade": _trade, "error-bars": _error_bars, "sweep": _sweep, "methods": _methods}


def _units(sheet):
    """Of the columns of cases.csv and sweep.csv, whose names scripts know: what they are in, and where it stands in a run's summary."""
    sheet.table("units", [*({"column": each.name, "unit": each.unit, "from": each.source} for each in sheet.study.quantities), {"column": "seconds", "unit": "s", "from": "wall_seconds"}])


def _section(study, write, quick):
    """What the page says of one file."""
    sheet, cases = Sheet(study, write, quick), list(case_rows(study))
    sheet.table("cases", cases)
    _units(sheet)
    plan = study.plan
    failed = [(row["case"], row["status"], row["message"]) for row in cases if row["status"] not in ("complete", "to come")]
    return {"title": plan["title"], "runs": sum(map(len, plans.jobs(plan).values())), "failed": failed[:shown_of_failed], "failures": len(failed), "scene": plan["scene"],
            "verbatim": pathlib.Path(plan["scene"]).read_text(), "file": plan["file"], "text": pathlib.Path(plan["file"]).read_text(),
            **{kind.replace("-", "_"): make(study, sheet) if kind in plan["kinds"] else None for kind, make in _parts.items()}}


def studies_of(out, partial=False):
    """The studies of a folder, one each file."""
    return [Study(pathlib.Path(out), key, partial) for key in plans.load_all(out)]


def write(out, quick, name="report.html", studies=None, state=None, refresh=None):
    """The page NAME. Without `studies`, of all runs, and with tables/*.csv, figures/*.png and *.pdf; with, of the runs that are there. `state`: how far a study is that is
    not done (heading, and what progress.json says). `refresh`: seconds after which a browser reads the page again."""
    plt.rcParams.update(style)
    files = studies is None
    studies = studies_of(out) if files else studies
    count, seconds = run_times(out)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(here), autoescape=True, undefined=jinja2.StrictUndefined)
    text = environment.get_template("page.html").render(
        title=studies[0].plan["title"] if studies else f"Study in {pathlib.Path(out).resolve().name}", studies=[_section(study, files, quick) for study in studies], css=css.read_text(), quick=quick, refresh=refresh, state=state,
        made=f"{'' if state else '; '.join(command(study, quick) for study in studies) + '; '}{version()}; commit {commit()}; {datetime.date.today().isoformat()}; {machine()}; {count:,} runs, {seconds:,.0f} s together")
    following = pathlib.Path(out) / f".{name}.next"
    following.write_text(text, encoding="utf-8")
    following.replace(pathlib.Path(out) / name)
