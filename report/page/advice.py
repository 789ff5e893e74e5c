# SPDX-License-Identifier: MIT
"""Which setting to take: computed from the entries "advice" of the experiments and their tables."""
import math
from dataclasses import dataclass

from front import counts_here, error_of


@dataclass
class Advice:
    experiment: object
    purpose: str        # "stacks of boxes"
    metric: str
    limit: float
    better: str
    series: str = ""    # what to take; empty: nothing measured is good enough
    setting: str = ""
    panels: int = 0     # on so many scenes
    ratio: float = math.nan    # of its cost to the default's; geometric mean over panels
    value: float = math.nan    # the worst over panels
    cost: float = math.nan     # of one panel; NaN if there are more
    default: str = ""
    default_value: float = math.nan
    default_fails: str = ""
    is_default: bool = False
    apart: bool = True   # the intervals of its cost and of the default's do not overlap
    missing: str = ""    # why there is nothing to say

    nearest: str = ""    # what comes nearest to a limit that nothing keeps
    nearest_value: float = math.nan

    @property
    def choice(self):
        return self.experiment.label(self.series, self.setting)


def good_enough(point, entry):
    better = entry.get("better", "low")
    sign = -1 if better == "high" else 1
    return counts_here(point, entry["metric"]) and error_of(point, entry["metric"], better) <= sign * entry["good_enough"]


def mean_cost(points):
    """Geometric, so that no panel outweighs the others."""
    return math.exp(sum(math.log(max(point.cost, 1e-300)) for point in points) / len(points))


def worst(points, metric, better):
    """The point that has the largest error."""
    return max(points, key=lambda point: error_of(point, metric, better))


def candidates(table, panels):
    """(series, setting) -> its points, for those that were measured on all of the panels."""
    groups = {}
    for point in table.points:
        if point.panel in panels:
            groups.setdefault((point.series, point.setting), []).append(point)
    return {key: points for key, points in groups.items() if {p.panel for p in points} == set(panels)}


def advise(experiment, entry):
    """The cheapest setting that stays within the limit on all panels that the entry is about."""
    better = entry.get("better", "low")
    advice = Advice(experiment, entry.get("for", experiment.title), entry["metric"], entry["good_enough"], better)
    table = experiment.table
    if table is None:
        advice.missing = "not measured"
        return advice
    if entry["metric"] not in ["cost", *table.metrics]:
        advice.missing = f"the table has no {entry['metric']}"
        return advice
    wanted = entry.get("panel", "*")
    panels = table.panels if wanted == "*" else [panel for panel in table.panels if panel == wanted]
    groups = candidates(table, panels)
    only = entry.get("series")
    fitting = {key: points for key, points in groups.items()
               if (only is None or key[0] == only) and all(good_enough(point, entry) for point in points)}
    advice.panels = len(panels)
    if not panels:
        advice.missing = f"no {wanted} in the table"
        return advice
    default_key = tuple(str(entry.get("default", {}).get(name, "")) for name in ("series", "setting"))
    default = groups.get(default_key)
    if default:
        advice.default = experiment.label(*default_key)
        advice.default_fails = next((point.failure for point in default if point.failure), "")
        advice.default_value = worst(default, entry["metric"], better).value(entry["metric"])
    if not fitting:
        usable = {key: points for key, points in groups.items() if all(counts_here(p, advice.metric) for p in points)}
        if usable:
            key, points = min(usable.items(), key=lambda item: error_of(worst(item[1], advice.metric, better),
                                                                        advice.metric, better))
            advice.nearest, advice.nearest_value = experiment.label(*key), worst(points, advice.metric, better).value(
                advice.metric)
        return advice
    key, points = min(fitting.items(), key=lambda item: mean_cost(item[1]))
    advice.series, advice.setting = key
    advice.value = worst(points, entry["metric"], better).value(entry["metric"])
    advice.cost = points[0].cost if len(points) == 1 else math.nan
    if default and not advice.default_fails:
        advice.is_default = key == default_key
        advice.ratio = mean_cost(points) / mean_cost(default)
        of = {point.panel: point for point in default}
        advice.apart = any(p.cost_high < of[p.panel].cost_low or p.cost_low > of[p.panel].cost_high for p in points)
    return advice


def all_advice(experiments):
    return [advise(experiment, entry) for experiment in experiments for entry in experiment.advice]
