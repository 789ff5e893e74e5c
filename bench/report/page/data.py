# SPDX-License-Identifier: MIT
"""Experiments and their tables, as they are in files."""
import csv
import json
import math
import pathlib
import re
import sys
from dataclasses import dataclass, field

FIXED = ["panel", "series", "setting", "x", "cost", "cost_low", "cost_high", "cost_min", "instructions"]


class BadData(Exception):
    """Says in one line, which begins with the file, what is wrong with it."""


class Folder:
    """Tables: files of a directory, or one file that has many, each behind a line with its name."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.packed = None
        if self.path.is_file():
            parts = re.split(r"^== (.*)\n", self.path.read_text(), flags=re.MULTILINE)[1:]
            self.packed = dict(zip(parts[::2], parts[1::2]))

    def text(self, name):
        """None where there is no such table."""
        if self.packed is not None:
            return self.packed.get(name)
        return (self.path / name).read_text() if (self.path / name).exists() else None

    def pack(self, directory):
        """Takes all tables of a directory into this file, in place of those of the same names."""
        tables = {str(file.relative_to(directory)): file.read_text() for file in pathlib.Path(directory).rglob("*.csv")}
        tables = {**(self.packed or {}), **tables}
        self.path.write_text("".join(f"== {name}\n{tables[name]}" for name in sorted(tables)))


def number(text):
    return float(text) if text else math.nan


@dataclass
class Point:
    panel: str
    series: str
    setting: str
    x: float
    cost: float
    cost_low: float
    cost_high: float
    cost_min: float
    instructions: float
    values: dict
    failure: str = ""

    @property
    def key(self):
        return self.panel, self.series, self.setting


@dataclass
class Table:
    folder: Folder
    facts: dict
    controls: list  # (panel, A/A spread)
    metrics: list
    points: list
    curves: dict = field(default_factory=dict)  # (panel, series, setting) -> [(at, value)]

    @property
    def panels(self):
        return unique(point.panel for point in self.points)


@dataclass
class Experiment:
    file: pathlib.Path
    id: str
    document: dict
    table: Table = None
    counts: Table = None  # of the small sizes, run under callgrind

    def knob(self, panel=None):
        """The knob of a setting, if the file names it; panels may have their own knobs."""
        measure = self.document.get("measure", {})
        knob = self.document.get("knob", measure.get("knob"))
        if isinstance(knob, str):
            return knob
        panels = [part for part in measure.get("panels", []) if panel is None or panel in names_of(part)]
        lasts = unique(last_name(part["knobs"]) for part in [measure, *panels] if part.get("knobs"))
        return lasts[0] if len(lasts) == 1 else ""


def unique(values):
    return list(dict.fromkeys(values))


def read_head(lines):
    facts, controls = {}, []
    for line in lines:
        name, _, value = line[1:].strip().partition(": ")
        if name == "twins":
            panel, _, spread = value.rpartition(": ")
            controls.append((panel, float(spread)))
        else:
            facts[name] = value
    return facts, controls


def rows_of(text):
    lines = text.splitlines(keepends=True)
    head = [line for line in lines if line.startswith("#")]
    return head, list(csv.reader(lines[len(head):]))


def read_table(folder, name):
    file = folder.path / name
    head, rows = rows_of(folder.text(name))
    if not rows or rows[0][:len(FIXED)] != FIXED or rows[0][-1] != "failure":
        raise BadData(f"{file}: not a table of points")
    facts, controls = read_head(head)
    metrics = rows[0][len(FIXED):-1]
    points = []
    for row in rows[1:]:
        try:
            numbers = [number(cell) for cell in row[3:-1]]
        except ValueError as error:
            raise BadData(f"{file}: {error}") from None
        if len(numbers) != 6 + len(metrics):
            raise BadData(f"{file}: a row of {len(row)} cells under {len(rows[0])} names")
        points.append(Point(*row[:3], *numbers[:6], dict(zip(metrics, numbers[6:])), row[-1]))
    table = Table(folder, facts, controls, metrics, points)
    curves = folder.text(name.replace(".csv", ".curves.csv")) or ""
    for panel, series, setting, at, value in rows_of(curves)[1][1:]:
        table.curves.setdefault((panel, series, setting), []).append((number(at), number(value)))
    return table


def newest(name, folders):
    """The table of this name that was measured last, or None."""
    tables = [read_table(folder, name) for folder in folders if folder.text(name) is not None]
    return max(tables, key=lambda table: table.facts.get("date", ""), default=None)


def names_of(panel):
    """The panel's own, or those of its scenes."""
    return [panel.get("name"), *(pathlib.Path(scene).stem for scene in panel.get("scenes", []))]


def last_name(knobs):
    """Of a mapping, or of a list of names or descriptions."""
    last = list(knobs)[-1]
    return last if isinstance(last, str) else last.get("name", "")


def in_order(id):
    """Whole scenes first, then boxes, narrow phases, and what must not matter; S2 before S10."""
    letters = id.rstrip("0123456789")
    place = "SBPN".find(letters) if letters else -1
    return place if place >= 0 else 4, letters, int(id[len(letters):] or 0)


def read_experiments(directory, tables):
    """All of a directory, with what `tables` have of them: directories, or files that hold many."""
    folders = [Folder(path) for path in tables]
    experiments = []
    for file in sorted(pathlib.Path(directory).glob("*.json"), key=lambda f: in_order(f.stem)):
        try:
            document = json.loads(file.read_text())
        except json.JSONDecodeError as error:
            raise BadData(f"{file}: {error}") from None
        experiments.append(Experiment(file, file.stem, document, newest(f"{file.stem}.csv", folders),
                                      newest(f"counts/{file.stem}.csv", folders)))
    return experiments


if __name__ == "__main__":  # data.py FILE DIRECTORY: takes the tables of the directory into the file
    Folder(sys.argv[1]).pack(sys.argv[2])
