# SPDX-License-Identifier: MIT
"""Values over time: how runs part."""
import canvas
from data import unique


def thinned(points, most=400):
    """Enough of them for a picture; the last is always there."""
    step = max(1, len(points) // most)
    kept = points[::step]
    return kept if kept[-1] == points[-1] else [*kept, points[-1]]


def plot(table, spec):
    log = spec.get("log", "")
    names = unique(panel for panel, _, _ in table.curves)
    figure, axes = canvas.panels(names)
    lines = unique((series, setting) for _, series, setting in table.curves)
    styles, dashes = canvas.styles(lines), canvas.dashes(lines)
    handles = {}
    for name, ax in axes.items():
        own = {key[1:]: points for key, points in table.curves.items() if key[0] == name}
        xs, ys = zip(*(point for points in own.values() for point in points))
        x_axis, y_axis = canvas.axes_of(ax, xs, ys, log)
        for key, points in own.items():
            xs, ys = zip(*thinned(points))
            handles[" ".join(part for part in key if part)] = ax.plot(
                [x_axis.place(x) for x in xs], [y_axis.place(y) for y in ys], linewidth=1.2,
                color=styles[key]["color"], linestyle=dashes[key])[0]
        ax.set_xlabel(spec.get("x_label", ""))
        ax.set_ylabel(spec.get("y_label", ""))
    canvas.legend(figure, handles, always=True)
    return figure
