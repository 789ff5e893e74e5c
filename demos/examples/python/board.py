# SPDX-License-Identifier: MIT
"""A circuit board: copper of different nets that is closer than the clearance, in whole nanometres."""
import numpy as np

import boxstream

CLEARANCE = 150_000
BETWEEN_LAYERS = 1_000_000  # more than the clearance, so that layers do not meet


def make(count, seed=1):
    """Tracks (layer, min x, min y, max x, max y) of int64, and the net of each."""
    random = np.random.default_rng(seed)
    start = random.integers(0, int(np.sqrt(count) * 1000), (count, 2)) * 1000
    across = random.random(count) < 0.5
    length, width = random.integers(500, 8000, count) * 1000, random.integers(100, 400, count) * 1000
    size = np.where(across[:, None], np.column_stack([length, width]), np.column_stack([width, length]))
    tracks = np.hstack([random.integers(0, 4, (count, 1)), start, start + size])
    return tracks, random.integers(0, max(count // 6, 1), count)


def find(tracks, nets):
    """Pairs of tracks of different nets on one layer with a gap below the clearance."""
    height = tracks[:, :1] * BETWEEN_LAYERS
    boxes = np.hstack([tracks[:, 1:3], height, tracks[:, 3:5], height])
    near = boxstream.find_pairs(boxes, ids=nets, tolerance=CLEARANCE)
    a, b = tracks[near[:, 0], 1:], tracks[near[:, 1], 1:]
    gap = np.maximum(0, np.maximum(a[:, :2] - b[:, 2:], b[:, :2] - a[:, 2:]))
    return near[(gap**2).sum(axis=1) < CLEARANCE**2]


if __name__ == "__main__":
    tracks, nets = make(20_000)
    pairs = find(tracks, nets)
    print(len(tracks), "tracks of", len(np.unique(nets)), "nets:", len(pairs), "pairs are too close")
