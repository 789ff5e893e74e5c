# SPDX-License-Identifier: MIT
"""A metric over the knob, a line for each series; with the slope where both axes are logarithmic."""
import math

import numpy

import canvas
import labels
from data import unique
from words import metric_label


def slope(xs, ys):
    """Exponent of the power law that is nearest; None of fewer than three points."""
    usable = [(math.log(x), math.log(y)) for x, y in zip(xs, ys) if x > 0 and y > 0 and math.isfinite(y)]
    return float(numpy.polyfit(*zip(*usable), 1)[0]) if len({x for x, _ in usable}) > 2 else None


def places(points, log):
    """Key of a point -> place on the axis of the knob, and whether that is its number. Where there are none, or they
    spread over decades on both sides of zero or on an even axis, they stand one after the other."""
    numbers = all(math.isfinite(point.x) for point in points)
    if numbers:
        sizes = [abs(point.x) for point in points if point.x]
        spread = bool(sizes) and max(sizes) > 1000 * min(sizes)
        numbers = not spread or ("x" in log and all(point.x >= 0 for point in points))
        points = sorted(points, key=lambda point: point.x) if not numbers else points
    names = unique(point.setting for point in points)
    return {p.key: p.x if numbers else names.index(p.setting) for p in points}, numbers, names


def draw_series(ax, points, at, metric, axes, style):
    """The line, and what is written at its end."""
    x_axis, y_axis = axes
    points = sorted(points, key=lambda point: at[point.key])
    good = [p for p in points if not p.failure and math.isfinite(p.value(metric))]
    xs, ys = [at[p.key] for p in good], [p.value(metric) for p in good]
    line = ax.plot([x_axis.place(x) for x in xs], [y_axis.place(y) for y in ys], markersize=4, linewidth=1.3,
                   markeredgewidth=0, **style)[0]
    if metric == "cost":
        ax.vlines([x_axis.place(x) for x in xs], [p.cost_low for p in good], [p.cost_high for p in good],
                  color=style["color"], alpha=0.6, linewidth=1.1)
    for point in points:
        if point.failure:
            value = point.value(metric)
            known = math.isfinite(value) and (value >= 0 or not y_axis.log)
            canvas.cross(ax, x_axis.place(at[point.key]), y_axis.place(value) if known else 0.97, style["color"],
                         ax.transData if known else ax.get_xaxis_transform())
    found = slope(xs, ys) if x_axis.log and y_axis.log else None
    if found is None:
        return line, []
    return line, [(x_axis.place(xs[-1]), y_axis.place(ys[-1]), f"slope {found:.2f}", style["color"], True)]


def plot(table, spec):
    metric, log = spec["y"], spec.get("log", "")
    names = [panel for panel in table.panels
             if any(p.failure or math.isfinite(p.value(metric)) for p in table.within(panel))]
    figure, axes = canvas.panels(names)
    series = unique(point.series for point in table.points)
    dashes = canvas.dashes(series)
    styles = {name: {**style, "linestyle": dashes[name]} for name, style in canvas.styles(series).items()}
    handles, written = {}, []
    for name, ax in axes.items():
        points = table.within(name)
        at, numbers, settings = places(points, log)
        x_axis, y_axis = canvas.axes_of(ax, at.values(), [p.value(metric) for p in points if not p.failure],
                                        log if numbers else log.replace("x", ""))
        for series in unique(point.series for point in points):
            of = [point for point in points if point.series == series]
            handles[series], texts = draw_series(ax, of, at, metric, (x_axis, y_axis), styles[series])
            written.append((ax, texts))
        if not numbers:
            ax.set_xticks(range(len(settings)), settings, rotation=30 if len(settings) > 4 else 0,
                          ha="right" if len(settings) > 4 else "center")
        ax.set_xlabel(spec.get("x_label", ""))
        ax.set_ylabel(metric_label(metric, table.cost_unit))
        ax.margins(0.1)
    canvas.settle(figure)
    for ax in axes.values():
        labels.write(ax, [text for where, texts in written if where is ax for text in texts])
    canvas.legend(figure, handles)
    return figure
