# SPDX-License-Identifier: MIT
"""Reads of a sequencer on genes: half-open intervals, as in bed files, on several chromosomes."""
import numpy as np

import boxstream

CHROMOSOMES = 5


def make(count, seed=1):
    """Genes and reads (chromosome, start, end), each sorted by chromosome."""
    random = np.random.default_rng(seed)

    def intervals(number, shortest, longest):
        start, length = random.integers(0, 40 * count, number), random.integers(shortest, longest, number)
        rows = np.column_stack([random.integers(0, CHROMOSOMES, number), start, start + length])
        return rows[np.argsort(rows[:, 0], kind="stable")]

    return intervals(max(count // 20, 1), 200, 3000), intervals(count, 50, 151)


def find(genes, reads):
    """Pairs of a gene and a read that share a base: ends that only touch do not."""
    chromosomes = np.arange(CHROMOSOMES + 1)
    pairs, _ = boxstream.find_pairs_in_sets(
        genes[:, 1:], np.searchsorted(genes[:, 0], chromosomes),
        reads[:, 1:], np.searchsorted(reads[:, 0], chromosomes), dimensions=1, closed=False)
    return pairs


if __name__ == "__main__":
    genes, reads = make(20_000)
    reads_of = np.bincount(find(genes, reads)[:, 0], minlength=len(genes))
    are_read = np.count_nonzero(reads_of)
    print(len(reads), "reads,", len(genes), "genes:", are_read, "are read, at most", reads_of.max(), "times")
