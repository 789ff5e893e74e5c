# SPDX-License-Identifier: MIT
"""Whether what an experiment expects came out."""
import math
import operator
from dataclasses import dataclass

OPERATORS = {"==": operator.eq, "!=": operator.ne, "<=": operator.le, ">=": operator.ge, "<": operator.lt,
             ">": operator.gt}


@dataclass
class Verdict:
    text: str
    state: str      # "kept", "broken" or "not measured"
    points: int = 0
    against: str = ""  # the first point that breaks it, and how many more


def judge(experiment, entry):
    """A failed point breaks the expectation; one whose metric does not apply does not count."""
    text = entry.get("text") or f"{entry['metric']} {entry['op']} {entry['value']}"
    table = experiment.table
    points = table.find(**entry.get("where", {})) if table else []
    broken, judged = [], 0
    for point in points:
        value = point.value(entry["metric"])
        if not point.failure and math.isnan(value):
            continue
        judged += 1
        where = " ".join(part for part in point.key if part)
        if point.failure:
            broken.append(f"{where}: {point.failure}")
        elif not OPERATORS[entry["op"]](value, entry["value"]):
            broken.append(f"{where}: {value:.6g}")
    if judged == 0:
        return Verdict(text, "not measured")
    if not broken:
        return Verdict(text, "kept", judged)
    more = f" (and {len(broken) - 1} more)" if len(broken) > 1 else ""
    return Verdict(text, "broken", judged, broken[0] + more)


def verdicts(experiment):
    return [judge(experiment, entry) for entry in experiment.expect]
