#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Gives every hard pose to every manager and solver, each in a process of its own, and prints what came of it as a table;
so with many that are a hair apart or inside each other.

usage: poses_table.py PROBE [--into PAGE.md] [--record POSES.json]

PROBE is boxstream_pose_probe. --into replaces what is between the two marks in a page. --record writes what FCL answered
into the file of poses: the tests then expect it. Exit code 1 if a pair is not delivered exactly once, or
boxstream::ccd is wrong. Takes a minute.
"""
import argparse
import json
import pathlib
import subprocess
import sys

POSES = ("<!-- hard poses: begin -->\n", "<!-- hard poses: end -->\n")
GAPS = ("<!-- small gaps: begin -->\n", "<!-- small gaps: end -->\n")
SOLVERS = {"libccd": "FCL, libccd", "indep": "FCL, its own solver"}


def number(value):
    return f"{value + 0.0:.7g}"


def fcl_cell(outcome):
    kind, message = outcome["outcome"], outcome.get("message", "")
    value = number(outcome["value"]) if "value" in outcome else "no contact"
    if kind == "right":
        return f"right, {value}"
    if kind == "wrong":
        return f"**wrong**, {value}" + ("" if message in ("distance", "depth") else f": {message}")
    return f"**{kind}**"


def ours_cell(outcome):
    if outcome["outcome"] == "no such shape":
        return "-"
    value = number(outcome["value"])
    return f"{outcome['outcome']}, {value}" + (f": {outcome['why']}" if outcome["why"] else "")


def delivered(pose):
    runs = pose["boxstream"].values()
    lived = [run for run in runs if run["outcome"] in ("right", "wrong", "throws")]
    once = all(run["delivered"] == 1 and run["in_order"] for run in runs) and all(run["after"] == 1 for run in lived)
    return "once" if once else "**not once**"


def row(pose):
    name = f"`{pose['name']}`" + ("*" if pose["own"] else "")
    cells = [str(pose["row"]), name, pose["source"], f"{pose['a']}, {pose['b']}", pose["query"], number(pose["truth"]),
             delivered(pose), *(fcl_cell(pose["boxstream"][s]) for s in SOLVERS), ours_cell(pose["ccd"])]
    return "| " + " | ".join(cells) + " |"


def tally(outcomes):
    counts = {}
    for outcome in outcomes:
        counts[outcome] = counts.get(outcome, 0) + 1
    return ", ".join(f"{kind} {count}" for kind, count in sorted(counts.items(), key=lambda item: -item[1]))


def table(poses):
    head = ["Row", "Pose", "Source", "Shapes", "Asked for", "Truth", "Delivered", *SOLVERS.values(), "boxstream::ccd"]
    once = sum(delivered(pose) == "once" for pose in poses)
    same = sum(pose["native"][s]["outcome"] == pose["boxstream"][s]["outcome"] for pose in poses for s in SOLVERS)
    lines = [f"{len(poses)} poses; {once} delivered exactly once, A first, and again after the narrow phase answered or "
             "threw.", ""]
    lines += [f"- {title}: {tally(pose['boxstream'][s]['outcome'] for pose in poses)}." for s, title in SOLVERS.items()]
    lines += [f"- boxstream::ccd: {tally(pose['ccd']['outcome'] for pose in poses)}.",
              f"- Under FCL's own manager (DynamicAABBTree) {same} of the {2 * len(poses)} outcomes of FCL are the same.", "",
              "| " + " | ".join(head) + " |", "| " + " | ".join(["---"] * len(head)) + " |"]
    return "\n".join(lines + [row(pose) for pose in poses]) + "\n"


def count(row, who, *kinds):
    return sum(row[who].get(kind, 0) for kind in kinds)


def gaps_table(rows):
    head = ["Gap", *(f"{title}: right / wrong / throws / ends the program" for title in SOLVERS.values()),
            "boxstream::ccd: right / says it is not sure / wrong"]
    total = sum(rows[0]["ccd"].values())
    lines = [f"{total} poses for each gap: boxes face on face, boxes and hulls at whatever is closest, all turned.", "",
             "| " + " | ".join(head) + " |", "| " + " | ".join(["---"] * len(head)) + " |"]
    for row in rows:
        cells = [f"{row['gap']:g}"]
        for solver in SOLVERS:
            ends = total - count(row, solver, "right", "wrong", "throws")
            cells.append(" / ".join(str(count(row, solver, kind)) for kind in ("right", "wrong", "throws")) + f" / {ends}")
        cells.append(" / ".join(str(count(row, "ccd", kind)) for kind in ("right", "honest", "wrong")))
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def replace(text, marks, inner):
    begin, end = marks
    before, rest = text.split(begin)
    return before + begin + inner + end + rest.split(end)[1]


def record(page, poses):
    document = json.loads(page.read_text())
    by_name = {pose["name"]: pose["boxstream"] for pose in poses}
    for pose in document["poses"]:
        for solver in SOLVERS:
            outcome = by_name[pose["name"]][solver]
            pose[solver] = {key: outcome[key] for key in ("outcome", "value") if key in outcome}
    lines = ",\n".join("    " + json.dumps(pose) for pose in document["poses"])
    page.write_text('{\n  "poses": [\n' + lines + "\n  ]\n}\n")


def main():
    if "--help" in sys.argv[1:] or len(sys.argv) < 2:
        print(__doc__.strip())
        return 0 if "--help" in sys.argv[1:] else 2
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("probe")
    parser.add_argument("--into", type=pathlib.Path)
    parser.add_argument("--record", type=pathlib.Path)
    arguments = parser.parse_args()
    page = arguments.into
    if page and (not page.is_file() or any(mark not in page.read_text() for mark in POSES + GAPS)):
        print(f"{page}: no such page, or it has no marks", file=sys.stderr)
        return 2
    run = subprocess.run([arguments.probe, "--all"], stdout=subprocess.PIPE, text=True)
    if run.returncode != 0:
        return 2
    report = json.loads(run.stdout)
    poses, gaps = report["poses"], report["gaps"]
    if arguments.record:
        record(arguments.record, poses)
    if page:
        page.write_text(replace(replace(page.read_text(), POSES, table(poses)), GAPS, gaps_table(gaps)))
    else:
        print(table(poses), gaps_table(gaps), sep="\n", end="")
    bad = any(delivered(pose) != "once" or pose["ccd"]["outcome"] == "wrong" for pose in poses)
    return int(bad or any(count(row, "ccd", "wrong") > 0 for row in gaps))


if __name__ == "__main__":
    sys.exit(main())
