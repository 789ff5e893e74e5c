# SPDX-License-Identifier: MIT
"""Matrices of candidates and scenes, or of candidates and settings: green where the metric is 0, redder the further it
is from that."""
import math
from dataclasses import dataclass

import canvas
from data import unique
from words import figure as written

GOOD, FAILED, ABSENT = "#d9efe2", "#f3c5c1", "#f4f4f4"
CELL = 0.62, 0.25  # inches; a longer name of a column needs more


@dataclass
class Matrix:
    title: str
    rows: list
    columns: list
    cells: dict  # (row, column) -> point


def matrices(table, wish):
    """One of candidates and scenes, or one for each scene of candidates and settings."""
    if wish.get("x") == "x":
        return [Matrix(panel, unique(p.series for p in table.within(panel)),
                       unique(p.setting for p in table.within(panel)),
                       {(p.series, p.setting): p for p in table.within(panel)}) for panel in table.panels]
    keys = unique((point.series, point.setting) for point in table.points)
    plain = len({series for series, _ in keys}) == len(keys)
    name = lambda point: point.series if plain else f"{point.series} {point.setting}".strip()
    return [Matrix("", unique(map(name, table.points)), table.panels, {(name(p), p.panel): p for p in table.points})]


def shade(value, most):
    if value == 0:
        return GOOD
    part = math.log1p(abs(value)) / math.log1p(most) if 0 < most < math.inf and value < math.inf else 1
    return tuple(1 - (1 - end) * (0.15 + 0.85 * part) for end in (0.84, 0.37, 0.3))


def cell(point, metric, most):
    """Colour and text."""
    value = point.value(metric) if point else math.nan
    if point and point.failure:
        return FAILED, "×"
    return (ABSENT, "") if math.isnan(value) else (shade(value, most), written(value))


def draw(ax, matrix, metric, most):
    for y, row in enumerate(matrix.rows):
        for x, column in enumerate(matrix.columns):
            colour, text = cell(matrix.cells.get((row, column)), metric, most)
            ax.add_patch(canvas.pyplot.Rectangle((x, y), 0.97, 0.94, facecolor=colour, edgecolor="none"))
            ax.text(x + 0.49, y + 0.5, text, ha="center", va="center", fontsize=7.5,
                    gid="failed" if text == "×" else None)
    ax.set_xlim(0, len(matrix.columns))
    ax.set_ylim(len(matrix.rows), 0)
    slanted = max(map(len, matrix.columns), default=0) > 8
    ax.set_xticks([i + 0.49 for i in range(len(matrix.columns))], matrix.columns, rotation=25 if slanted else 0,
                  ha="right" if slanted else "center")
    ax.set_yticks([i + 0.47 for i in range(len(matrix.rows))], matrix.rows)
    ax.grid(visible=False)
    ax.tick_params(length=0)
    for spine in ax.spines.values():
        spine.set_visible(False)


def plot(table, wish):
    metric, drawn = wish["y"], matrices(table, wish)
    values = [abs(point.value(metric)) for point in table.points]
    most = max((value for value in values if math.isfinite(value)), default=0)
    height = max(len(matrix.rows) for matrix in drawn)
    width = max(len(matrix.columns) for matrix in drawn)
    rows = len(drawn)
    figure, axes = canvas.pyplot.subplots(rows, 1, squeeze=False, layout="constrained")
    figure.set_size_inches(2.6 + max(CELL[0], 1.0 if rows == 1 else 0) * width, rows * (0.8 + CELL[1] * height))
    for ax, matrix in zip(axes.flat, drawn):
        ax.set_title(matrix.title)
        draw(ax, matrix, metric, most)
    return figure
