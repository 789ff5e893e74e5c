# SPDX-License-Identifier: MIT
"""Pareto panels: error over cost."""
import math

import canvas
import labels
from front import counts_here, front
from words import metric_label

REAL_TIME = {"ms per simulated second": 1000.0}


def draw_point(ax, x, y, point, place_x, style, faded):
    alpha = 0.35 if faded else 1
    ends = [place_x(point.cost_low), place_x(point.cost_high)]
    if all(math.isfinite(end) for end in ends):
        ax.plot(ends, [y, y], color=style["color"], alpha=0.6 * alpha, linewidth=1.1, solid_capstyle="butt")
    ax.plot([x], [y], linestyle="none", markersize=4.5, alpha=alpha, markeredgewidth=0, **style)


def cross(ax, at, transform, text, colour, to_the_left=False):
    canvas.cross(ax, *at, colour, transform)
    ax.annotate(text, at, (-7 if to_the_left else 6, -2), xycoords=transform, textcoords="offset points",
                fontsize=labels.SIZE, color=canvas.BAD, annotation_clip=False, ha="right" if to_the_left else "left")


def draw_failures(ax, points, place_x, place_y, styles):
    """A failure has a place where it has numbers; without a cost or an error it is at that border. Of those that have
    neither, each series has a cross in the corner, with its settings."""
    lost = {}
    for point in points:
        colour, text = styles[point.series]["color"], point.setting or point.series
        x, y = place_x(point), place_y(point)
        if math.isnan(x) and math.isnan(y):
            lost.setdefault(point.series, []).append(text)
        elif math.isnan(y):
            cross(ax, (x, 0.96), ax.get_xaxis_transform(), text, colour)
        elif math.isnan(x):
            cross(ax, (0.98, y), ax.get_yaxis_transform(), text, colour, to_the_left=True)
        else:
            cross(ax, (x, y), ax.transData, text, colour)
    for row, (series, texts) in enumerate(lost.items()):
        cross(ax, (0.98, 0.96 - 0.07 * row), ax.transAxes, ", ".join(texts), styles[series]["color"], to_the_left=True)


def visible(axis, value):
    """Where it stands on this axis; NaN if it has no place there."""
    return axis.place(value) if math.isfinite(value) and (value >= 0 or not axis.log) and (
        value > 0 or not axis.log or axis.has_zero) else math.nan


def draw_real_time(ax, unit, axis):
    limit = REAL_TIME.get(unit)
    if limit is None:
        return
    if axis.least / 5 < limit < axis.most * 5:
        ax.axvline(limit, color="#666666", linestyle=(0, (4, 3)), linewidth=1)
        ax.text(limit, 1.02, "real time", transform=ax.get_xaxis_transform(), fontsize=7, color="#666666", ha="center")
    else:
        ax.text(1, 1.02, f"real time: {limit:g}", transform=ax.transAxes, fontsize=7, color="#666666", ha="right")


def plot(table, spec):
    metric, log, better = spec["y"], spec.get("log", "xy"), spec.get("better", "low")
    names = [panel for panel in table.panels
             if any(p.failure or counts_here(p, metric) for p in table.within(panel))]
    figure, axes = canvas.panels(names)
    styles = canvas.styles(dict.fromkeys(point.series for point in table.points))
    handles = {series: canvas.pyplot.Line2D([], [], linestyle="none", markersize=4.5, markeredgewidth=0, **style)
               for series, style in styles.items()}
    written = []
    for name, ax in axes.items():
        points = table.within(name)
        good = [point for point in points if counts_here(point, metric)]
        x_axis, y_axis = canvas.axes_of(ax, [p.cost for p in good], [p.value(metric) for p in good], log)
        best = front(points, metric, better)
        texts = []
        for point in good:
            x, y, style = x_axis.place(point.cost), y_axis.place(point.value(metric)), styles[point.series]
            draw_point(ax, x, y, point, x_axis.place, style, point not in best)
            texts.append((x, y, point.setting or point.series, style["color"] if point in best else "#999999",
                          point in best))
        if best:
            ax.step([x_axis.place(p.cost) for p in best], [y_axis.place(p.value(metric)) for p in best], where="post",
                    color="#555555", linewidth=1, zorder=1.5, gid="front")
        draw_failures(ax, [point for point in points if point.failure], lambda p: visible(x_axis, p.cost),
                      lambda p: visible(y_axis, p.value(metric)), styles)
        draw_real_time(ax, table.cost_unit, x_axis)
        ax.set_xlabel(table.cost_unit)
        ax.set_ylabel(metric_label(metric, table.cost_unit))
        ax.margins(0.12)
        written.append((ax, texts))
    canvas.settle(figure)
    for ax, texts in written:
        labels.write(ax, texts)
    canvas.legend(figure, handles)
    return figure
