# SPDX-License-Identifier: MIT
"""What cannot be used is one exception, which says what was expected and what was given."""
import numpy as np
import pytest

import boxstream

BOXES = np.zeros((4, 6), np.float32)
EXPECTED = r"boxes: expected a C-ordered array of float32 or float64 of shape \(n, 6\) or \(n, 2, 3\), got "


def swapped(dtype):
    return np.dtype(dtype).newbyteorder("S")


def unaligned():
    return np.frombuffer(bytearray(4 * 6 * 4 + 1), np.uint8)[1:].view(np.float32).reshape(4, 6)


@pytest.mark.parametrize("given, text", [
    ([[0, 0, 0, 1, 1, 1]], "an object of type list"),
    (None, "an object of type NoneType"),
    ("boxes", "an object of type str"),
    (BOXES.astype(np.float16), "float16"),
    (BOXES.astype(np.int64), "int64"),
    (BOXES.astype(complex), "complex128"),
    (BOXES.astype(object), "object"),
    (BOXES.astype(swapped(np.float32)), ">f4"),
])
def test_types(given, text):
    with pytest.raises(TypeError, match=EXPECTED + text + "$"):
        boxstream.find_pairs(given)


@pytest.mark.parametrize("given, text", [
    (np.zeros((4, 5), np.float32), r"float32 of shape \(4, 5\)"),
    (np.zeros((4, 3, 2)), r"float64 of shape \(4, 3, 2\)"),
    (np.zeros(6), r"float64 of shape \(6,\)"),
    (np.zeros(()), r"float64 of shape \(\)"),
    (np.zeros((0,)), r"float64 of shape \(0,\)"),
    (np.zeros((1, 4, 6)), r"float64 of shape \(1, 4, 6\)"),
    (np.zeros((8, 6))[::2], r"float64 with strides \(96, 8\): numpy.ascontiguousarray makes a copy in C order"),
    (np.zeros((4, 6), np.float32, order="F"), r"float32 with strides \(4, 16\): numpy.ascontiguousarray makes"),
    (np.zeros((4, 8), np.float32)[:, :6], r"float32 with strides \(32, 4\): numpy.ascontiguousarray makes"),
    (np.zeros((4, 6))[::-1], r"float64 with strides \(-48, 8\)"),
    (np.broadcast_to(np.zeros(6), (4, 6)), r"float64 with strides \(0, 8\)"),
    (unaligned(), "float32 that is not aligned: numpy.require"),
])
def test_layouts(given, text):
    with pytest.raises(ValueError, match=EXPECTED + text):
        boxstream.find_pairs(given)


@pytest.mark.parametrize("call, error, text", [
    (lambda: boxstream.find_pairs(BOXES, BOXES.astype(np.float64)), TypeError,
     "other: expected float32, as boxes are, got float64"),
    (lambda: boxstream.find_pairs(BOXES, BOXES[:, :3].copy()), ValueError, r"other: expected .*got float32 of shape"),
    (lambda: boxstream.find_pairs(BOXES, groups=np.zeros(4, np.int64)), TypeError,
     r"groups: expected a C-ordered array of uint32 of shape \(n,\), got int64"),
    (lambda: boxstream.find_pairs(BOXES, masks=[1, 2, 3, 4]), TypeError,
     r"masks: expected .* got an object of type list"),
    (lambda: boxstream.find_pairs(BOXES, masks=np.zeros(5, np.uint32)), ValueError,
     "masks: expected 4 elements, got 5"),
    (lambda: boxstream.find_pairs(BOXES, groups=np.zeros((4, 1), np.uint32)), ValueError,
     r"groups: expected .* of shape \(n,\), got uint32 of shape \(4, 1\)"),
    (lambda: boxstream.find_pairs(BOXES, groups=np.zeros(8, np.uint32)[::2]), ValueError,
     r"groups: expected .*strides \(8,\)"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, groups=np.zeros(4, np.uint32)), TypeError,
     "groups: expected a tuple of two arrays of uint32 or None, as there are two sets of boxes, got .* ndarray"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, masks=(None, None, None)), TypeError, "masks: expected a tuple of two"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, masks=(None, np.zeros(3, np.uint32))), ValueError,
     r"masks\[1\]: expected 4 elements, got 3"),
    (lambda: boxstream.find_pairs(BOXES, invalid="ignore"), ValueError,
     "invalid: expected 'skip' or 'raise', got 'ignore'"),
    (lambda: boxstream.stream_pairs(BOXES, print, block=0), ValueError,
     "block: expected an integer of at least 1, got 0"),
    (lambda: boxstream.stream_pairs(BOXES, print, block=-5), ValueError, "block: expected .* at least 1, got -5"),
    (lambda: boxstream.stream_pairs(BOXES, print, block=1.5), TypeError,
     "block: expected an integer, got an object of type float"),
    (lambda: boxstream.find_pairs(BOXES, executor=4), TypeError,
     "executor: expected an Executor or None, got an object of type int"),
    (lambda: boxstream.find_pairs(BOXES, invalid=None), ValueError, "invalid: expected 'skip' or 'raise', got None"),
    (lambda: boxstream.find_near_pairs(BOXES[:, :3].copy(), "1"), TypeError,
     "distance: expected a number, got an object of type str"),
    (lambda: boxstream.Executor("2"), TypeError, "threads: expected an integer, got an object of type str"),
    (lambda: boxstream.Executor(10**30), ValueError, "threads: expected at most 4096, got 10+$"),
    (lambda: boxstream.World(executor=2), TypeError, "executor: expected an Executor or None"),
    (lambda: boxstream.stream_pairs(BOXES, None), TypeError, "callback: expected a callable, got .* NoneType"),
    (lambda: boxstream.find_near_pairs(BOXES, 1), ValueError,
     r"balls: expected .* of shape \(n, 3\) or \(n, 4\), got float32 of shape \(4, 6\)"),
    (lambda: boxstream.Executor(0), ValueError, "threads: expected an integer of at least 1, got 0"),
    (lambda: boxstream.Executor(-3), ValueError, "threads: expected an integer of at least 1, got -3"),
    (lambda: boxstream.World("int32"), TypeError, "dtype: expected float32 or float64, got int32"),
    (lambda: boxstream.World().create(BOXES.astype(np.float64)), TypeError,
     "boxes: expected float32, as the World has, got float64"),
    (lambda: boxstream.World().create(BOXES, users=np.zeros(4, np.int64)), TypeError, "users: expected .* uint64"),
    (lambda: boxstream.World().create(BOXES, users=np.zeros(3, np.uint64)), ValueError,
     "users: expected 4 elements, got 3"),
    (lambda: boxstream.World().move(np.zeros(3, np.uint64), BOXES), ValueError,
     "boxes: expected one for each of 3 ids, got 4"),
    (lambda: boxstream.World().move(np.zeros(4, np.int64), BOXES), TypeError, "ids: expected .* uint64 .* got int64"),
    (lambda: boxstream.World().boxes(np.zeros(1, np.uint64)), ValueError,
     r"ids: expected ids of live proxies, got a stale or null one at ids\[0\]"),
    (lambda: boxstream.World().users(np.zeros((1, 2), np.uint64)), ValueError, "ids: expected ids of live proxies"),
    (lambda: boxstream.World().users([1]), TypeError, "ids: expected .* uint64 .* got an object of type list"),
    (lambda: boxstream.World().query_boxes(np.zeros((1, 3), np.float32)), ValueError, "boxes: expected"),
    (lambda: boxstream.World().query_rays(np.zeros((1, 3), np.float32), np.zeros((2, 3), np.float32)), ValueError,
     "directions: expected one for each of 1 origins, got 2"),
    (lambda: boxstream.World().query_rays(np.zeros((1, 3)), np.zeros((1, 3))), TypeError,
     "origins: expected float32, as the World has, got float64"),
    (lambda: boxstream.World().cast_rays(np.zeros((1, 3), np.float32), np.zeros((1, 3), np.float32),
                                         np.zeros(2, np.float32)), ValueError,
     "lengths: expected one for each of 1 origins, got 2"),
    (lambda: boxstream.World().query_nearest(np.zeros((1, 2), np.float32)), ValueError, "points: expected"),
    (lambda: boxstream.World().query_rays(np.zeros((1, 3), np.float32), np.zeros((1, 3), np.float32), "far"), TypeError,
     "lengths: expected a number, got an object of type str"),
    (lambda: boxstream.World().query_nearest(np.zeros((9, 3), np.float32), -1), ValueError,
     "count: expected an integer of at least 0, got -1"),
    (lambda: boxstream.World().query_nearest(np.zeros((9, 3), np.float32), 2**61), ValueError, "count: "),
    (lambda: boxstream.Detector(method="best"), ValueError, "method: expected 'planned' or 'hybrid', got 'best'"),
    (lambda: boxstream.World(method=None), ValueError, "method: expected 'planned' or 'hybrid', got None"),
    (lambda: boxstream.Detector(cutoff=2**32), ValueError, "cutoff: expected an integer below 2\\^32, got 4294967296"),
    (lambda: boxstream.World(cutoff="few"), TypeError, "cutoff: expected an integer, got an object of type str"),
])
def test_arguments(call, error, text):
    with pytest.raises(error, match="^" + text):
        call()


def test_invalid_boxes_can_be_an_error():
    boxes = np.array([[0, 0, 0, 1, 1, 1], [0, 0, 0, np.nan, 1, 1], [0, 0, 1, 1, 1, 0], [0, 0, 0, np.inf, 1, 1]])
    assert boxstream.find_pairs(boxes).tolist() == [[0, 3]]
    expected = r"boxes: expected none that is invalid \(a NaN, or min > max\), got 2 of 4; the first is boxes\[1\]$"
    for call in (boxstream.find_pairs, boxstream.World("float64").create):
        with pytest.raises(ValueError, match=expected):
            call(boxes, invalid="raise")
    with pytest.raises(ValueError, match=r"other\[1\]"):
        boxstream.find_pairs(boxes[:1], boxes, invalid="raise")
    assert boxstream.find_pairs(boxes[[0, 3]], invalid="raise").tolist() == [[0, 1]]


@pytest.mark.parametrize("equal", [np.dtype("=f4"), np.dtype(np.float32, metadata={"unit": "m"})])
def test_dtypes_that_are_float32(equal):
    assert len(boxstream.find_pairs(BOXES.astype(equal))) == 6
