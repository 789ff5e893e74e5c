#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What worlds in double precision cost: scenes are run in both precisions in turns, and the medians of a step's processor
time compared. Writes the table of docs/effects.md."""
import json
import pathlib
import statistics
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402

MARK = "double prices"
SCENES = {"pile": 60, "wall": 100, "hard/chain_40": 300, "ragdolls": 60, "cloth": 60, "terrain": 60}
ROUNDS = 7


def medians(tool, scene, steps, precision):
    ran = subprocess.run([tool, "simulate", scene, "--steps", str(steps), "--precision", precision, "--json", "-"],
                         capture_output=True, text=True)
    summary = json.loads(ran.stdout)["worlds"][0]["summary"]
    return {part: summary[part]["median_ms"] for part in ("broadphase", "dispatch", "step")}


def row_of(tool, scene, steps):
    taken = {"single": [], "double": []}
    for i in range(ROUNDS):
        for precision in (("single", "double"), ("double", "single"))[i % 2]:
            taken[precision].append(medians(tool, scene, steps, precision))

    def middle(precision, part):
        return statistics.median(of[part] for of in taken[precision])

    def ratio(part):
        return f"{middle('double', part) / middle('single', part):.2f}" if middle("single", part) > 0.005 else "-"
    return [f"`{scene}`", str(steps), f"{middle('single', 'step'):.3g} ms", f"{middle('double', 'step'):.3g} ms",
            ratio("step"), ratio("broadphase"), ratio("dispatch")]


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("tool", metavar="BOXSTREAM")
    options = parser.parse_args()
    marked_page.require_marks(options.into, MARK)
    head = ["Scene", "Steps", "Single: a step", "Double", "Ratio", "of the broad-phase", "of dispatch"]
    marked_page.put_out(marked_page.lines_of(head, [row_of(options.tool, *each) for each in SCENES.items()]), options.into, MARK)


if __name__ == "__main__":
    sys.exit(main())
