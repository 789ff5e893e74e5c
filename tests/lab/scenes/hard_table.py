#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the scenes of demos/scenes/hard on every broad-phase and prints what became of their criteria, as a table; and
another of what the settings cost with which those that fail hold (scenes named *_stable).

Exit code 1 if boxstream fails a criterion that another one meets, or any misses a pair.
"""
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402

SCENES = pathlib.Path(__file__).resolve().parents[3] / "demos" / "scenes" / "hard"
BROADPHASES = ["boxstream", "dbvt", "dbvt-deferred", "sap", "simple"]
MOST_OBJECTS_OF_SIMPLE = 300  # as in hard_test.cpp
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


def runs_of_all(tool):
    """Scene -> broad-phase -> its checks."""
    runs = {}
    names = sorted(file.stem for file in SCENES.glob("*.json"))
    for number, name in enumerate(names, 1):
        print(f"{number}/{len(names)} {name}", file=sys.stderr)
        small = json.loads((SCENES / f"{name}.json").read_text())["expect"]["objects"] <= MOST_OBJECTS_OF_SIMPLE
        runs[name] = {b: checks_of(tool, name, b) for b in BROADPHASES if small or b != "simple"}
    return runs


def table(all_runs):
    rows = [row for name, runs in all_runs.items() for row in rows_of(name, runs)]
    bad = [row for row in rows if row[-1].startswith("failed, on boxstream") or row[1] in EVERYWHERE]
    lines = [f"{len(all_runs)} scenes, {sum(map(len, all_runs.values()))} runs. No pair missed and every number finite, in every step: "
             f"{'not so, see below' if any(row[1] in EVERYWHERE for row in bad) else 'so in all runs'}.", ""]
    head = ["Scene", "Criterion", *BROADPHASES, "Outcome"]
    return "\n".join(lines) + "\n" + marked_page.lines_of(head, rows), bool(bad)


def settings_of(scene):
    settings = {"substep": scene["time"].get("substeps", 1), "iteration": scene.get("solver", {}).get("iterations", 10)}
    return ", ".join(f"{value} {name}{'' if value == 1 else 's'}" for name, value in settings.items())


def step_ms(tool, name):
    run = subprocess.run([tool, "simulate", f"hard/{name}", "--json", "-"], capture_output=True, text=True)
    return json.loads(run.stdout)["worlds"][0]["summary"]["step"]["total_ms"]


def prices(tool, all_runs):
    """Medians of five interleaved runs on boxstream."""
    rows = []
    for file in sorted(SCENES.glob("*_stable.json")):
        stable, default = file.stem, file.stem.removesuffix("_stable")
        print(f"price of {stable}", file=sys.stderr)
        runs = [(step_ms(tool, default), step_ms(tool, stable)) for _ in range(5)]
        ratios = sorted(b / a for a, b in runs)
        # Some fail on one broad-phase alone.
        failed = dict.fromkeys(c["check"] for checks in all_runs[default].values() for c in checks if not c["passed"])
        rows.append([f"`{default}`", "; ".join(failed), settings_of(json.loads(file.read_text())), f"`{stable}`",
                     f"{ratios[2]:.1f} ({ratios[0]:.1f} to {ratios[4]:.1f})"])
    return marked_page.lines_of(["World", "Fails with 1 substep of 10 iterations", "Holds with", "Scene", "Time of a step"],
                                rows)


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("tool", metavar="BOXSTREAM", help="the tool, in a directory that has the scenes beside it")
    options = parser.parse_args()
    marked_page.require_marks(options.into, "hard scenes", "hard settings")
    runs = runs_of_all(options.tool)
    text, bad = table(runs)
    marked_page.put_out(text, options.into, "hard scenes")
    marked_page.put_out(prices(options.tool, runs), options.into, "hard settings")
    return int(bad)


if __name__ == "__main__":
    sys.exit(main())
