#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Judges the warnings of `boxstream explain` by random scenes (untuned/generate.py).

Each scene is run at its default settings against a reference of fine steps. It breaks where a general metric says so
(energy out of nothing, a joint apart, a body lost or sunk in, something fallen that stands in the reference, bodies
elsewhere by a third of their way). It is right where bodies are on the mean of the run off by less than a two-hundredth
of their way, so by less than a hundredth at its end, which is what warnings of coarse steps promise. In between a
warning is neither expected nor false; nor is one of bodies that start in each other, which no setting makes right. Then `explain --try` is asked for a setting, which is run against a reference of its
own.

    python3 tests/lab/scenes/warnings_judged.py build/release/bin/boxstream --seed 1 --count 200 --into bench/results/hard-worlds.md
"""
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[2] / "support"), str(pathlib.Path(__file__).resolve().parent / "untuned")]
import generate  # noqa: E402
import marked_page  # noqa: E402

MARK = "warnings judged"
RIGHT = 0.005  # of the way


def ask(*command):
    run = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    return json.loads(run.stdout) if run.returncode == 0 else None


def warned(tool, file):
    told = ask(tool, "explain", file, "--json", "-")
    return [kind for kind in ("overlaps_at_start", "warnings", "hard_cases", "coarse_steps") if told[kind]]


def state(tool, file, budget):
    """How a scene's own settings do: "right", "between" or "broken", and why."""
    run = ask(tool, "accuracy", file, "--knob", "dt=1/60", "--repeats", 1, "--budget", budget, "--json", "-")
    if run is None:
        return "broken", "it could not be run"
    row = run["settings"][0]
    why = row.get("failure") or row.get("unsound")
    if why:
        return "broken", why
    off = row["vitals"]["elsewhere"]
    return ("right" if off < RIGHT else "between"), f"off by {100 * off:.2g} % of its way"


def with_setting(document, label):
    """The scene with what `explain --try` names, as "solver=dantzig iterations=10 substeps=4"."""
    made = json.loads(json.dumps(document))
    for word in label.split():
        name, value = word.split("=")
        value = value if name in ("solver", "bounces") else int(value)
        block, key = ("time", name) if name == "substeps" else ("solver", "kind" if name == "solver" else name)
        made.setdefault(block, {})[key] = value
    return made


def judged(job):
    tool, seed, number, budget, asks = job
    document = generate.scene(seed, number)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scene.json"
        file.write_text(json.dumps(document))
        kinds, (how, why) = warned(tool, file), state(tool, file, budget)
        if how == "right" and "overlaps_at_start" in kinds:
            how = "between"
        advised = held = None
        if how == "broken" and asks:
            tried = (ask(tool, "explain", file, "--try", "--budget", budget, "--json", "-") or {}).get("tried")
            advised = tried and tried["advice"]
            if advised:
                file.write_text(json.dumps(with_setting(document, advised)))
                # The scene's checks of soundness against a reference of its own.
                held = state(tool, file, budget)[0] != "broken"
    print(document["meta"]["name"], how, why, kinds, advised, held, sep="; ", file=sys.stderr, flush=True)
    return {"name": document["meta"]["name"], "how": how, "why": why, "kinds": kinds, "advised": advised, "held": held}


def table(rows):
    count = lambda how, told: sum(row["how"] == how and bool(row["kinds"]) == told for row in rows)  # noqa: E731
    lines = marked_page.lines_of(["Of so many scenes", "warned of", "not warned of"],
                                 [[f"{count(how, True) + count(how, False)} {word}", str(count(how, True)), str(count(how, False))]
                                  for how, word in (("broken", "that break"), ("between", "in between"), ("right", "that are right"))])
    advised = [row for row in rows if row["advised"]]
    held = sum(bool(row["held"]) for row in advised)
    lines += f"\nOf {sum(row['how'] == 'broken' for row in rows)} that break `explain --try` names a setting for {len(advised)}; {held} of these hold.\n"
    return lines


def shares(rows):
    """Of those that break the share without a warning; of those that are right the share with one; of advice what holds."""
    share = lambda hits, of: hits / of if of else math.nan  # noqa: E731
    broken, right = ([row for row in rows if row["how"] == how] for how in ("broken", "right"))
    advised = [row for row in rows if row["advised"]]
    return (share(sum(not row["kinds"] for row in broken), len(broken)), share(sum(bool(row["kinds"]) for row in right), len(right)),
            share(sum(bool(row["held"]) for row in advised), len(advised)))


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("tool", metavar="BOXSTREAM")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--budget", type=float, default=10, help="seconds for a scene's runs")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--no-advice", action="store_true", help="leave out what explain --try says")
    parser.add_argument("--check", nargs=3, type=float, metavar=("MISSES", "FALSE", "HELD"),
                        help="fail where a larger share is missed or false, or a smaller one of the advice holds; write nothing")
    options = parser.parse_args()
    marked_page.require_marks(options.into, MARK)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(judged, [(options.tool, options.seed, number, options.budget, not options.no_advice) for number in range(options.count)]))
    misses, false, held = shares(rows)
    print(f"missed {100 * misses:.1f} %, false {100 * false:.1f} %, advice that holds {100 * held:.1f} %")
    if options.check:
        most_missed, most_false, least_held = options.check
        # A share of none is nan, which is within nothing.
        within = misses <= most_missed and false <= most_false and (options.no_advice or held >= least_held)
        return 0 if within else 1
    marked_page.put_out(table(rows), options.into, MARK)
    return 0


if __name__ == "__main__":
    sys.exit(main())
