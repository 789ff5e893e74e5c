#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Instructions of a step of a scene, against a program written by hand for that scene alone.

  instructions_test.py SCENE_STEPS MINIMAL SCENE

Counted by valgrind, so that the clock of the machine and what else it does are no matter. Two runs that differ in
length alone: what building the world takes is in neither difference.
"""
import re
import subprocess
import sys

SHORT, LONG = 20, 40
LIMIT = 1.01


def run(command, steps):
    """Instructions of a run, and the hash of the state that it ends in."""
    valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    done = subprocess.run([*valgrind, *command, str(steps)], capture_output=True, text=True, check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1]), done.stdout.strip()


def cost(command):
    short, _ = run(command, SHORT)
    long, state = run(command, LONG)
    return (long - short) / (LONG - SHORT), state


def main():
    program, minimal, scene = sys.argv[1:]
    by_hand, expected = cost([minimal])
    called, state = cost([program, "called", scene])
    everything, _ = cost([program, "all", scene])
    print(f"instructions of a step: by hand {by_hand:.0f}, only what is called for {called:.0f} "
          f"({called / by_hand:.4f} of it), everything {everything:.0f} ({everything / by_hand:.4f})")
    assert state == expected, f"the two programs do not do the same: {state}, {expected}"
    assert called <= LIMIT * by_hand, f"more than {LIMIT} times as many as by hand"
    assert called < everything, "what is not called for costs nothing, even if it is built"


main()
