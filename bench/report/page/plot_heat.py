# SPDX-License-Identifier: MIT
"""Matrices of candidates and scenes, or of candidates and settings: green where the metric is as it should be, 0 if
nothing else is said, and redder the further it is from that."""
import math
from dataclasses import dataclass

import canvas
from data import unique
from words import figure as written

GOOD, FAILED, ABSENT = "#d9efe2", "#f3c5c1", "#f4f4f4"
LETTER = 0.075  # inches


@dataclass
class Matrix:
    title: str
    rows: list
    columns: list
    cells: dict  # (row, column) -> point


def matrices(table, spec):
    """One of candidates and scenes, or one for each scene of candidates and settings."""
    if spec.get("x") == "x":
        return [Matrix(panel, unique(p.series for p in table.within(panel)),
                       unique(p.setting for p in table.within(panel)),
                       {(p.series, p.setting): p for p in table.within(panel)}) for panel in table.panels]
    keys = unique((point.series, point.setting) for point in table.points)
    plain = len({series for series, _ in keys}) == len(keys)
    name = lambda point: point.series if plain else f"{point.series} {point.setting}".strip()
    return [Matrix("", unique(map(name, table.points)), table.panels, {(name(p), p.panel): p for p in table.points})]


def shade(distance, most):
    if distance == 0:
        return GOOD
    part = math.log1p(distance) / math.log1p(most) if distance < math.inf else 1
    return tuple(1 - (1 - end) * (0.15 + 0.85 * part) for end in (0.84, 0.37, 0.3))


def cell(point, metric, good, most):
    """Colour and text."""
    value = point.value(metric) if point else math.nan
    if point and point.failure:
        return FAILED, "×"
    return (ABSENT, "") if math.isnan(value) else (shade(abs(value - good), most), written(value))


def draw(ax, matrix, metric, good, most, named_rows):
    for y, row in enumerate(matrix.rows):
        for x, column in enumerate(matrix.columns):
            colour, text = cell(matrix.cells.get((row, column)), metric, good, most)
            ax.add_patch(canvas.pyplot.Rectangle((x, y), 0.97, 0.94, facecolor=colour, edgecolor="none"))
            ax.text(x + 0.49, y + 0.5, text, ha="center", va="center", fontsize=7.5,
                    gid="failed" if text == "×" else None)
    ax.set_xlim(0, len(matrix.columns))
    ax.set_ylim(len(matrix.rows), 0)
    slanted = len(matrix.columns) > 1 and LETTER * max(map(len, matrix.columns)) > width_of_cell(matrix)
    ax.set_xticks([i + 0.49 for i in range(len(matrix.columns))], matrix.columns, rotation=25 if slanted else 0,
                  ha="right" if slanted else "center")
    ax.set_yticks([i + 0.47 for i in range(len(matrix.rows))], matrix.rows if named_rows else [""] * len(matrix.rows))
    ax.grid(visible=False)
    ax.tick_params(length=0)
    for spine in ax.spines.values():
        spine.set_visible(False)


def width_of_cell(matrix):
    """Inches: more where it is the only matrix, whose columns have long names."""
    return 0.6 if matrix.title else 1.1


def plot(table, spec):
    metric, good, drawn = spec["y"], spec.get("good", 0), matrices(table, spec)
    values = [abs(point.value(metric) - good) for point in table.points]
    most = max((value for value in values if math.isfinite(value)), default=0)
    same = all(matrix.rows == drawn[0].rows for matrix in drawn)
    names = LETTER * max(len(row) for matrix in drawn for row in matrix.rows)
    width = 0.3 + max(width_of_cell(matrix) * len(matrix.columns) for matrix in drawn)
    across = max(1, min(len(drawn), int((11.7 - names) / width))) if same else 1
    down = math.ceil(len(drawn) / across)
    figure, axes = canvas.pyplot.subplots(down, across, squeeze=False, layout="constrained")
    figure.set_size_inches(names + width * across, down * (0.75 + 0.25 * max(len(m.rows) for m in drawn)))
    for ax in axes.flat[len(drawn):]:
        ax.set_visible(False)
    for i, (ax, matrix) in enumerate(zip(axes.flat, drawn)):
        ax.set_title(matrix.title)
        draw(ax, matrix, metric, good, most, i % across == 0)
    return figure
