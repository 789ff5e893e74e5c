#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Adds up tests/fuzz/runs.tsv, in which `./dev fuzz --record` notes each run, as a table.

The corpus is counted as it is committed.
"""
import collections
import pathlib
import sys
import tarfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import marked_page  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests" / "fuzz" / "corpus"
RUNS = ROOT / "tests" / "fuzz" / "runs.tsv"


def rows():
    sums = collections.defaultdict(lambda: [0, 0, 0])
    for line in RUNS.read_text().splitlines():
        _date, target, seconds, executions, status = line.split("\t")
        entry = sums[target]
        entry[0] += int(seconds)
        entry[1] += int(executions or 0)
        entry[2] += status != "0"
    for target in sorted(sums):
        seconds, executions, crashed = sums[target]
        with tarfile.open(CORPUS / f"{target.removesuffix('_small')}.tar") as corpus:
            files = corpus.getmembers()
        size = sum(file.size for file in files)
        yield [f"`{target}`", f"{seconds / 60:.1f}", f"{executions:,}", str(crashed), str(len(files)),
               f"{size / 1024:.0f}"]


def table():
    head = ["Target", "Minutes of a processor", "Inputs tried", "Runs that ended in a crash", "Corpus entries", "KiB"]
    return marked_page.lines_of(head, rows())


def main():
    parser = marked_page.parser(__doc__)
    options = parser.parse_args()
    marked_page.require_marks(options.into, "fuzz")
    marked_page.put_out(table(), options.into, "fuzz")


if __name__ == "__main__":
    main()
