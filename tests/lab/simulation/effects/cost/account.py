#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the account of energy takes of a step, in instructions, for docs/effects.md.

  account.py SCENE_STEPS [--into PAGE] [--most SHARE] SCENE...

A SCENE is a file. Steps with the account, against the same steps without it, counted by valgrind; from the first to the
20th step, in most of which nothing touches yet, and from there to the 80th. --most: fails if one takes more.
"""
import argparse
import pathlib
import re
import subprocess

ENDS = 1, 20, 80
BEGIN, END = "<!-- account: begin -->\n", "<!-- account: end -->\n"


def instructions(program, mode, scene, steps):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, mode, scene, str(steps)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def shares(program, scene):
    """Of both spans: instructions of a step without the account, and what it adds, as a share of them."""
    without, account = ([instructions(program, mode, scene, n) for n in ENDS] for mode in ("told", "account"))
    for k in range(2):
        plain = without[k + 1] - without[k]
        yield plain / (ENDS[k + 1] - ENDS[k]), (account[k + 1] - account[k]) / plain - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--into", type=pathlib.Path)
    parser.add_argument("--most", type=float, default=1)
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    table = ("| Scene | instructions of a step, to the 20th | account | of a step, to the 80th | account |\n"
             "| --- | ---: | ---: | ---: | ---: |\n")
    most = 0
    for scene in options.scenes:
        row = list(shares(options.program, scene))
        most = max([most, *(share for _, share in row)])
        cells = " | ".join(f"{plain:,.0f} | {share:.2%}" for plain, share in row).replace(",", " ")
        table += f"| {pathlib.Path(scene).stem} | {cells} |\n"
    print(table, end="")
    if options.into:
        text = options.into.read_text()
        begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
        options.into.write_text(text[:begin] + table + text[end:])
    assert most <= options.most, f"the account takes {most:.2%} of a step"


main()
