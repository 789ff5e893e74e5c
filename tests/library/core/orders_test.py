#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Instructions of a search of the same boxes in orders that are known to spoil sorting, against a random order.

  orders_test.py PROGRAM

Counted by valgrind, so that the clock of the machine and what else it does are no matter.
"""
import re
import subprocess
import sys

LIMIT = 1.5
SETS = {"clusters": 6000, "two_far_groups": 6000}
ORDERS = ["sorted", "reversed", "organ_pipe", "two_runs", "against_median_of_three"]


def cost(program, boxes, size, order):
    """Instructions of the search, and the pairs that it finds."""
    valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                "--toggle-collect=boxstream::Detector::stream_pairs*"]
    done = subprocess.run([*valgrind, program, boxes, str(size), order], capture_output=True, text=True, check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1]), done.stdout.strip()


def main():
    program = sys.argv[1]
    for boxes, size in SETS.items():
        shuffled, pairs = cost(program, boxes, size, "shuffled")
        assert shuffled > 100 * size, "the search was not counted"
        for order in ORDERS:
            instructions, found = cost(program, boxes, size, order)
            print(f"{boxes}, {order}: {instructions} instructions, {instructions / shuffled:.2f} of those when shuffled")
            assert found == pairs, f"{found} instead of {pairs}"
            assert instructions <= LIMIT * shuffled, f"more than {LIMIT} times as many as in a random order"


main()
