# SPDX-License-Identifier: MIT
"""Matrix of candidates and scenes: green where the metric is 0, redder the further it is from that."""
import math

import canvas
from words import figure as written

GOOD, FAILED, ABSENT = "#d9efe2", "#f3c5c1", "#f4f4f4"


def rows_of(table):
    """Candidates, by series and setting; the setting is left out where there is only one of each series."""
    keys = list(dict.fromkeys((point.series, point.setting) for point in table.points))
    plain = len({series for series, _ in keys}) == len(keys)
    return {key: key[0] if plain else " ".join(part for part in key if part) for key in keys}


def shade(value, most):
    if value == 0:
        return GOOD
    part = math.log1p(abs(value)) / math.log1p(most) if most > 0 else 1
    return tuple(1 - (1 - end) * (0.15 + 0.85 * part) for end in (0.84, 0.37, 0.3))


def plot(table, wish):
    metric = wish["y"]
    rows, columns = rows_of(table), table.panels
    cells = {(p.series, p.setting, p.panel): p for p in table.points}
    most = max((abs(p.value(metric)) for p in table.points if math.isfinite(p.value(metric))), default=0)
    figure, axes = canvas.panels([""], wide=True)
    ax = axes[""]
    figure.set_size_inches(2.6 + 1.15 * len(columns), 1.2 + 0.27 * len(rows))
    for row, key in enumerate(rows):
        for column, panel in enumerate(columns):
            point = cells.get((*key, panel))
            value = point.value(metric) if point else math.nan
            colour, text = ABSENT, ""
            if point and point.failure:
                colour, text = FAILED, "×"
            elif math.isfinite(value):
                colour, text = shade(value, most), written(value)
            ax.add_patch(canvas.pyplot.Rectangle((column, row), 0.97, 0.94, facecolor=colour, edgecolor="none"))
            ax.text(column + 0.49, row + 0.5, text, ha="center", va="center", fontsize=7.5,
                    gid="failed" if text == "×" else None)
    ax.set_xlim(0, len(columns))
    ax.set_ylim(len(rows), 0)
    ax.set_xticks([i + 0.49 for i in range(len(columns))], columns, rotation=25 if len(columns) > 3 else 0,
                  ha="right" if len(columns) > 3 else "center")
    ax.set_yticks([i + 0.47 for i in range(len(rows))], rows.values())
    ax.grid(visible=False)
    ax.tick_params(length=0)
    for spine in ax.spines.values():
        spine.set_visible(False)
    return figure
