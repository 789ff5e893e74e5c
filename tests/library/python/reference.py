# SPDX-License-Identifier: MIT
"""What searches have to find, from the definitions alone, and inputs to find it in."""
from fractions import Fraction

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

DTYPES = [np.float32, np.float64]


def halves(boxes):
    """Minima and maxima, each of shape (n, 3)."""
    both = np.asarray(boxes).reshape(len(boxes), 2, 3)
    return both[:, 0], both[:, 1]


def valid(boxes):
    minima, maxima = halves(boxes)
    return (minima <= maxima).all(axis=1)


def touching(a, b):
    """Matrix of bool: box i of a and box j of b are valid and share a point."""
    (a_min, a_max), (b_min, b_max) = halves(a), halves(b)
    meet = (a_min[:, None] <= b_max[None]) & (b_min[None] <= a_max[:, None])
    return meet.all(axis=2) & valid(a)[:, None] & valid(b)[None]


def accepted(a_groups, a_masks, b_groups, b_masks):
    return ((a_groups[:, None] & b_masks[None]) != 0) & ((b_groups[None] & a_masks[:, None]) != 0)


def pairs_of(matrix):
    return {(int(i), int(j)) for i, j in np.argwhere(matrix)}


def self_pairs(boxes):
    return pairs_of(np.triu(touching(boxes, boxes), 1))


def as_set(pairs):
    """The pairs of an array; none is in it twice."""
    listed = [(int(a), int(b)) for a, b in pairs]
    result = set(listed)
    assert len(result) == len(listed)
    return result


def is_near(a, b, distance):
    """By rational numbers. Balls are (x, y, z, radius)."""
    numbers = [float(x) for x in (*a, *b)]
    if not np.isfinite(numbers).all() or numbers[3] < 0 or numbers[7] < 0:
        return False
    p, q = [Fraction(x) for x in numbers[:4]], [Fraction(x) for x in numbers[4:]]
    reach = p[3] + q[3] + Fraction(float(distance))
    return sum((x - y) ** 2 for x, y in zip(p[:3], q[:3])) <= reach**2


def random_boxes(count, dtype, seed=1, size=0.1):
    generator = np.random.default_rng(seed)
    minima = generator.random((count, 3))
    return np.hstack([minima, minima + size * generator.random((count, 3))]).astype(dtype)


@st.composite
def box_arrays(draw, dtype=None, most=40):
    """Boxes on a coarse grid, so that many touch, with infinite, inverted and NaN bounds among them."""
    dtype = dtype or draw(st.sampled_from(DTYPES))
    count = draw(st.integers(0, most))
    bound = st.one_of(st.integers(-4, 4).map(float), st.sampled_from([np.nan, np.inf, -np.inf, 0.5, 2.0**100]))
    boxes = draw(arrays(dtype, (count, 6), elements=bound, fill=st.nothing()))
    # Half of them are put in order, or few would be valid.
    if draw(st.booleans()):
        low, high = np.minimum(boxes[:, :3], boxes[:, 3:]), np.maximum(boxes[:, :3], boxes[:, 3:])
        boxes = np.hstack([low, high])
    return boxes


def bit_arrays(count):
    return arrays(np.uint32, count, elements=st.sampled_from([0, 1, 2, 3, 0x80000000, 0xFFFFFFFF]))
