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
    panel: str = None   # the only one that it is about
    panels: int = 0     # number of scenes
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
        return self.experiment.label(self.series, self.setting, self.panel)


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


def candidates(points, over, default):
    """(series, setting) -> its points. Where the setting is a question and not a choice, such as how many boxes there
    are, a candidate is a series with all its settings, and its setting is empty. Those that were not measured wherever
    the default was, or wherever anything was, are left out."""
    groups = {}
    for point in points:
        groups.setdefault((point.series, "" if over else point.setting), []).append(point)
    places = {key: {(p.panel, p.setting if over else "") for p in found} for key, found in groups.items()}
    wanted = places.get(default) or set().union(*places.values())
    return {key: [p for p in found if (p.panel, p.setting if over else "") in wanted]
            for key, found in groups.items() if places[key] >= wanted}


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
    if not panels:
        advice.missing = f"no {wanted} in the table"
        return advice
    advice.panel = panels[0] if len(panels) == 1 else None
    over = entry.get("over") == "setting"
    named = entry.get("default", {})
    default_key = str(named.get("series", "")), "" if over else str(named.get("setting", ""))
    # Where the metric does not apply there is nothing to keep.
    points = [p for p in table.points if p.panel in panels and (p.failure or not math.isnan(p.value(advice.metric)))]
    groups = candidates(points, over, default_key)
    advice.panels = len({point.panel for point in points})
    only = entry.get("series")
    fitting = {key: points for key, points in groups.items()
               if (only is None or key[0] == only) and all(good_enough(point, entry) for point in points)}
    default = groups.get(default_key)
    if named and not default:
        advice.default_fails = "it was not measured"
    advice.default = experiment.label(*default_key, advice.panel) if named else ""
    if default:
        advice.default_fails = next((point.failure for point in default if point.failure), "")
        advice.default_value = worst(default, entry["metric"], better).value(entry["metric"])
    if not fitting:
        usable = {key: points for key, points in groups.items() if all(counts_here(p, advice.metric) for p in points)}
        if usable:
            key, points = min(usable.items(), key=lambda item: error_of(worst(item[1], advice.metric, better),
                                                                        advice.metric, better))
            advice.nearest = experiment.label(*key, advice.panel)
            advice.nearest_value = worst(points, advice.metric, better).value(advice.metric)
        return advice
    key, points = min(fitting.items(), key=lambda item: mean_cost(item[1]))
    advice.series, advice.setting = key
    advice.value = worst(points, entry["metric"], better).value(entry["metric"])
    advice.cost = points[0].cost if len(points) == 1 else math.nan
    if default and not advice.default_fails:
        advice.is_default = key == default_key
        advice.ratio = mean_cost(points) / mean_cost(default)
        place = lambda point: (point.panel, point.setting if over else "")
        of = {place(point): point for point in default}
        advice.apart = any(p.cost_high < of[place(p)].cost_low or p.cost_low > of[place(p)].cost_high for p in points)
    return advice


def advices(experiment):
    return [advise(experiment, entry) for entry in experiment.advice]
