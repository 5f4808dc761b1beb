"""Figures of the study of space."""
from study.figures import colours, legend_below, markers, page_width, plt, save

from space.cases import cells
from space.measures import drawn, quantities


def group(title, settings, found, folder, name):
    """Each measure over the cell: medians, and bars from the least to the largest member. found: (setting, cell) -> measure -> statistics."""
    figure, panels = plt.subplots(2, 3, figsize=(page_width, 0.62 * page_width))
    handles = []
    for axes, key in zip(panels.flat, drawn):
        label, unit, scale = quantities[key]
        for n, setting in enumerate(settings):
            points = [(1e3 * cells[cell], found[setting.name, cell][key]) for cell in cells if (setting.name, cell) in found]
            points = [(x, each) for x, each in points if each["n"]]
            if not points:
                continue
            x, middle = [x for x, _ in points], [scale * each["median"] for _, each in points]
            below = [m - scale * each["least"] for m, (_, each) in zip(middle, points)]
            above = [scale * each["most"] - m for m, (_, each) in zip(middle, points)]
            drawn_line = axes.errorbar(x, middle, (below, above), color=colours[n], marker=markers[n], capsize=2.0, label=setting.label)
            if axes is panels[0, 0]:
                handles.append(drawn_line)
        axes.set_xscale("log", base=2)
        axes.set_xticks([1e3 * cell for cell in cells.values()], list(cells))
        axes.minorticks_off()
        axes.set_xlim(1.25, 0.1)
        axes.set_title(f"{label} ({unit})" if unit else label)
    for axes in panels[1]:
        axes.set_xlabel("cell (mm)")
    figure.suptitle(title)
    legend_below(figure, handles)
    save(figure, folder, name)
