# SPDX-License-Identifier: MIT
"""Kinds of plots, by name."""
from dataclasses import dataclass

import canvas
import plot_bars
import plot_curves
import plot_front
import plot_heat
import plot_lines
from words import metric_name

KINDS = {"front": plot_front.plot, "lines": plot_lines.plot, "bars": plot_bars.plot, "heat": plot_heat.plot,
         "curves": plot_curves.plot}


@dataclass
class Picture:
    name: str
    title: str
    svg: str = ""
    missing: str = ""  # why there is none


def wishes(experiment):
    """Those of its file; without any a front of each metric."""
    metrics = experiment.table.metrics if experiment.table else []
    return experiment.plots or [{"kind": "front", "y": metric} for metric in metrics]


def metrics_in(wish):
    wanted = wish.get("y", [])
    return [wanted] if isinstance(wanted, str) else list(wanted)


def title_of(wish):
    names = ", ".join("cost" if m == "cost" else metric_name(m)[0] for m in metrics_in(wish))
    ends = {"front": "against cost", "lines": "over the knob", "bars": "of each candidate",
            "heat": "of each candidate on each scene", "curves": "over time"}
    return wish.get("title") or f"{names} {ends[wish['kind']]}".strip().capitalize()


def unable(table, wish):
    """Why a plot cannot be drawn, or nothing."""
    if wish["kind"] == "curves":
        return "" if table.curves else "no curves were recorded"
    absent = [metric for metric in metrics_in(wish) if metric not in ["cost", *table.metrics]]
    return f"the table has no {absent[0]}" if absent else ""


def with_defaults(experiment, wish):
    """What a matrix paints green is what is expected, and lines are over the knob, if the file does not say."""
    if wish["kind"] == "lines":
        return {"x_label": experiment.knob(), **wish}
    wanted = {entry["value"] for entry in experiment.expect
              if entry["op"] == "==" and entry["metric"] == wish.get("y")}
    return {"good": wanted.pop(), **wish} if len(wanted) == 1 else wish


def draw_one(experiment, number, wish):
    wish = with_defaults(experiment, wish)
    name = f"{experiment.id}-{number}-{wish['kind']}"
    reason = unable(experiment.table, wish)
    if reason:
        return Picture(name, title_of(wish), missing=reason)
    return Picture(name, title_of(wish), canvas.to_svg(KINDS[wish["kind"]](experiment.table, wish), name))


def draw(experiment):
    """A picture for each wish."""
    if experiment.table is None or not experiment.table.points:
        return []
    return [draw_one(experiment, i, wish) for i, wish in enumerate(wishes(experiment), 1)]
