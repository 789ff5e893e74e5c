# SPDX-License-Identifier: MIT
"""An experiment on the page: question, plots, verdicts, numbers, and how to get them again."""
import math

import front
from advice import advices
from expectations import verdicts
from markup import download, escape, table, tag
from summary import LIMIT_OF_CONTROLS, advice_table, row
from words import figure, metric_label, metric_name, percent, several

MARKS = {"kept": ("kept", "good"), "broken": ("broken", "bad"), "not measured": ("not measured", "warn")}


def criteria(experiment):
    rows = []
    for verdict in verdicts(experiment):
        text, style = MARKS[verdict.state]
        note = verdict.against or (several(verdict.points, "point") if verdict.state == "kept" else "")
        rows.append([(text, style), escape(verdict.text), escape(note)])
    return tag("h3", "Expected") + table(["", "criterion", ""], rows, "criteria") if rows else ""


def advice(experiment):
    rows = [row(found)[:4] + [""] for found in advices(experiment)]
    return advice_table(rows) if rows else ""


def picture(drawn):
    if drawn.missing:
        return tag("figure", tag("figcaption", escape(f"{drawn.title}: {drawn.missing}"), class_="warn"), id=drawn.name)
    return tag("figure", tag("figcaption", escape(drawn.title), " ",
                             download("SVG", drawn.name + ".svg", "image/svg+xml", drawn.svg)), drawn.svg,
               id=drawn.name)


def counted(experiment):
    """Key of a point -> instructions: of the table itself, else of the small sizes. And which of both."""
    own = {p.key: p.instructions for p in experiment.table.points if not math.isnan(p.instructions)}
    if own or experiment.counts is None:
        return own, "instructions"
    small = {p.key: p.instructions for p in experiment.counts.points if not math.isnan(p.instructions)}
    return small, "instructions (small sizes)"


def cost_cells(point):
    if math.isnan(point.cost):
        return ["–", ""]
    return [figure(point.cost), f"{figure(point.cost_low)} … {figure(point.cost_high)}"]


def points_table(experiment):
    data = experiment.table
    instructions, name = counted(experiment)
    head = ["scene", "candidate", "setting", escape(data.cost_unit), "95 % interval"]
    head += [name] if instructions else []
    head += [escape(metric_label(metric)) for metric in data.metrics] + [""]
    rows = []
    for point in data.points:
        row = [escape(point.panel), escape(point.series), escape(point.setting), *((c, "n") for c in cost_cells(point))]
        if instructions:
            row.append((figure(instructions.get(point.key, math.nan)), "n"))
        row += [(figure(point.values[metric]), "n") for metric in data.metrics]
        rows.append([*row, (escape("× " + point.failure), "bad") if point.failure else ""])
    return tag("details", tag("summary", "Numbers: " + several(len(rows), "point")), table(head, rows, "points"))


def volumes(experiment):
    """How much of the plane the front of each series reaches, where there is more than one."""
    out = ""
    for spec in experiment.plots:
        if spec["kind"] != "front" or spec["y"] not in experiment.table.metrics:
            continue
        data, better = experiment.table, spec.get("better", "low")
        by_panel = {panel: front.hypervolumes(data.within(panel), spec["y"], better) for panel in data.panels}
        series = list(dict.fromkeys(point.series for point in data.points))
        by_panel = {panel: found for panel, found in by_panel.items() if set(found) == set(series)}
        if len(series) < 2 or not by_panel:
            continue
        ranks = {panel: front.ranks(found) for panel, found in by_panel.items()}
        mean = {name: sum(ranks[panel][name] for panel in ranks) / len(ranks) for name in series}
        rows = [[escape(name), *((f"{by_panel[panel][name]:.3f} ({ranks[panel][name]:g})", "n") for panel in by_panel),
                 (f"{mean[name]:.2f}", "n")] for name in sorted(series, key=mean.get)]
        difference = front.critical_difference(len(series), len(by_panel))
        note = f" Mean ranks nearer than {difference:.2f} are not significantly different (Nemenyi, 5 %)." if difference else ""
        out += tag("details", tag("summary", escape(f"Hypervolume of cost and {metric_name(spec['y'])[0]}, and ranks")),
                   tag("p", "Part of the plane, scaled to what was measured on each scene, that the front of a "
                       "candidate reaches; 1 is all of it. In brackets its rank." + note),
                   table(["candidate", *map(escape, by_panel), "mean rank"], rows, "points"))
    return out


def control(experiment):
    data = experiment.table
    if not data.controls:
        return ""
    known = [(panel, spread) for panel, spread in data.controls if not math.isnan(spread)]
    if not known:
        return tag("p", "A/A: the candidate that was measured twice failed, so the noise is not known.", class_="control warn")
    text = "A/A: two series of the same candidate differ by " + ", ".join(
        f"{percent(spread)} ({panel})" if panel else percent(spread) for panel, spread in known) + "."
    if all(spread <= LIMIT_OF_CONTROLS for _, spread in known):
        return tag("p", escape(text), class_="control")
    return tag("p", tag("b", "Times are noisy. "), escape(text), " Above 3 %: differences of time in this size are not significant "
               "here.", class_="control warn")


def origin(experiment, fresh):
    data = experiment.table
    facts = [data.facts.get(name, "") for name in ("cpu", "compiler", "flags", "simd")]
    commit = data.facts.get("commit") or "unknown"
    where = "" if fresh else " These are the stored figures, not of a run here."
    links = download("CSV", f"{experiment.id}.csv", "text/csv", data.text)
    if data.curves_text:
        links += " " + download("CSV of curves", f"{experiment.id}.curves.csv", "text/csv", data.curves_text)
    text = f"{', '.join(fact for fact in facts if fact)}; commit {commit}; {data.facts.get('date', '?')}; " \
           f"{data.facts.get('repeats', '?')} timed runs of each; load {data.facts.get('load', '?')}.{where}"
    return tag("p", tag("code", escape(data.facts.get("command", "?"))), " makes it again. ", links, class_="again") + \
        tag("p", escape(text), class_="origin")


def counts_note(experiment):
    instructions, name = counted(experiment)
    if not instructions or name == "instructions":
        return ""
    facts = experiment.counts.facts
    return tag("p", f"Instructions were counted by callgrind on the small sizes ({escape(facts.get('date', '?')[:10])}): "
               "whole ones would take hours. They have no noise, and compare candidates, not with the times beside "
               "them.", class_="origin")


def section(experiment, pictures, fresh):
    parts = [tag("h2", f"{escape(experiment.id)} ", escape(experiment.title))]
    if experiment.question:
        parts.append(tag("p", escape(experiment.question), class_="question"))
    if experiment.source:
        parts.append(tag("p", "Source: " + escape(experiment.source), class_="source"))
    if experiment.table is None:
        parts.append(tag("p", "Not measured here yet: ", tag("code", f"./dev report {escape(experiment.id)}"),
                         class_="warning"))
    else:
        parts += [advice(experiment), *(picture(drawn) for drawn in pictures), criteria(experiment), control(experiment),
                  volumes(experiment), points_table(experiment), counts_note(experiment), origin(experiment, fresh)]
    return tag("section", *parts, id=experiment.id, class_="experiment")
