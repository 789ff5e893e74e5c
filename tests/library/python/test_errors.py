# SPDX-License-Identifier: MIT
"""What cannot be used is one exception, which says what was expected and what was given."""
import numpy as np
import pytest

import boxstream

BOXES = np.zeros((4, 6), np.float32)
EXPECTED = r"boxes: expected an array of floats or integers of shape \(n, 6\) or \(n, 2, 3\), got "


def unaligned():
    return np.frombuffer(bytearray(4 * 6 * 4 + 1), np.uint8)[1:].view(np.float32).reshape(4, 6)


@pytest.mark.parametrize("given, text", [
    (None, "an object of type NoneType"),
    ("boxes", "an object of type str"),
    (7, "an object of type int"),
    (object(), "object"),
    (BOXES.astype(complex), "complex128"),
    (BOXES.astype(bool), "bool"),
    (BOXES.astype(object), "object"),
    (BOXES.astype(np.uint64) + np.uint64(2**63), "uint64 beyond int64"),
    (BOXES.astype(np.longdouble), "float128"),
])
def test_types(given, text):
    with pytest.raises(TypeError, match=EXPECTED + text + "($|: |, of an object that is no sequence)"):
        boxstream.find_pairs(given)


@pytest.mark.parametrize("given, text", [
    (np.zeros((4, 5), np.float32), r"float32 of shape \(4, 5\)$"),
    (np.zeros((4, 3, 2)), r"float64 of shape \(4, 3, 2\): boxes.transpose\(0, 2, 1\) has it$"),
    (np.zeros(6), r"float64 of shape \(6,\): one is boxes\[numpy.newaxis\]$"),
    (np.zeros(()), r"float64 of shape \(\)$"),
    (np.zeros((1, 4, 6)), r"float64 of shape \(1, 4, 6\)$"),
    (np.zeros((3, 4), int), r"int64 of shape \(3, 4\): boxes of 2 dimensions take dimensions=2$"),
    ([[0, 0, 0, 1, 1, 1], [0]], "what NumPy makes no array of: "),
])
def test_shapes(given, text):
    with pytest.raises(ValueError, match=EXPECTED + text):
        boxstream.find_pairs(given)


@pytest.mark.parametrize("given, text", [
    ([[0, 0, 0, 1, 1, 1]], "what has to be copied, which copy=False forbids"),
    (np.zeros((8, 6))[::2], r"float64 with strides \(96, 8\), which is not C order, and copy=False forbids a copy"),
    (np.zeros((4, 6), np.float32, order="F"), r"float32 with strides \(4, 16\), which is not"),
    (np.zeros((4, 8), np.float32)[:, :6], r"float32 with strides \(32, 4\), which is not"),
    (np.zeros((4, 6))[::-1], r"float64 with strides \(-48, 8\)"),
    (np.broadcast_to(np.zeros(6), (4, 6)), r"float64 with strides \(0, 8\)"),
    (unaligned(), "float32 that is not aligned, and copy=False forbids a copy"),
    (BOXES.astype(np.float16), "float16, and copy=False forbids a copy"),
    (BOXES.astype(np.dtype(np.float32).newbyteorder("S")), ">f4, and copy=False forbids a copy"),
])
def test_copies_can_be_forbidden(given, text):
    with pytest.raises(ValueError, match=EXPECTED + text):
        boxstream.find_pairs(given, copy=False)
    count = len(np.asarray(given))
    assert len(boxstream.find_pairs(given)) == count * (count - 1) // 2


class Own(np.ndarray):
    """A class of the caller's."""


@pytest.mark.parametrize("given", [
    lambda path: np.memmap(path / "boxes", np.float32, "w+", shape=(3, 6)),
    lambda path: np.zeros((3, 2, 3)).view(Own),
    lambda path: np.ma.masked_array(np.zeros((3, 6), np.int32)),
])
def test_arrays_of_other_classes_need_no_copy(given, tmp_path):
    assert len(boxstream.find_pairs(given(tmp_path), copy=False)) == 3


def test_none_need_no_copy():
    assert boxstream.find_pairs(np.zeros(0, np.int64), copy=False).shape == (0, 2)


@pytest.mark.parametrize("call, error, text", [
    (lambda: boxstream.find_pairs(BOXES, BOXES[:, :3].copy()), ValueError, r"other: expected .*got float32 of shape"),
    (lambda: boxstream.find_pairs(BOXES, groups=np.zeros(4)), TypeError,
     r"groups: expected integers of shape \(n,\), got float64"),
    (lambda: boxstream.find_pairs(BOXES, masks=[1, 2, 3, -4]), ValueError,
     "masks: expected integers that uint32 has; numpy.asarray"),
    (lambda: boxstream.find_pairs(BOXES, ids=[1, 2, 3, 2**40]), ValueError,
     "ids: expected integers that uint32 has; numpy.unique"),
    (lambda: boxstream.find_pairs(BOXES, ids_a=[1, 2, 3, 4]), TypeError, "ids_a, ids_b: are of two sets of boxes"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, ids=[1, 2, 3, 4]), TypeError, "ids: are of one set of boxes"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, ids_a=[1, 2, 3, 4]), TypeError, "ids_a, ids_b: expected both"),
    (lambda: boxstream.find_pairs(BOXES, closed=0), TypeError, "closed: expected True or False, got 0"),
    (lambda: boxstream.find_neighbours(BOXES, both="no"), TypeError, "both: expected True or False, got 'no'"),
    (lambda: boxstream.find_neighbours(BOXES, both=None), TypeError, "both: expected True or False, got None"),
    (lambda: boxstream.World(sticky_filters="no"), TypeError, "sticky_filters: expected True or False, got 'no'"),
    (lambda: boxstream.World(sticky_filters=None), TypeError, "sticky_filters: expected True or False, got None"),
    (lambda: boxstream.find_pairs(BOXES, tolerance=10**400), ValueError,
     "tolerance: expected a number that float64 has, got one that is too large"),
    (lambda: boxstream.find_pairs(BOXES, tolerance=-1), ValueError, "tolerance: expected a finite number that is not"),
    (lambda: boxstream.find_pairs(BOXES, dimensions=4), ValueError, "dimensions: expected 1, 2 or 3, got 4"),
    (lambda: boxstream.find_pairs(BOXES, dtype="int16"), TypeError, "dtype: expected int64, int32 or uint32, got int16"),
    (lambda: boxstream.find_pairs(BOXES, max_pairs=-1), ValueError, "max_pairs: expected an integer of at least 0"),
    (lambda: boxstream.find_pairs(np.ma.masked_equal(BOXES, 0)), ValueError, "boxes: has masked elements: boxes.filled"),
    (lambda: boxstream.find_pairs(BOXES, masks=np.zeros(5, np.uint32)), ValueError,
     "masks: expected 4 elements, got 5"),
    (lambda: boxstream.find_pairs(BOXES, groups=np.zeros((4, 1), np.uint32)), ValueError,
     r"groups: expected .* of shape \(n,\), got uint32 of shape \(4, 1\)"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, groups=np.zeros(4, np.uint32)), TypeError,
     "groups: expected a tuple of two arrays of integers or None, as there are two sets of boxes, got .* ndarray"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, masks=(None, None, None)), TypeError, "masks: expected a tuple of two"),
    (lambda: boxstream.find_pairs(BOXES, BOXES, masks=(None, np.zeros(3, np.uint32))), ValueError,
     r"masks\[1\]: expected 4 elements, got 3"),
    (lambda: boxstream.find_pairs(BOXES, invalid="ignore"), ValueError,
     "invalid: expected 'warn', 'skip' or 'raise', got 'ignore'"),
    (lambda: boxstream.stream_pairs(BOXES, print, block=0), ValueError,
     "block: expected an integer of at least 1, got 0"),
    (lambda: boxstream.stream_pairs(BOXES, print, block=-5), ValueError, "block: expected .* at least 1, got -5"),
    (lambda: boxstream.stream_pairs(BOXES, print, block=1.5), TypeError,
     "block: expected an integer, got an object of type float"),
    (lambda: boxstream.find_pairs(BOXES, executor=4), TypeError,
     "executor: expected an Executor or None, got an object of type int"),
    (lambda: boxstream.find_pairs(BOXES, invalid=None), ValueError, "invalid: expected 'warn', 'skip' or 'raise', got None"),
    (lambda: boxstream.find_near_pairs(BOXES[:, :3], "1"), TypeError,
     "distance: expected a number, got an object of type str"),
    (lambda: boxstream.Executor("2"), TypeError, "threads: expected an integer, got an object of type str"),
    (lambda: boxstream.Executor(10**30), ValueError, "threads: expected at most 4096, got 10+$"),
    (lambda: boxstream.World(executor=2), TypeError, "executor: expected an Executor or None"),
    (lambda: boxstream.stream_pairs(BOXES, None), TypeError, "callback: expected a callable, got .* NoneType"),
    (lambda: boxstream.find_near_pairs(BOXES, 1), ValueError,
     r"points: expected an array of floats of shape \(n, 3\), got float32 of shape \(4, 6\)"),
    (lambda: boxstream.find_near_pairs(BOXES[:, :4], 1), ValueError,
     r"points: .* shape \(4, 4\): if the fourth column has radii, points\[:, :3\] and radii=points\[:, 3\]"),
    (lambda: boxstream.find_near_pairs(BOXES[:, :3], 1, radii=np.zeros(3)), ValueError,
     "radii: expected one for each of 4 points, got 3"),
    (lambda: boxstream.Executor(0), ValueError, "threads: expected an integer of at least 1, got 0"),
    (lambda: boxstream.Executor(-3), ValueError, "threads: expected an integer of at least 1, got -3"),
    (lambda: boxstream.World("int32"), TypeError, "dtype: expected float32 or float64, got int32"),
    (lambda: boxstream.World().create(BOXES.astype(float) + 0.1), TypeError,
     r"boxes: expected an array of float32, as the World has, of shape .* got float64 that it does not have: "
     r"numpy.asarray\(boxes, numpy.float32\) rounds"),
    (lambda: boxstream.World().create(BOXES, users=np.zeros(4)), TypeError, "users: expected integers .* got float64"),
    (lambda: boxstream.World().create(BOXES, users=np.full(4, 2**63, np.uint64)), ValueError,
     "users: expected integers that int64 has"),
    (lambda: boxstream.World().create(BOXES, users=np.zeros(3, np.uint64)), ValueError,
     "users: expected 4 elements, got 3"),
    (lambda: boxstream.World().move(np.zeros(3, np.uint64), BOXES), ValueError,
     "boxes: expected one for each of 3 ids, got 4"),
    (lambda: boxstream.World().move(np.zeros(4), BOXES), TypeError, "ids: expected integers .* got float64"),
    (lambda: boxstream.World().boxes(np.zeros(1, np.uint64)), ValueError,
     r"ids: expected ids of live proxies, got a stale or null one at ids\[0\]"),
    (lambda: boxstream.World().users(np.zeros((1, 2), np.uint64)), ValueError, "ids: expected ids of live proxies"),
    (lambda: boxstream.World().users([-1]), ValueError, "ids: expected integers that uint64 has"),
    (lambda: boxstream.World().query_boxes(np.zeros((1, 3), np.float32)), ValueError, "boxes: expected"),
    (lambda: boxstream.World().query_rays(np.zeros((1, 3), np.float32), np.zeros((2, 3), np.float32)), ValueError,
     "directions: expected one for each of 1 origins, got 2"),
    (lambda: boxstream.World().query_rays(np.full((1, 3), 0.1), np.zeros((1, 3))), TypeError,
     "origins: expected an array of float32, as the World has, .* got float64 that it does not have"),
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


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError, ZeroDivisionError])
def test_what_a_number_of_the_callers_raises_passes_through(error):
    class Number:
        def __float__(self):
            raise error

    with pytest.raises(error):
        boxstream.find_pairs(BOXES, tolerance=Number())


def test_invalid_boxes_can_be_an_error():
    boxes = np.array([[0, 0, 0, 1, 1, 1], [0, 0, 0, np.nan, 1, 1], [0, 0, 1, 1, 1, 0], [0, 0, 0, np.inf, 1, 1]])
    assert boxstream.find_pairs(boxes, invalid="skip").tolist() == [[0, 3]]
    expected = r"boxes: expected none that is invalid \(a NaN, or min > max\), got 2 of 4; the first is boxes\[1\]$"
    for call in (boxstream.find_pairs, boxstream.World("float64").create):
        with pytest.raises(ValueError, match=expected):
            call(boxes, invalid="raise")
    with pytest.raises(ValueError, match=r"other\[1\]"):
        boxstream.find_pairs(boxes[:1], boxes, invalid="raise")
    assert boxstream.find_pairs(boxes[[0, 3]], invalid="raise").tolist() == [[0, 1]]


def test_an_error_in_a_conversion_leaves_numpys_error_state():
    before = np.geterr()
    endless = np.broadcast_to(0.25, (2**43, 6))  # of which a copy has 192 TiB
    with pytest.raises(MemoryError, match="192. TiB"):
        boxstream.World("float32").create(endless)
    assert np.geterr() == before


@pytest.mark.parametrize("equal", [np.dtype("=f4"), np.dtype(np.float32, metadata={"unit": "m"})])
def test_dtypes_that_are_float32(equal):
    assert len(boxstream.find_pairs(BOXES.astype(equal), copy=False)) == 6
