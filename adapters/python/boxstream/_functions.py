# SPDX-License-Identifier: MIT
"""The functions of the package, in Python so that they can be pickled. Each search makes a Detector and drops it."""
from . import _core
from ._core import Detector


def find_pairs(boxes, other=None, groups=None, masks=None, *, ids=None, ids_a=None, ids_b=None, closed=True,
               tolerance=0.0, dimensions=3, dtype="int64", max_pairs=None, copy=None, invalid="warn", executor=None):
    """Every pair of boxes that overlap or touch, each exactly once.

    boxes: array of floats or integers, shape (n, 6) or (n, 2, 3): the minima of a box, then its maxima. Of float32,
        float64, int32 or int64 in C order it is read where it lies, and should not change during the call: pairs of
        what changes are wrong then. Lists, DataFrames and other arrays are copied, if that changes no number.
    other: as boxes, or None. If given, pairs of one of boxes and one of other are found.
    groups, masks: integers from 0 to 2**32 - 1, shape (n,), or None. Two boxes may pair if each one's group has a bit
        in common with the other's mask. Defaults: group 1, mask 0xffffffff. With other, a tuple of two arrays or None.
    ids: integers from 0 to 2**32 - 1, shape (n,), or None: boxes with equal ids do not pair. With other: ids_a of
        boxes and ids_b of other.
    closed: False: boxes that share no more than a face, an edge or a corner do not pair.
    tolerance: float, not below 0: boxes pair, too, that are so far apart on each axis; nothing is rounded.
    dimensions: 3, 2 or 1. With 2 boxes have the shape (n, 4) or (n, 2, 2), with 1 (n, 2) or (n, 2, 1).
    dtype: 'int64', 'int32' or 'uint32', of the result. Those of 32 bits take half the memory, and no copy.
    max_pairs: int or None: MemoryError if there are more pairs.
    copy: None or True: boxes are copied where they cannot be read where they lie. False: that is an error.
    invalid: 'warn': boxes with a NaN or with min > max pair with nothing, and more than a tenth of them are an
        InvalidBoxesWarning. 'skip': without it. 'raise': they are a ValueError.
    executor: Executor, or None for the calling thread.

    Returns an array of shape (k, 2): indices of boxes, a < b; with other, indices of boxes and of other. The order
    depends on the boxes alone, not on threads.
    Raises TypeError for a wrong type of object or number, ValueError for a wrong shape, size or number, MemoryError.
    Other Python threads run meanwhile. Ctrl-C leaves the search within a fifth of a second.
    """
    return Detector(executor).find_pairs(
        boxes, other, groups, masks, ids=ids, ids_a=ids_a, ids_b=ids_b, closed=closed, tolerance=tolerance,
        dimensions=dimensions, dtype=dtype, max_pairs=max_pairs, copy=copy, invalid=invalid)


def find_neighbours(boxes, other=None, groups=None, masks=None, *, both=True, ids=None, ids_a=None, ids_b=None,
                    closed=True, tolerance=0.0, dimensions=3, dtype="int64", copy=None, invalid="warn", executor=None):
    """The pairs of find_pairs as neighbours of each box, sorted: the rows of a sparse matrix.

    both: True: of two boxes that pair each is a neighbour of the other. False: only the one with the larger index of
        the other. With other, neighbours are those of each of boxes in other.
    Other parameters and errors: as find_pairs.

    Returns offsets, int64, shape (n + 1,), and indices of dtype, shape (k,): the neighbours of box i are
    indices[offsets[i]:offsets[i + 1]], ascending. scipy.sparse.csr_array((values, indices, offsets), shape) takes both.
    """
    return Detector(executor).find_neighbours(
        boxes, other, groups, masks, both=both, ids=ids, ids_a=ids_a, ids_b=ids_b, closed=closed, tolerance=tolerance,
        dimensions=dimensions, dtype=dtype, copy=copy, invalid=invalid)


def find_pairs_in_sets(boxes, offsets, other=None, other_offsets=None, groups=None, masks=None, *, ids=None, ids_a=None,
                       ids_b=None, closed=True, tolerance=0.0, dimensions=3, dtype="int64", copy=None, invalid="warn",
                       executor=None):
    """Many searches in one call, such as those of many small worlds: every pair of boxes of the same set.

    boxes: as in find_pairs, one set after the other.
    offsets: integers, shape (m + 1,), for m sets: set i has boxes[offsets[i]:offsets[i + 1]]. They ascend from 0 to n;
        equal ones make an empty set. From the world of each box, in ascending order:
        numpy.searchsorted(world, numpy.arange(m + 1)).
    other, other_offsets: None, or as many sets more, as boxes and offsets. Then pairs of one box of set i of boxes and
        one of set i of other are found.
    Other parameters and errors: as find_pairs, for all boxes.

    Returns two arrays: pairs of dtype, shape (k, 2), and pair_offsets, int64, shape (m + 1,). The pairs of set i are
    pairs[pair_offsets[i]:pair_offsets[i + 1]], in the order of a search of its own. They are indices of boxes, a < b;
    with other, of boxes and of other.
    """
    return Detector(executor).find_pairs_in_sets(
        boxes, offsets, other, other_offsets, groups, masks, ids=ids, ids_a=ids_a, ids_b=ids_b, closed=closed,
        tolerance=tolerance, dimensions=dimensions, dtype=dtype, copy=copy, invalid=invalid)


def stream_pairs(boxes, callback, other=None, groups=None, masks=None, *, block=65536, ids=None, ids_a=None,
                 ids_b=None, closed=True, tolerance=0.0, dimensions=3, dtype="int64", copy=None, invalid="warn",
                 executor=None):
    """The pairs of find_pairs, in the same order, passed to a callable block by block while they are found.

    Memory does not grow with the number of pairs.

    callback: called with an array of dtype, shape (m, 2), which it may keep; m is block, and less in the last call. If
        it returns False (the object itself), the search stops. What it raises passes through.
    block: int above 0: pairs for each call.
    Other parameters and errors: as find_pairs.

    Returns an int: how many pairs were passed on. A signal handler's exception, such as KeyboardInterrupt, stops the
    search within a twentieth of a second of the next pairs.
    """
    return Detector(executor).stream_pairs(
        boxes, callback, other, groups, masks, block=block, ids=ids, ids_a=ids_a, ids_b=ids_b, closed=closed,
        tolerance=tolerance, dimensions=dimensions, dtype=dtype, copy=copy, invalid=invalid)


def find_near_pairs(points, distance, *, radii=None, dimensions=3, dtype="int64", max_pairs=None, invalid="warn",
                    executor=None):
    """Every pair of points or balls with a gap of at most distance, decided without rounding.

    That is |a - b| <= radius(a) + radius(b) + distance.

    points: array of floats or integers, shape (n, 3), or (n, dimensions): centres.
    distance: float, finite, not below 0.
    radii: None for points; a number for all, which is not rounded to the type of points; or an array of that type,
        shape (n,).
    invalid: as in find_pairs, of points with a number that is not finite, or a radius below 0.
    dimensions, dtype, max_pairs, executor: as in find_pairs.

    Returns an array of shape (k, 2): indices of points, a < b. Errors: as find_pairs.
    """
    return Detector(executor).find_near_pairs(points, distance, radii=radii, dimensions=dimensions, dtype=dtype,
                                              max_pairs=max_pairs, invalid=invalid)


def stream_near_pairs(points, distance, callback, *, block=65536, radii=None, dimensions=3, dtype="int64",
                      invalid="warn", executor=None):
    """The pairs of find_near_pairs, in the same order, passed to callback block by block: see stream_pairs.

    Returns an int: how many pairs were passed on.
    """
    return Detector(executor).stream_near_pairs(points, distance, callback, block=block, radii=radii,
                                                dimensions=dimensions, dtype=dtype, invalid=invalid)


def simd_target():
    """The name of the SIMD target that searches run on, such as 'AVX2'."""
    return _core.simd_target()
