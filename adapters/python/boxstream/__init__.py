# SPDX-License-Identifier: MIT
"""All touching pairs of axis-aligned boxes, as NumPy arrays.

    import boxstream
    pairs = boxstream.find_pairs(boxes)     # boxes: (n, 6), minima before maxima; pairs: (k, 2), indices of boxes

find_pairs, stream_pairs: boxes that overlap or touch, within one set or between two.
find_neighbours: the same, as neighbours of each box.
find_pairs_in_sets: the same of many sets at once, such as those of many small worlds.
find_near_pairs, stream_near_pairs: points or balls within a distance of each other.
Detector: the same, with memory that is kept. World: boxes that move. BoxIndex: boxes that stay. Executor: threads.
simulate: scenes on Bullet, where that was built.
"""
from ._core import BoxIndex, Detector, Executor, Stats, World, WorldStats, __version__
from ._functions import (
    find_near_pairs,
    find_neighbours,
    find_pairs,
    find_pairs_in_sets,
    simd_target,
    stream_near_pairs,
    stream_pairs,
)
from ._layout import InvalidBoxesWarning
from ._simulate import Simulated, simulate

__all__ = [
    "BoxIndex",
    "Detector",
    "Executor",
    "InvalidBoxesWarning",
    "Simulated",
    "Stats",
    "World",
    "WorldStats",
    "find_near_pairs",
    "find_neighbours",
    "find_pairs",
    "find_pairs_in_sets",
    "simd_target",
    "simulate",
    "stream_near_pairs",
    "stream_pairs",
]

for _name in __all__:
    globals()[_name].__module__ = __name__
del _name
