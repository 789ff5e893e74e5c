# SPDX-License-Identifier: MIT
"""Grains of different sizes that push each other apart: contacts of each step, and the forces of their overlaps."""
import numpy as np

import boxstream


def make(count, seed=1):
    """Centres (n, 3) and radii (n,)."""
    random = np.random.default_rng(seed)
    return random.random((count, 3)) * count ** (1 / 3) * 0.9, random.uniform(0.2, 0.6, count)


def contacts(centres, radii, detector=boxstream.Detector()):
    """Pairs of grains that touch."""
    return detector.find_near_pairs(centres, 0, radii=radii)


def step(centres, radii, pairs):
    """Moves both grains of each pair apart by a quarter of their overlap; returns the sum of all overlaps."""
    i, j = pairs.T
    between = centres[j] - centres[i]
    distance = np.linalg.norm(between, axis=1)
    overlap = radii[i] + radii[j] - distance
    push = between * (overlap / 4 / distance)[:, None]
    np.subtract.at(centres, i, push)
    np.add.at(centres, j, push)
    return overlap.sum()


if __name__ == "__main__":
    centres, radii = make(2_000)
    for number in range(30):
        pairs = contacts(centres, radii)
        overlaps = step(centres, radii, pairs)
        if number % 10 == 0 or number == 29:
            print(f"step {number}: {len(pairs)} contacts, overlaps of {overlaps:.0f} in all")
