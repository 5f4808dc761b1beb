"""Figures of a study of one's own scene. Each function gives a figure in the style that is set, for a page on a screen and for paper."""
import textwrap

import numpy as np
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator
from study.figures import colours, legend_below, markers, plt
from study.ladders import field_of_velocity

kinds = {"time": "time integration", "local": "local tolerance", "space": "space", "chaos": "chaos (ensemble)"}


def _panels(count, height=2.3):
    rows = -(-count // 2)
    figure, panels = plt.subplots(rows, min(2, count), figsize=(6.8 if count > 1 else 4.4, height * rows + 0.7), squeeze=False)
    for axes in panels.flat[count:]:
        axes.set_visible(False)
    return figure, list(panels.flat[:count])


def _titled(axes, text):
    axes.set_title("\n".join(textwrap.wrap(text, 38)), fontsize=8.5)


def _ticks_of_work(axis):
    """A few numbers that can be read, over less than a decade as over many."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator() if high > 20.0 * low else MaxNLocator(4))
    axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)) if 20.0 * low < high < 500.0 * low else NullLocator())
    for which in ("major", "minor"):
        getattr(axis, f"set_{which}_formatter")(lambda number, _: f"{number:g}")


def _shown(quantity):
    """(factor, unit) in which a quantity is drawn: microseconds for times."""
    return (1e6, "µs") if quantity.unit == "s" else (1.0, quantity.unit or "–")


def work_precision(rows, title):
    """Error of each quantity, and of the velocity field, over wall time; of the field over right-hand sides too. Grey: what the references differ by."""
    quantities = [(name, "seconds") for name in dict.fromkeys(row["quantity"] for row in rows)] + [(field_of_velocity, "rhs_evaluations")]
    shown = [(name, x) for name, x in quantities if any(row["quantity"] == name and row["error"] for row in rows)]
    if not shown:
        return None
    figure, panels = _panels(len(shown))
    methods = list(dict.fromkeys(row["method"] for row in rows))
    for axes, (name, x) in zip(panels, shown):
        of = [row for row in rows if row["quantity"] == name]
        for n, method in enumerate(methods):
            points = [(row[x], row["error"]) for row in of if row["method"] == method and row["error"] and row.get(x)]
            if points:
                axes.plot(*zip(*points), color=colours[n % 6], marker=markers[n % len(markers)], linewidth=1.0, label=method)
        axes.set_xscale("log")
        axes.set_yscale("log")
        _ticks_of_work(axes.xaxis)
        apart, (low, high) = of[0]["references_apart"], axes.get_ylim()
        if apart:
            low = min(low, 0.3 * apart)
            axes.axhspan(low, apart, color="#88888855", linewidth=0)
            axes.set_ylim(low, high)
        _titled(axes, name)
        axes.set_xlabel("wall time (s)" if x == "seconds" else "right-hand sides")
        axes.set_ylabel("error (–)")
    if title:
        figure.suptitle(title)
    handles = {label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels())}
    legend_below(figure, list(handles.values()), list(handles))
    return figure


def error_bars(found, converged):
    """Of each quantity what each kind of error makes of its scale."""
    shown = [bars for bars in found if bars.relative]
    if not shown:
        return None
    figure, axes = plt.subplots(figsize=(6.8, 0.9 + 0.62 * len(shown)))
    for n, (kind, label) in enumerate(kinds.items()):
        values = [max(bars.relative.get(kind, 0.0), 1e-12) for bars in shown]
        axes.barh(np.arange(len(shown)) + 0.2 * (n - 1.5), values, height=0.19, color=colours[n], label=label)
    axes.axvline(converged, color="#888888", linewidth=0.8, linestyle="--")
    axes.set_xscale("log")
    axes.set_xlim(left=1e-8)
    axes.set_yticks(range(len(shown)), ["\n".join(textwrap.wrap(bars.quantity.name, 30)) for bars in shown])
    axes.set_ylim(len(shown) - 0.5, -0.5)
    axes.grid(False, axis="y")
    axes.set_xlabel("error, of the quantity's scale")
    legend_below(figure, axes.get_legend_handles_labels()[0])
    return figure


def members(found):
    """Members of both ensembles of what is chaotic, as distribution functions."""
    shown = [bars for bars in found if len(bars.members) > 1 and bars.largest == "chaos" and bars.relative["chaos"] > 0.0]
    if not shown:
        return None
    figure, panels = _panels(len(shown))
    for axes, bars in zip(panels, shown):
        factor, unit = _shown(bars.quantity)
        for values, label, colour, dashes in ((bars.members, "as it is", colours[0], "-"), (bars.finer, "finer in time", colours[1], "--")):
            if values:
                axes.step(factor * np.sort(values), (1 + np.arange(len(values))) / len(values), where="post", color=colour, linestyle=dashes, label=label)
        _titled(axes, bars.quantity.name)
        axes.set_ylabel("share of members below")
        axes.set_xlabel(unit)
    legend_below(figure, panels[0].get_legend_handles_labels()[0])
    return figure


def sweep(rows, varied, quantities):
    """Each quantity over the first varied key, a line for each combination of the others, with error bars where they were asked for."""
    shown = [quantity for quantity in quantities if any(row[quantity.name] is not None for row in rows)]
    if not shown:
        return None
    figure, panels = _panels(len(shown))
    first, others = varied[0], varied[1:]
    numeric = all(isinstance(row[first], (int, float)) for row in rows)
    ticks = list(dict.fromkeys(row[first] for row in rows))
    for axes, quantity in zip(panels, shown):
        factor, unit = _shown(quantity)
        for n, other in enumerate(dict.fromkeys(tuple(row[key] for key in others) for row in rows)):
            points = [(row[first] if numeric else ticks.index(row[first]), factor * row[quantity.name], factor * (row.get(f"± {quantity.name}") or 0.0)) for row in rows
                      if tuple(row[key] for key in others) == other and row[quantity.name] is not None]
            if points:
                x, y, bars = zip(*points)
                axes.errorbar(x, y, yerr=bars if any(bars) else None, color=colours[n % 6], marker=markers[n % len(markers)], capsize=2,
                              label=", ".join(f"{key.split('.')[-1]} {value}" for key, value in zip(others, other)))
        if not numeric:
            axes.set_xticks(range(len(ticks)), [str(tick) for tick in ticks], fontsize=7)
        _titled(axes, quantity.name)
        axes.set_xlabel(first)
        axes.set_ylabel(unit)
    if others:
        legend_below(figure, panels[0].get_legend_handles_labels()[0])
    return figure
