#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes tests/lab/simulation/worlds/golden.txt anew: what worlds do, step for step, as hashes.

usage: golden.py BUILD [--print]

BUILD is the build directory, with the targets boxstream_golden_scenes, bullet_golden_worlds and
bullet_float64_golden_worlds. --print writes to standard output instead. Do it when a change of the hashes is meant,
and say in the commit why.
"""
import pathlib
import subprocess
import sys

GOLDEN = pathlib.Path(__file__).resolve().parent / "golden.txt"
PROGRAMS = ["boxstream_golden_scenes", "bullet_golden_worlds", "bullet_float64_golden_worlds"]
HEAD = """\
# Scene or world, precision of Bullet, steps, hash of the list of pairs and of the state after each step.
# Valid for x86-64, glibc and Debian 12's Bullet 3.24, with any compiler, optimisation, SIMD target and number of threads.
# Written by tests/lab/simulation/worlds/golden.py
"""


def main(arguments):
    if "--help" in arguments or len(arguments) not in (1, 2) or arguments[1:] not in ([], ["--print"]):
        print(__doc__.strip())
        return 0 if "--help" in arguments else 2
    text = HEAD
    for program in PROGRAMS:
        path = pathlib.Path(arguments[0]) / "tests" / "simulation" / "worlds" / program
        if not path.is_file():
            print(f"{path}: no such program; build the target {program}", file=sys.stderr)
            return 2
        print(program, file=sys.stderr)
        text += subprocess.run([path], check=True, capture_output=True, text=True).stdout
    if arguments[1:]:
        print(text, end="")
    else:
        GOLDEN.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
