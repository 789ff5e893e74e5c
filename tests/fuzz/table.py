#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Adds up what `./dev fuzz` has written to out/fuzz/runs.tsv, as a table.

The corpus is counted as it is committed.
"""
import collections
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import marked_page  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests" / "fuzz" / "corpus"


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
    return marked_page.lines_of(head, rows(runs))


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("runs", nargs="?", type=pathlib.Path, default=ROOT / "out" / "fuzz" / "runs.tsv",
                        metavar="RUNS.tsv")
    options = parser.parse_args()
    marked_page.require_marks(options.into, "fuzz")
    if not options.runs.is_file():
        print(f"{options.runs}: no such file; ./dev fuzz writes it", file=sys.stderr)
        return 2
    marked_page.put_out(table(options.runs), options.into, "fuzz")
    return 0


if __name__ == "__main__":
    sys.exit(main())
