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


def specs(experiment):
    """Those of its file; without any a front of each metric."""
    metrics = experiment.table.metrics if experiment.table else []
    return experiment.plots or [{"kind": "front", "y": metric} for metric in metrics]


def metrics_in(spec):
    wanted = spec.get("y", [])
    return [wanted] if isinstance(wanted, str) else list(wanted)


def title_of(spec):
    names = ", ".join("cost" if m == "cost" else metric_name(m)[0] for m in metrics_in(spec))
    ends = {"front": "against cost", "lines": "over the knob", "bars": "of each candidate",
            "heat": "of each candidate on each scene", "curves": "over time"}
    return spec.get("title") or f"{names} {ends[spec['kind']]}".strip().capitalize()


def unable(table, spec):
    """Why a plot cannot be drawn, or nothing."""
    if spec["kind"] == "curves":
        return "" if table.curves else "no curves were recorded"
    absent = [metric for metric in metrics_in(spec) if metric not in ["cost", *table.metrics]]
    return f"the table has no {absent[0]}" if absent else ""


def with_defaults(experiment, spec):
    """What a matrix paints green is what is expected, and lines are over the knob, if the file does not say."""
    if spec["kind"] == "lines":
        return {"x_label": experiment.knob(), **spec}
    wanted = {entry["value"] for entry in experiment.expect
              if entry["op"] == "==" and entry["metric"] == spec.get("y")}
    return {"good": wanted.pop(), **spec} if len(wanted) == 1 else spec


def draw_one(experiment, number, spec):
    spec = with_defaults(experiment, spec)
    name = f"{experiment.id}-{number}-{spec['kind']}"
    reason = unable(experiment.table, spec)
    if reason:
        return Picture(name, title_of(spec), missing=reason)
    return Picture(name, title_of(spec), canvas.to_svg(KINDS[spec["kind"]](experiment.table, spec), name))


def draw(experiment):
    """A picture for each spec."""
    if experiment.table is None or not experiment.table.points:
        return []
    return [draw_one(experiment, i, spec) for i, spec in enumerate(specs(experiment), 1)]
