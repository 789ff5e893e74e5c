#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the scenes of demos/scenes/hard on every broad-phase and prints what became of their criteria, as a table.

usage: hard_table.py BOXSTREAM [--into PAGE.md]

BOXSTREAM is the tool, in a directory that has the scenes beside it. --into replaces what is between the two marks
in a page. Exit code 1 if boxstream fails a criterion that another one meets, or any misses a pair.
"""
import json
import pathlib
import subprocess
import sys

SCENES = pathlib.Path(__file__).resolve().parents[2] / "demos" / "scenes" / "hard"
BROADPHASES = ["boxstream", "dbvt", "dbvt-deferred", "sap", "simple"]
MOST_OBJECTS_OF_SIMPLE = 300  # as in hard_test.cpp
MARKS = "<!-- hard scenes: begin -->\n", "<!-- hard scenes: end -->\n"
EVERYWHERE = ("missed_pairs == 0, always", "finite == 1, always")


def checks_of(tool, name, broadphase):
    command = [tool, "simulate", f"hard/{name}", "--broadphase", broadphase, "--json", "-"]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode not in (0, 1) or not run.stdout:
        raise SystemExit(f"{' '.join(command)}: {run.stderr.strip()}")
    return json.loads(run.stdout)["worlds"][0]["checks"]


def cell(check):
    value = f"{check['value']:.0f}" if float(check["value"]).is_integer() else f"{check['value']:.4g}"
    return value if check["passed"] else f"{value} in step {check['step']}"


def outcome(by_name):
    failed = [name for name, check in by_name.items() if not check["passed"]]
    if not failed:
        return "passed"
    return "failed, on all alike" if len(failed) == len(by_name) else f"failed, on {', '.join(failed)} only"


def rows_of(name, runs):
    """Criteria that all scenes have are told once, unless they are not met."""
    for checks in zip(*runs.values()):
        by_name = dict(zip(runs, checks))
        told = outcome(by_name)
        if checks[0]["check"] in EVERYWHERE and told == "passed":
            continue
        assert len({check["check"] for check in checks}) == 1
        cells = [cell(by_name[b]) if b in by_name else "-" for b in BROADPHASES]
        yield [f"`{name}`", checks[0]["check"], *cells, told]


def table(tool):
    rows, runs_in_all = [], 0
    names = sorted(file.stem for file in SCENES.glob("*.json"))
    for number, name in enumerate(names, 1):
        print(f"{number}/{len(names)} {name}", file=sys.stderr)
        small = json.loads((SCENES / f"{name}.json").read_text())["expect"]["objects"] <= MOST_OBJECTS_OF_SIMPLE
        runs = {b: checks_of(tool, name, b) for b in BROADPHASES if small or b != "simple"}
        runs_in_all += len(runs)
        rows.extend(rows_of(name, runs))
    bad = [row for row in rows if row[-1].startswith("failed, on boxstream") or row[1] in EVERYWHERE]
    lines = [f"{len(names)} scenes, {runs_in_all} runs. No pair missed and every number finite, in every step: "
             f"{'not so, see below' if any(row[1] in EVERYWHERE for row in bad) else 'so in all runs'}.", ""]
    head = ["Scene", "Criterion", *BROADPHASES, "Outcome"]
    return "\n".join(lines) + "\n" + lines_of(head, rows), bool(bad)


def page_of(arguments, usage):
    """The page to write to, if any, and an exit code if that is all there is to do."""
    if "--help" in arguments or len(arguments) not in (1, 3) or (len(arguments) == 3 and arguments[1] != "--into"):
        print(usage.strip())
        return None, 0 if "--help" in arguments else 2
    return pathlib.Path(arguments[2]) if len(arguments) == 3 else None, None


def has_marks(page, marks):
    if page.is_file() and all(mark in page.read_text() for mark in marks):
        return True
    print(f"{page}: no such page, or it has no marks", file=sys.stderr)
    return False


def put_out(text, page, marks):
    if not page:
        print(text, end="")
        return
    before, rest = page.read_text().split(marks[0])
    page.write_text(before + marks[0] + text + marks[1] + rest.split(marks[1])[1])


def lines_of(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *rows)) + "\n"


def main(arguments):
    page, done = page_of(arguments, __doc__)
    if done is not None:
        return done
    if page and not has_marks(page, MARKS):
        return 2
    text, bad = table(arguments[0])
    put_out(text, page, MARKS)
    return int(bad)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
