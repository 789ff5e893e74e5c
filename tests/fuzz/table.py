#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Adds up what `./dev fuzz` has written to out/fuzz/runs.tsv, as a table.

usage: table.py [RUNS.tsv] [--into PAGE.md]

--into replaces what is between the two marks in a page. The corpus is counted as it is committed.
"""
import collections
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests" / "fuzz" / "corpus"
BEGIN, END = "<!-- fuzz: begin -->\n", "<!-- fuzz: end -->\n"


def rows(runs):
    sums = collections.defaultdict(lambda: [0, 0, 0])
    for line in runs.read_text().splitlines():
        target, seconds, executions, _new, status = line.split("\t")
        entry = sums[target]
        entry[0] += int(seconds)
        entry[1] += int(executions or 0)
        entry[2] += status != "0"
    for target in sorted(sums):
        seconds, executions, crashed = sums[target]
        files = [file for file in (CORPUS / target).glob("*") if file.is_file()]
        size = sum(file.stat().st_size for file in files)
        yield [f"`{target}`", f"{seconds / 60:.1f}", f"{executions:,}", str(crashed), str(len(files)),
               f"{size / 1024:.0f}"]


def table(runs):
    head = ["Target", "Minutes", "Inputs tried", "Runs that ended in a crash", "Corpus entries", "KiB"]
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *rows(runs))) + "\n"


def main(arguments):
    if "--help" in arguments:
        print(__doc__.strip())
        return 0
    page = None
    if "--into" in arguments:
        at = arguments.index("--into")
        page = pathlib.Path(arguments[at + 1]) if at + 1 < len(arguments) else pathlib.Path()
        if not page.is_file() or BEGIN not in page.read_text() or END not in page.read_text():
            print(f"{page}: no such page, or it has no marks", file=sys.stderr)
            return 2
        del arguments[at:at + 2]
    runs = pathlib.Path(arguments[0]) if arguments else ROOT / "out" / "fuzz" / "runs.tsv"
    if not runs.is_file():
        print(f"{runs}: no such file; ./dev fuzz writes it", file=sys.stderr)
        return 2
    text = table(runs)
    if page:
        whole = page.read_text()
        page.write_text(whole[:whole.index(BEGIN) + len(BEGIN)] + text + whole[whole.index(END):])
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
