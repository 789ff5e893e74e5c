#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether settings that `boxstream accuracy --advise` stars and advises are sound: each is put into its scene's file and
run by `boxstream simulate`, which knows nothing of the advice. There no check of the scene may fail, no step gain energy
that no work explains, and nothing be said to be unsound.

With --few only those that take seconds.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parents[3] / "demos" / "scenes"
FEW = ["hard/bounce_elastic", "hard/bullet_thin_wall", "effects/bounces_on_contact", "effects/ccd"]
ALL = [*FEW, "hard/ball_and_chain", "hard/bounce_energy", "hard/bounce_inelastic", "hard/bounce_slow", "hard/chain_40",
       "hard/mass_ratio_100", "hard/mass_ratio_1000", "hard/mass_ratio_400", "hard/spinning_racket", "hard/stack_30",
       "hard/stack_of_plates", "hard/tiny_boxes", "hard/weight_removed", "hard/thin_boxes_on_mesh", "effects/joints",
       "effects/motors", "effects/multibodies", "effects/gyroscopic", "effects/rolling_friction", "effects/vehicles"]
PLACES = {"solver": ("solver", "kind"), "bounces": ("solver", "bounces"), "iterations": ("solver", "iterations"),
          "substeps": ("time", "substeps"), "step": ("time", "dt"), "precision": ("solver", "precision")}
WITH_MARGIN = {"box", "cylinder", "cone", "hull"}


def output_of(tool, *words):
    run = subprocess.run([tool, *words], capture_output=True, text=True)
    return run.returncode, json.loads(run.stdout) if run.stdout.strip() else None, run.stderr


def troubles(tool, scene, setting, steps, folder):
    """What simulate says is wrong with a setting."""
    document = json.loads((SCENES / f"{scene}.json").read_text())
    knobs = dict(setting["knobs"])
    if (margin := knobs.pop("margin", None)) is not None:
        for shape in document["shapes"]:
            if shape["type"] in WITH_MARGIN:
                shape["margin"] = margin
    for knob, value in knobs.items():
        block, key = PLACES[knob]
        document.setdefault(block, {})[key] = value
    for key in ("outputs", "expect"):
        document.pop(key, None)
    # Beside its own, for the files that it names.
    file = pathlib.Path(folder) / "scene.json"
    file.write_text(json.dumps(document))
    code, run, said = output_of(tool, "simulate", str(file), "--json", "-", *(["--steps", str(steps)] if steps else []))
    if run is None:
        return [f"exit code {code}: {said.strip().splitlines()[-1]}"]
    world = run["worlds"][0]
    found = [f"{check['check']}: {check['value']}" for check in world["checks"] if check["asked"] and not check["passed"]]
    if "worst_gain" in world["energy"]:
        found.append(f"gains {world['energy']['worst_gain']['j']:.3g} J in step {world['energy']['worst_gain']['step']}")
    return found + [line for line in said.splitlines() if "unsound" in line]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool", metavar="BOXSTREAM")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: some of every kind")
    parser.add_argument("--few", action="store_true", help="those that take seconds")
    parser.add_argument("--budget", default="60", help="seconds for each")
    options = parser.parse_args()
    wrong = advised = without = 0
    for scene in options.scenes or (FEW if options.few else ALL):
        code, answer, said = output_of(options.tool, "accuracy", scene, "--advise", "--budget", options.budget, "--json", "-")
        if answer is None:
            print(f"{scene}: exit code {code}: {said.strip()}")
            wrong += 1
            continue
        best = answer["advice"]
        shortened = answer["seconds"] < answer["seconds_of_scene"]
        chosen = [row for row in answer["settings"] if row["front"] or label(row) == best]
        without += best is None
        lines = []
        with tempfile.TemporaryDirectory() as folder:
            for row in chosen:
                advised += 1
                lines += [f"  {label(row)}: {trouble}" for trouble in troubles(options.tool, scene, row, steps_of(row, shortened), folder)]
        wrong += len({line.split(":")[0] for line in lines})
        print(f"{scene}: {best or 'nothing is sound'} ({len(chosen)} starred or advised, {len(answer['settings'])} tried)")
        print("\n".join(lines), end="\n" if lines else "", flush=True)
    print(f"{advised} settings starred or advised, {wrong} of them wrong; {without} scenes without advice")
    return 1 if wrong or not advised else 0


def steps_of(row, shortened):
    """How many steps repeat a run; 0 where the scene says so."""
    return row["steps"] if shortened or "step" in row["knobs"] else 0


def label(row):
    return " ".join(f"{knob}={value}" for knob, value in row["knobs"].items())


if __name__ == "__main__":
    sys.exit(main())
