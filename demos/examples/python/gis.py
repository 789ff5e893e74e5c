# SPDX-License-Identifier: MIT
"""A map: which buildings stand within a circle of protected ground, decided by boxes, then exactly."""
import numpy as np

import boxstream


def make(count, seed=1):
    """Buildings (min x, min y, max x, max y) along streets, in metres, and circles (x, y, radius)."""
    random = np.random.default_rng(seed)
    side = np.sqrt(count) * 20
    corner = np.floor(random.random((count, 2)) * side / 10) * 10
    buildings = np.hstack([corner, corner + random.uniform(6, 25, (count, 2))])
    wells = max(count // 50, 1)
    return buildings, np.column_stack([random.random((wells, 2)) * side, random.uniform(10, 60, wells)])


def find(buildings, circles):
    """Pairs of a building and a circle that share ground."""
    centre, radius = circles[:, :2], circles[:, 2:]
    near = boxstream.find_pairs(buildings, np.hstack([centre - radius, centre + radius]), dimensions=2)
    box, (x, y, r) = buildings[near[:, 0]], circles[near[:, 1]].T
    across = np.maximum(0, np.maximum(box[:, 0] - x, x - box[:, 2]))
    along = np.maximum(0, np.maximum(box[:, 1] - y, y - box[:, 3]))
    return near[np.hypot(across, along) <= r]


if __name__ == "__main__":
    buildings, circles = make(20_000)
    pairs = find(buildings, circles)
    print(len(buildings), "buildings,", len(circles), "circles:", len(np.unique(pairs[:, 0])), "are protected")
