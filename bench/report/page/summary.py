# SPDX-License-Identifier: MIT
"""The first screen: which setting for what, and what it costs and buys. Every word of it comes from tables."""
import html
import math
import re

from advice import advices
from expectations import verdicts
from markup import escape, table, tag
from words import figure, measured, metric_name, several

LIMIT_OF_CONTROLS = 0.03
# Of 17 pixels, beside what else is there, in 800.
LINES = 36


def cost_text(advice):
    """Against the default, where there is one."""
    if math.isnan(advice.ratio):
        return cost_alone(advice)
    if advice.is_default:
        return "the default" + (f": {cost_alone(advice)}" if not math.isnan(advice.cost) else "")
    if not advice.apart:
        return f"as the default ({advice.ratio:.2f} ×, not significant)"
    return f"{figure(advice.ratio)} × the default"


def limit_text(advice):
    unit = metric_name(advice.metric)[1]
    return f"{advice.limit:g} {unit}".strip()


def cost_alone(advice):
    if math.isnan(advice.cost):
        return ""
    return f"{figure(advice.cost)} {advice.experiment.table.cost_unit}"


def gain_text(advice):
    """Its metric, that of the default, and the bound."""
    known = [f"{'≥' if advice.better == 'high' else '≤'} {limit_text(advice)} asked"]
    if advice.default_fails:
        known.append(f"not the default: {advice.default_fails}")
    elif advice.default and not advice.is_default and not math.isnan(advice.default_value):
        known.append(f"default {measured(advice.metric, advice.default_value)}")
    scenes = f", {advice.panels} scenes" if advice.panels > 1 else ""
    return f"{metric_name(advice.metric)[0]} {measured(advice.metric, advice.value)} ({'; '.join(known)}{scenes})"


def noisy(experiment):
    return experiment.table is not None and any(spread > LIMIT_OF_CONTROLS for _, spread in experiment.table.controls)


def row(advice):
    source = tag("a", escape(advice.experiment.id), href=f"#{advice.experiment.id}")
    purpose = escape(advice.purpose)
    if advice.missing:
        return [purpose, tag("i", escape(advice.missing)), "", "", source]
    name = metric_name(advice.metric)[0]
    if not advice.series:
        text = f"nothing keeps {name} {'≥' if advice.better == 'high' else '≤'} {limit_text(advice)}"
        best = f"nearest: {advice.nearest} with {measured(advice.metric, advice.nearest_value)}" if advice.nearest else ""
        return [purpose, tag("i", escape(text)), "", escape(best), source]
    mark = tag("span", " ≈", title="the A/A controls of this experiment differ by more than 3 %") if noisy(
        advice.experiment) else ""
    return [purpose, tag("b", escape(advice.choice)), escape(cost_text(advice)) + mark,
            escape(gain_text(advice)), source]


def advice_table(rows, class_="advice"):
    """A line each: what is too long for it shows when it is pointed at."""
    return table(["for", "take", "it costs", "it buys", ""], [
        [tag("span", cell, title=re.sub("<[^>]*>", "", html.unescape(cell))) if cell else "" for cell in cells[:4]] +
        cells[4:] for cells in rows], class_)


def state(experiments):
    """One line about the whole: what was kept, what was not, what is noise."""
    judged = [verdict.state for experiment in experiments for verdict in verdicts(experiment)]
    failed = sum(bool(point.failure) for e in experiments if e.table for point in e.table.points)
    points = sum(len(e.table.points) for e in experiments if e.table)
    broken = judged.count("broken")
    parts = [f"{sum(e.table is not None for e in experiments)} of {len(experiments)} experiments measured",
             f"{several(points, 'point')}, {failed} of them failed, drawn as crosses",
             f"criteria: {judged.count('kept')} kept",
             tag("b", f"{broken} broken", class_="bad") if broken else "none broken"]
    if "not measured" in judged:
        parts.append(f"{judged.count('not measured')} not measured")
    loud = [e.id for e in experiments if noisy(e)]
    if loud:
        which = ", ".join(loud) if len(loud) <= 8 else f"{len(loud)} experiments"
        parts.append(tag("span", f"≈ A/A controls differ by more than 3 % in {which}", class_="warn"))
    return tag("p", " · ".join(parts), class_="state")


def origin(experiments):
    """Machines and dates of all tables, each once."""
    runs = {}
    for e in experiments:
        if e.table:
            facts = e.table.facts
            key = (facts.get("cpu", "?"), facts.get("compiler", "?"), facts.get("commit") or "unknown commit",
                   facts.get("date", "?")[:10])
            runs.setdefault(key, []).append(e.id)
    lines = [f"{cpu}, {compiler}, {commit}, {date}" + (f" ({', '.join(ids)})" if len(runs) > 1 else "")
             for (cpu, compiler, commit, date), ids in runs.items()]
    return tag("p", "Measured on " + escape("; ".join(lines)) + ".", class_="origin") if lines else ""


def smoke_warning(experiments):
    smoke = [e.id for e in experiments if e.table and e.table.is_smoke]
    if not smoke:
        return ""
    which = "" if len(smoke) == len(experiments) else f" ({', '.join(smoke)})"
    return tag("p", f"Smoke run{which}: a few points of small sizes, to see that all works. Decide nothing by it.",
               class_="warning")


def that_fit(experiments):
    """As much advice as the first screen has lines for: the first of each experiment, then the second of each, and so
    on; in the order of experiments. Sections have all."""
    found = [(place, e, a) for e, experiment in enumerate(experiments) for place, a in enumerate(advices(experiment))]
    chosen = sorted(found, key=lambda item: item[:2])[:LINES]
    return [a for _, _, a in sorted(chosen, key=lambda item: (item[1], item[0]))]


def summary(experiments):
    rows = [row(advice) for advice in that_fit(experiments)]
    return tag(
        "section", tag("h1", "What accuracy costs in time"),
        tag("p", "For this kind of scene, this setting: the cheapest that was measured within the bound. ",
            "Your own: ", tag("code", "boxstream accuracy SCENE.json --knob substeps=1,2,4,8 --metric penetration"),
            class_="lead"),
        smoke_warning(experiments), advice_table(rows), state(experiments), origin(experiments), id="summary")
