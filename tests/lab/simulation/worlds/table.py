#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the hard worlds that no scene can say on every broad-phase, and prints what became of their criteria, as a table.

With BOXSTREAM_WHOLE_RUNS=1 in the environment the large ones run in full length, which takes an hour; else as the test suite
runs them. Names say how much was run.

Exit code 1 if one of the tests fails.
"""
import pathlib
import subprocess
import sys

TESTS = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(TESTS / "support"), str(TESTS / "lab" / "scenes")]
import marked_page  # noqa: E402
from hard_table import BROADPHASES, outcome  # noqa: E402

PROGRAMS = ["bullet_worlds_tests", "bullet_float64_worlds_tests"]
EVERYWHERE = ("pairs missed == 0", "finite == 1", "pairs left in the empty world == 0",
              "contact algorithms left in the empty world == 0")


def results(build):
    """(world, criterion, precision) -> broad-phase -> value and whether it passed."""
    found, failed = {}, False
    for program in PROGRAMS:
        command = [pathlib.Path(build) / "tests" / "simulation" / "worlds" / program, "--gtest_filter=-Golden*:Neutral*:Order*"]
        run = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        for line in run.stdout:
            if line.startswith("RESULT\t"):
                world, criterion, precision, broadphase, value, passed = line.rstrip("\n").split("\t")[1:]
                found.setdefault((world, criterion, precision), {})[broadphase] = {
                    "value": value, "passed": passed == "passed"}
            else:
                print(line, end="", file=sys.stderr)
        failed |= run.wait() != 0
    return found, failed


def table(build):
    found, failed = results(build)
    rows = []
    for (world, criterion, precision), runs in found.items():
        runs = {b: runs[b] for b in BROADPHASES if b in runs}
        told = outcome(runs)
        if criterion in EVERYWHERE and told == "passed":
            continue
        cells = [runs[b]["value"] if b in runs else "-" for b in BROADPHASES]
        rows.append([world, criterion, precision, *cells, told])
    order = [row[:2] for row in rows]
    rows.sort(key=lambda row: order.index(row[:2]))  # both precisions side by side
    everywhere = [row for row in rows if row[1] in EVERYWHERE]
    text = (f"{len({key[0] for key in found})} worlds, {len(found)} criteria. No pair missed, every number finite, and no "
            f"pair or contact left in a world emptied: {'but see below' if everywhere else 'so in all runs'}.\n\n")
    return text + marked_page.lines_of(["World", "Criterion", "Bullet", *BROADPHASES, "Outcome"], rows), failed


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("build", help="build directory, with bullet_worlds_tests and bullet_float64_worlds_tests")
    options = parser.parse_args()
    marked_page.require_marks(options.into, "hard worlds")
    text, failed = table(options.build)
    marked_page.put_out(text, options.into, "hard worlds")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
