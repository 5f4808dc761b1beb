"""The report of a run: one HTML page that holds all it needs."""
from __future__ import annotations

import json
import os
import pathlib
from typing import Any

import matplotlib

from vitrum.report import charts, frames, verdict
from vitrum.results import Run

here = pathlib.Path(__file__).resolve().parent
_of_account = ("initial", "external", "kinetic", "elastic", "plastic", "damage", "fracture", "contact", "friction", "filtered", "removed", "residual")


def _place(first: dict[str, Any]) -> str:
    names = [name for name in ("r", "z", "x", "y") if name in first]
    return ", ".join(f"{name} {1e3 * first[name]:.3g} mm" for name in names)


def _firsts(run: Run) -> list[tuple[str, str, str, str]]:
    failure = run.summary["failure"] if run.summary else {}
    return [(what, f"{1e6 * first['time']:.4g} µs", _place(first), first["body"]) for what in ("damage", "localisation", "separation")
            if (first := failure.get(f"first_{what}"))]


def _sorted_provenance(run: Run) -> list[tuple[str, str]]:
    order = ["command", "version", "git", "started", "host", "compiler", "sundials", "scene_sha256"]
    return sorted(run.provenance.items(), key=lambda item: order.index(item[0]) if item[0] in order else len(order))


def page(run: Run, refresh: int = 0) -> str:
    """The page as text; of a run under way it asks to be read again every `refresh` seconds."""
    import jinja2
    with matplotlib.rc_context({**matplotlib.rcParamsDefault, **charts.style}):
        drawn = {"energy": [charts.svg(charts.energy(run), "energy"), charts.svg(charts.residual(run), "residual")],
                 "histories": [(name, charts.svg(figure, name)) for name, figure in charts.histories(run) if figure is not None]}
        for name, draw in (("events", charts.events), ("fragments", charts.fragments)):
            figure = draw(run)
            drawn[name] = charts.svg(figure, name) if figure is not None else None
    facts, player, summary = verdict.facts(run), frames.packed(run), run.summary
    count = sum(body["particles"] for body in summary["bodies"].values()) if summary else len(run.mass) if run.frames else 0
    reached = run.columns("series")["time"]
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(here), autoescape=True, trim_blocks=False, undefined=jinja2.StrictUndefined)
    return environment.get_template("page.html").render(
        title=run.title or run.directory.resolve().name, css=(here / "page.css").read_text(), script=(here / "player.js").read_text(), refresh=refresh if summary is None else 0,
        bodies=", ".join(f"{name} ({material})" for name, material in zip(run.bodies, run.materials)),
        extent=f"{count:,} particles, cells of {1e3 * run.cell:.3g} mm, {1e6 * run.scene['time']['start']:.4g} to {1e6 * float(reached[-1]):.4g} µs" if len(reached) else "nothing yet",
        facts=facts, headline=verdict.headline(facts), progress=None if summary else verdict.progress(run), summary=summary,
        account=[(name, f"{summary['energy'][name]:.4g}") for name in _of_account if summary["energy"].get(name) is not None] if summary else [],
        firsts=_firsts(run), provenance=_sorted_provenance(run), verbatim=run.verbatim, resolved=run.resolved,
        player=player, player_json=json.dumps(player).replace("</", "<\\/"), **drawn)


def write(run: Run, path: str | os.PathLike[str] | None = None, refresh: int = 0) -> pathlib.Path:
    """Writes the page, report.html in the run's folder unless another is named, whole at any moment."""
    target = pathlib.Path(path) if path is not None else run.directory / "report.html"
    following = target.with_name(f".{target.name}.next")
    following.write_text(page(run, refresh), encoding="utf-8")
    following.replace(target)
    return target
