# SPDX-License-Identifier: MIT
"""Metrics of a point on top of each other: what a whole is made of."""
import math

import canvas
from words import metric_label


def metrics_of(table, spec):
    """"y" is a metric or a list of them; without it all."""
    wanted = spec.get("y") or table.metrics
    return [wanted] if isinstance(wanted, str) else list(wanted)


def bar_name(point):
    return point.series if point.setting == point.series else f"{point.series} {point.setting}".strip()


def plot(table, spec):
    metrics = metrics_of(table, spec)
    figure, axes = canvas.panels(table.panels)
    most = max(len(table.within(panel)) for panel in table.panels)
    rows = math.ceil(len(table.panels) / min(len(table.panels), 3))
    figure.set_figheight(rows * max(2.2, 0.9 + 0.24 * most) + 0.3)
    handles = {}
    for panel, ax in axes.items():
        points = table.within(panel)
        for place, point in enumerate(points):
            if point.failure:
                canvas.cross(ax, 0.02, place, canvas.BAD, ax.get_yaxis_transform())
                continue
            left = 0.0
            for i, metric in enumerate(metrics):
                value = point.value(metric)
                if not math.isfinite(value):
                    continue
                handles[metric_label(metric, table.cost_unit)] = ax.barh(
                    place, value, left=left, height=0.7, color=canvas.COLOURS[i % len(canvas.COLOURS)])
                left += value
        ax.set_yticks(range(len(points)), [bar_name(point) for point in points])
        ax.set_ylim(len(points) - 0.4, -0.6)
        ax.grid(axis="y", visible=False)
        if "x" in spec.get("log", ""):
            ax.set_xscale("log")
    if len(metrics) == 1:
        for ax in axes.values():
            ax.set_xlabel(metric_label(metrics[0], table.cost_unit))
    canvas.legend(figure, handles)
    return figure
