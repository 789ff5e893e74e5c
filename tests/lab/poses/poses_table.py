#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Gives every hard pose to every manager and solver, each in a process of its own, and prints what came of it as a table;
so with many that are a hair apart or inside each other.

Exit code 1 if a pair is not delivered exactly once, or
boxstream::ccd is wrong. Takes a minute.
"""
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402

POSES, GAPS = "hard poses", "small gaps"
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
    return cells


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
              f"- Under FCL's own manager (DynamicAABBTree) {same} of the {2 * len(poses)} outcomes of FCL are the same.", ""]
    return "\n".join(lines) + "\n" + marked_page.lines_of(head, [row(pose) for pose in poses])


def count(row, who, *kinds):
    return sum(row[who].get(kind, 0) for kind in kinds)


def gaps_table(rows):
    head = ["Gap", *(f"{title}: right / wrong / throws / ends the program" for title in SOLVERS.values()),
            "boxstream::ccd: right / says it is not sure / wrong"]
    total = sum(rows[0]["ccd"].values())
    lines = [f"{total} poses for each gap: boxes face on face, boxes and hulls at whatever is closest, all turned.", ""]
    table_rows = []
    for row in rows:
        cells = [f"{row['gap']:g}"]
        for solver in SOLVERS:
            ends = total - count(row, solver, "right", "wrong", "throws")
            cells.append(" / ".join(str(count(row, solver, kind)) for kind in ("right", "wrong", "throws")) + f" / {ends}")
        cells.append(" / ".join(str(count(row, "ccd", kind)) for kind in ("right", "honest", "wrong")))
        table_rows.append(cells)
    return "\n".join(lines) + "\n" + marked_page.lines_of(head, table_rows)


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
    parser = marked_page.parser(__doc__)
    parser.add_argument("probe", metavar="PROBE", help="boxstream_pose_probe")
    parser.add_argument("--record", type=pathlib.Path, metavar="POSES.json",
                        help="write what FCL answered into the file of poses: the tests then expect it")
    options = parser.parse_args()
    marked_page.require_marks(options.into, POSES, GAPS)
    run = subprocess.run([options.probe, "--all"], stdout=subprocess.PIPE, text=True)
    if run.returncode != 0:
        return 2
    report = json.loads(run.stdout)
    poses, gaps = report["poses"], report["gaps"]
    if options.record:
        record(options.record, poses)
    marked_page.put_out(table(poses), options.into, POSES)
    marked_page.put_out(gaps_table(gaps), options.into, GAPS)
    bad = any(delivered(pose) != "once" or pose["ccd"]["outcome"] == "wrong" for pose in poses)
    return int(bad or any(count(row, "ccd", "wrong") > 0 for row in gaps))


if __name__ == "__main__":
    sys.exit(main())
