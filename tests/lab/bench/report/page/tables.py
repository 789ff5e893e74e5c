# SPDX-License-Identifier: MIT
"""Small experiments and tables for tests of the page."""
import json
import pathlib
import sys

REPORT = pathlib.Path(__file__).resolve().parents[5] / "bench" / "report"
sys.path.insert(0, str(REPORT / "page"))

HEAD = """# experiment: E1
# title: A title
# command: ./dev report E1
# cost: ms per simulated second
# repeats: 9
# date: {date}
# cpu: Some CPU
# compiler: g++ 12
# commit: abc123
# twins: wall: {spread}
"""
NAMES = "panel,series,setting,x,cost,cost_low,cost_high,cost_min,instructions"


def row(panel, series, setting, cost, values, failure="", spread=0.1, instructions=""):
    """`cost`: a number, or None where there is none."""
    numbers = ["", "", "", ""] if cost is None else [cost, cost * (1 - spread), cost * (1 + spread), cost]
    return ",".join(map(str, [panel, series, setting, setting, *numbers, instructions, *values, failure]))


def table_text(rows, metrics=("error_m",), date="2026-01-02T03:04:05Z", twins=0.01):
    return HEAD.format(date=date, spread=twins) + ",".join([NAMES, *metrics, "failure"]) + "\n" + "".join(
        line + "\n" for line in rows)


def write_experiment(directory, id="E1", **keys):
    directory = pathlib.Path(directory) / "experiments"
    directory.mkdir(exist_ok=True)
    document = {"title": "A title", "kind": "scene", "question": "Which?", "source": "Nobody", **keys}
    (directory / f"{id}.json").write_text(json.dumps(document))
    return directory


def write_table(directory, rows, id="E1", **keys):
    directory = pathlib.Path(directory)
    directory.mkdir(exist_ok=True, parents=True)
    (directory / f"{id}.csv").write_text(table_text(rows, **keys))
    return directory / f"{id}.csv"


def data_of(page):
    """The JSON that a page draws."""
    return json.loads(page.partition('id="data">')[2].partition("</script>")[0])
