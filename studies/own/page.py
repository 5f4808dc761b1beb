"""Tables, figures and the page of a study."""
import datetime
import pathlib

import jinja2
import matplotlib
from study.figures import plt, save, style
from study.page import machine, run_times
from study.provenance import commit, version
from study.tables import number, write_csv
from vitrum.report import charts

from own import figures, measure

here = pathlib.Path(__file__).resolve().parent
css = here.parent / "vitrum/report/page.css"


def _drawn(draw, folder, name):
    """The figure for paper, as PNG and PDF, and as part of the page; None where there is nothing to draw."""
    figure = draw()
    if figure is None:
        return None
    save(figure, folder, name)
    with matplotlib.rc_context({**matplotlib.rcParamsDefault, **charts.style, "font.size": 9, "axes.titlesize": 8.5}):
        figure = draw()
        text = charts.svg(figure, name)
        plt.close(figure)
    return text


def _columns(rows):
    return list(dict.fromkeys(key for row in rows for key in row))


def _table(folder, name, rows):
    write_csv(folder / f"{name}.csv", _columns(rows), rows)


def _percent(share, digits=2):
    return "–" if share is None else f"{number(100.0 * share, digits)} %"


def _with_unit(value, unit):
    """A value in a unit that keeps its digits short."""
    if value is None:
        return "–"
    if unit == "s":
        return f"{number(1e6 * value, 4)} µs"
    return f"{number(value, 4)} {unit}".strip()


def _trade(study, out):
    rows = list(measure.trade_rows(study))
    advice = list(measure.recommendations(rows))
    _table(out / "tables", "trade", rows)
    _table(out / "tables", "recommendations", advice)
    idle = {(row["method"], row["setting"]): row["tolerance_idle"] for row in rows if row.get("tolerance_idle")}
    return {"figure": _drawn(lambda: figures.work_precision(rows), out / "figures", "trade"),
            "references": [study.cases[name]["method"] for name in study.named("reference")],
            "advice": [(row["quantity"], _percent(row["level"]), row["advice"], number(row.get("seconds")), _percent(row.get("error")), _percent(row["references_apart"])) for row in advice],
            "idle": [f"{method}, {setting}: the tolerance was idle in {_percent(share)} of the steps, which stability limited" for (method, setting), share in idle.items()],
            "failed": sorted({f"{row['method']}, {row['setting']}: {row['status']}" for row in rows if row["status"] != "complete"})}


def _error_bars(study, out):
    found = list(measure.bar_rows(study))
    rows = [row for _, row in found]
    _table(out / "tables", "error_bars", rows)
    every = [bars for bars, _ in found]
    efforts = {}  # effort -> what it moves, of all scales together, and its seconds
    for bars in every:
        if bars.largest not in (None, "chaos"):
            for effort, (kind, moved, seconds) in bars.efforts.items():
                if kind == bars.largest and bars.relative[kind] > study.plan["converged"]:
                    total, _ = efforts.get(effort, (0.0, 0.0))
                    efforts[effort] = total + moved, seconds
    best = max(efforts, key=lambda effort: efforts[effort][0] / efforts[effort][1], default=None)
    def bar(row, kind):
        return "" if row[kind] is None else f"±{_with_unit(row[kind], row['unit'])}"
    return {"figure": _drawn(lambda: figures.error_bars(every, study.plan["converged"]), out / "figures", "error-bars"),
            "members": _drawn(lambda: figures.members(every), out / "figures", "members"),
            "rows": [(row["quantity"], _with_unit(row["value"], row["unit"]), *[bar(row, kind) for kind in figures.kinds], row["verdict"], row["effort"]) for row in rows],
            "distributions": [f"{row['quantity']}: mean {_with_unit(row['mean'], row['unit'])}; as it is and finer in time "
                              + ("differ" if row["same_distribution"] < 0.05 else "do not differ more than chance") + f" (Kolmogorov-Smirnov, p = {row['same_distribution']:.2g}, "
                              f"{len(bars.members)} and {len(bars.finer)} members)" for bars, row in found if row["verdict"] == "chaotic" and row["same_distribution"] is not None],
            "best": None if best is None else f"{best[0].upper()}{best[1:]} takes most off the largest bars for its time: "
                    f"{_percent(efforts[best][0])} of the quantities' scales together, for {number(efforts[best][1], 2)} s more a run."}


def _sweep(study, out):
    rows = list(measure.sweep_rows(study))
    _table(out / "tables", "sweep", rows)
    shown = [*study.plan["varied"], "status", *[quantity.name for quantity in study.quantities]]
    def cell(row, key):
        bar = row.get(f"± {key}")
        return (number(row.get(key), 4) if not isinstance(row.get(key), str) else row[key]) + (f" ±{number(bar, 2)}" if bar is not None else "")
    return {"figure": _drawn(lambda: figures.sweep(rows, study.plan["varied"], study.quantities), out / "figures", "sweep"),
            "header": shown, "rows": [[cell(row, key) for key in shown] for row in rows]}


def write(out, quick):
    """tables/*.csv, figures/*.png and *.pdf, report.html."""
    plt.rcParams.update(style)
    study = measure.Study(out)
    cases = list(measure.case_rows(study))
    _table(out / "tables", "cases", cases)
    parts = {key: make(study, out) if kind in study.plan["kinds"] else None
             for kind, key, make in (("trade", "trade", _trade), ("error-bars", "bars", _error_bars), ("sweep", "sweep", _sweep))}
    count, seconds = run_times(out)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(here), autoescape=True, undefined=jinja2.StrictUndefined)
    text = environment.get_template("page.html").render(
        **parts, title=study.plan["title"], css=css.read_text(), quick=quick, scene=study.plan["scene"], file=study.plan["file"], verbatim=pathlib.Path(study.plan["scene"]).read_text(),
        study_text=pathlib.Path(study.plan["file"]).read_text(), failed=[(row["case"], row["status"], row["message"]) for row in cases if row["status"] != "complete"],
        cases=len(cases), converged=_percent(study.plan["converged"]), members=study.plan["members"],
        made=f"{version()}; commit {commit()}; {datetime.date.today().isoformat()}; {machine()}; {count:,} runs, {seconds:,.0f} s together")
    following = out / ".report.html.next"
    following.write_text(text, encoding="utf-8")
    following.replace(out / "report.html")
