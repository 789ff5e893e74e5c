# SPDX-License-Identifier: MIT
"""What people have instead of float arrays in C order, and what they do with the result."""
import _thread
import multiprocessing
import pickle
import signal
import sys
import time
import warnings

import numpy as np
import pytest
from reference import as_set, pairs_of, random_boxes, self_pairs, touching

import boxstream

FUNCTIONS = [getattr(boxstream, name) for name in boxstream.__all__ if name.startswith(("find", "stream"))]


def whole(count=300, seed=2):
    low = np.random.default_rng(seed).integers(0, 40, (count, 3))
    return np.hstack([low, low + np.random.default_rng(seed + 1).integers(0, 6, (count, 3))])


@pytest.mark.parametrize("dtype", [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, np.float16])
def test_other_numbers_have_the_same_pairs(dtype):
    boxes = whole()
    assert as_set(boxstream.find_pairs(boxes.astype(dtype))) == self_pairs(boxes)


def test_integers_are_not_rounded():
    far = 2**53 - 8
    boxes = np.array([[far, 0, 0, far + 1, 1, 1], [far + 2, 0, 0, far + 3, 1, 1], [far + 1, 1, 1, far + 2, 1, 1]])
    assert as_set(boxstream.find_pairs(boxes)) == {(0, 2), (1, 2)}
    with pytest.raises(ValueError):
        boxstream.find_pairs(boxes * 4)


def test_layouts_are_copied():
    boxes = random_boxes(400, np.float64)
    expected = boxstream.find_pairs(boxes)
    apart = np.zeros((400, 9))
    apart[:, :6] = boxes
    for other in (boxes.tolist(), np.asfortranarray(boxes), apart[:, :6], np.repeat(boxes, 2, axis=0)[::2],
                  np.ma.masked_array(boxes), memoryview(boxes), boxes.astype(">f8")):
        assert np.array_equal(boxstream.find_pairs(other), expected)


def test_data_frames():
    pandas = pytest.importorskip("pandas")
    boxes = random_boxes(200, np.float64)
    frame = pandas.DataFrame({name: boxes[:, i] for i, name in enumerate("x0 y0 z0 x1 y1 z1".split())})
    assert np.array_equal(boxstream.find_pairs(frame), boxstream.find_pairs(boxes))
    near = boxstream.find_near_pairs(frame[["x0", "y0", "z0"]], 0.05, radii=frame["x1"] - frame["x0"])
    assert np.array_equal(near, boxstream.find_near_pairs(boxes[:, :3], 0.05, radii=boxes[:, 3] - boxes[:, 0]))


def test_sets_of_different_types():
    a, b = random_boxes(200, np.float32, 1), random_boxes(200, np.float64, 2)
    assert as_set(boxstream.find_pairs(a, b)) == pairs_of(touching(a, b))
    assert as_set(boxstream.find_pairs(whole(100, 1), whole(100, 2) + 0.5)) == pairs_of(
        touching(whole(100, 1), whole(100, 2) + 0.5))


def brute(boxes, dimensions, closed=True, tolerance=0.0):
    low, high = boxes[:, :dimensions], boxes[:, dimensions:]
    below = low[:, None] <= high[None] + tolerance if closed else low[:, None] < high[None] + tolerance
    return pairs_of(np.triu((below & below.transpose(1, 0, 2)).all(axis=2), 1))


@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int32, np.int64])
def test_dimensions_and_rules(dtype, dimensions):
    generator = np.random.default_rng(dimensions)
    low = generator.integers(0, 30, (250, dimensions))
    boxes = np.hstack([low, low + generator.integers(0, 4, (250, dimensions))]).astype(dtype)
    ids = generator.integers(0, 20, 250)
    for closed in (True, False):
        for tolerance in (0, 1, 2):
            expected = brute(boxes, dimensions, closed, tolerance)
            options = dict(dimensions=dimensions, closed=closed, tolerance=tolerance)
            assert as_set(boxstream.find_pairs(boxes, **options)) == expected
            assert as_set(boxstream.find_pairs(boxes.reshape(250, 2, dimensions), **options)) == expected
            other_ids = {(a, b) for a, b in expected if ids[a] != ids[b]}
            assert as_set(boxstream.find_pairs(boxes, ids=ids, **options)) == other_ids
            two = boxstream.find_pairs(boxes, boxes, ids_a=ids, ids_b=ids, **options)
            assert {(min(a, b), max(a, b)) for a, b in two.tolist() if a != b} == other_ids


def results(dtype):
    """Of every call that has a dtype, all in one array."""
    boxes = random_boxes(300, np.float64)
    points = boxes[:, :3].copy()
    blocks = []
    boxstream.stream_pairs(boxes, blocks.append, dtype=dtype)
    boxstream.stream_near_pairs(points, 0.1, blocks.append, dtype=dtype)
    rows = [boxstream.find_pairs(boxes, dtype=dtype), *blocks, boxstream.find_pairs_in_sets(boxes, [0, 200, 300], dtype=dtype)[0],
            boxstream.find_near_pairs(points, 0.1, dtype=dtype), boxstream.BoxIndex(boxes).query_boxes(boxes[:20], dtype=dtype),
            boxstream.find_neighbours(boxes, dtype=dtype)[1]]
    assert all(len(each) > 20 for each in rows)
    return np.concatenate([each.reshape(-1) for each in rows])


@pytest.mark.parametrize("dtype", [np.int32, np.uint32])
def test_every_result_has_the_dtype_that_was_asked_for(dtype):
    expected, found = results(np.int64), results(dtype)
    assert (expected.dtype, found.dtype) == (np.int64, dtype) and np.array_equal(found, expected)


def test_points_in_a_plane():
    points = np.random.default_rng(4).random((400, 2))
    gaps = ((points[:, None] - points[None]) ** 2).sum(axis=2)
    assert as_set(boxstream.find_near_pairs(points, 0.05, dimensions=2)) == pairs_of(np.triu(gaps <= 0.05**2, 1))


@pytest.mark.parametrize("dtype", ["int64", "int32"])
def test_what_numpy_users_do_with_pairs(dtype):
    sparse = pytest.importorskip("scipy.sparse")
    boxes = random_boxes(2000, np.float32)
    pairs = boxstream.find_pairs(boxes, dtype=dtype)
    assert pairs.dtype == dtype and (pairs[:, 0] - pairs[:, 1] < 0).all()
    assert np.bincount(pairs[:, 0], minlength=2000).sum() == len(pairs)
    offsets, indices = boxstream.find_neighbours(boxes, dtype=dtype)
    assert offsets.dtype == np.int64 and indices.dtype == dtype
    touches = sparse.csr_matrix((np.ones(len(indices)), indices, offsets), shape=(2000, 2000))
    expected = sparse.coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(2000, 2000))
    assert touches.has_sorted_indices and (touches != expected + expected.T).nnz == 0
    once = boxstream.find_neighbours(boxes, both=False)
    assert np.array_equal(np.repeat(np.arange(2000), np.diff(once[0])), np.sort(pairs[:, 0]))
    both_sets = boxstream.find_neighbours(boxes[:500], boxes[500:])
    two = boxstream.find_pairs(boxes[:500], boxes[500:])
    assert as_set(np.column_stack([np.repeat(np.arange(500), np.diff(both_sets[0])), both_sets[1]])) == as_set(two)


def test_offsets_of_sets_are_int64():
    boxes = random_boxes(900, np.float32)
    pairs, offsets = boxstream.find_pairs_in_sets(boxes, [0, 300, 300, 900])
    assert offsets.dtype == np.int64 and (offsets[:-1] + np.arange(3)).dtype == np.int64
    assert len(np.split(pairs, offsets[1:-1])) == 3
    assert np.add.reduceat(np.ones(len(pairs)), offsets[[0, 2]]).sum() == len(pairs)


def test_users_are_int64():
    world = boxstream.World()
    ids = world.create(random_boxes(50, np.float32), users=np.arange(-10, 40))
    world.update()
    assert world.users(ids).dtype == np.int64 and world.users(ids).tolist() == list(range(-10, 40))
    assert world.users(ids[::3].tolist()).tolist() == list(range(-10, 40, 3))


def test_numbers_that_a_world_does_not_have_are_refused():
    world = boxstream.World("float32")
    world.create(whole())
    world.create(whole().astype(np.float64) / 4)
    with pytest.raises(TypeError, match="rounds"):
        world.create(whole() + 2**24)
    with pytest.raises(TypeError, match="rounds"):
        boxstream.World("float64").create(whole() + 2**53)
    assert len(world) == 600


@pytest.mark.parametrize("function", FUNCTIONS)
def test_functions_are_pickled_by_name(function):
    assert pickle.loads(pickle.dumps(function)) is function


def test_a_pool_of_processes():
    boxes = [random_boxes(500, np.float32, seed) for seed in range(4)]
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for pairs, own in zip(pool.map(boxstream.find_pairs, boxes), boxes):
            assert np.array_equal(pairs, boxstream.find_pairs(own))


@pytest.mark.parametrize("find", [
    lambda most: boxstream.find_pairs(np.zeros((100, 6)), max_pairs=most),
    lambda most: boxstream.find_near_pairs(np.zeros((100, 3)), 1, max_pairs=most),
])
def test_more_pairs_than_wanted(find):
    assert len(find(4950)) == 4950
    with pytest.raises(MemoryError, match="more pairs than max_pairs=4949; stream_pairs passes them on block by block"):
        find(4949)


def test_ctrl_c_ends_a_search_with_many_pairs():
    def handle(*_):
        raise KeyboardInterrupt

    old = signal.signal(signal.SIGALRM, handle)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        began = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            boxstream.find_pairs(np.zeros((60_000, 6), np.float32), dtype="int32")  # 1.8e9 pairs
        assert time.monotonic() - began < 1
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def disordered(boxes, columns):
    return np.ascontiguousarray(boxes[:, columns])


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_likely_layouts_are_named(seed, dimensions):
    boxes = np.delete(random_boxes(500, np.float64, seed), [] if dimensions == 3 else [2, 5], axis=1)
    d = dimensions
    sizes = boxes.copy()
    sizes[:, d:] -= sizes[:, :d]
    cases = {
        "interleaved": disordered(boxes, [axis + end for axis in range(d) for end in (0, d)]),
        "come first": disordered(boxes, [*range(d, 2 * d), *range(d)]),
        "to be sizes": sizes,
    }
    for words, wrong in cases.items():
        with pytest.warns(boxstream.InvalidBoxesWarning, match=words) as caught:
            boxstream.find_pairs(wrong, dimensions=d)
        assert caught[0].filename == __file__
        # The advice is code that makes it right.
        code = str(caught[0].message).split(": boxes")[1].split(" puts")[0].split(" makes")[0]
        scope = {"boxes": wrong.copy()}
        exec(f"boxes{code}" if "=" in code else f"boxes = boxes{code}", scope)
        assert np.allclose(scope["boxes"], boxes)


@pytest.mark.parametrize("dtype, scale", [(np.float32, 3e30), (np.float64, 2e149), (np.int64, 2**50)])
def test_layouts_of_large_numbers_are_named(dtype, scale):
    low = np.random.default_rng(5).uniform(-3, 3, (40, 3))
    sizes = (np.hstack([low, np.full((40, 3), 0.25)]) * scale).astype(dtype)
    with np.errstate(all="raise"), pytest.warns(boxstream.InvalidBoxesWarning, match="maxima seem to be sizes: boxes"):
        boxstream.find_pairs(sizes)


def test_a_thread_without_frames_of_python_is_warned(monkeypatch):
    raised, detector = [], boxstream.Detector()
    monkeypatch.setattr(sys, "unraisablehook", raised.append)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        _thread.start_new_thread(detector.find_pairs, (np.full((7, 6), np.nan),))
        end = time.monotonic() + 10
        while not caught and not raised and time.monotonic() < end:
            time.sleep(0.001)
    assert raised == [] and [each.category for each in caught] == [boxstream.InvalidBoxesWarning]


def test_a_few_invalid_boxes_are_no_warning():
    boxes = random_boxes(100, np.float32)
    boxes[:10, 0] = np.nan
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        boxstream.find_pairs(boxes)
        boxstream.Detector().find_pairs(np.full((3, 6), np.nan), invalid="skip")
        boxes[10, 0] = np.nan
        for find in (boxstream.find_pairs, boxstream.Detector().find_pairs, boxstream.find_neighbours):
            with pytest.raises(boxstream.InvalidBoxesWarning, match="11 of 100 boxes are invalid .*; 11 have a NaN"):
                find(boxes)
        with pytest.raises(boxstream.InvalidBoxesWarning, match="2 of 5 points"):
            boxstream.find_near_pairs([[0, 0, 0]] * 3 + [[np.nan, 0, 0]] * 2, 1)


def test_a_warning_that_is_an_error_comes_before_any_change():
    boxes = random_boxes(20, np.float32)
    wrong = boxes[:, [3, 4, 5, 0, 1, 2]]
    world = boxstream.World()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ids = world.create(boxes)
        world.update()
        with pytest.raises(boxstream.InvalidBoxesWarning, match="come first"):
            world.create(wrong)
        with pytest.raises(boxstream.InvalidBoxesWarning, match="come first"):
            world.move(ids, wrong, invalid="warn")
        with pytest.raises(boxstream.InvalidBoxesWarning, match="come first"):
            boxstream.BoxIndex(wrong)
        assert len(world) == 20 and np.array_equal(world.boxes(ids), boxes)
        world.save()  # nothing has changed since the update
        assert world.move(ids, wrong) == 20


BOXES = random_boxes(300, np.float64)


@pytest.mark.parametrize("wrong, hint", [
    (lambda: BOXES.T.copy(), "boxes.T has it"),
    (lambda: BOXES.ravel(), "boxes.reshape(-1, 6) has it"),
    (lambda: BOXES[0], "one is boxes[numpy.newaxis]"),
    (lambda: np.stack([BOXES[:, :3], BOXES[:, 3:]], axis=2), "boxes.transpose(0, 2, 1) has it"),
    (lambda: BOXES[:, [0, 1, 3, 4]].reshape(-1, 2, 2), "boxes of 2 dimensions take dimensions=2"),
    (lambda: np.full((3, 6), 2**63, np.uint64), "uint64 beyond int64: boxes.astype(numpy.float64) rounds"),
    (lambda: np.full((3, 6), 2**53 + 1), "integers must be within +-2^53; less the least of all, they make the same pairs"),
    (lambda: np.stack([BOXES[:, :3], BOXES[:, 3:]]), "boxes.swapaxes(0, 1) has it"),
    (lambda: np.zeros((5, 8, 3)), "numpy.hstack([boxes.min(axis=1), boxes.max(axis=1)]) makes boxes of corners"),
    (lambda: BOXES.tobytes(), "numpy.frombuffer(boxes, ...)"),
    (lambda: BOXES.astype(np.longdouble), "boxes.astype(numpy.float64) rounds"),
    (lambda: BOXES.astype(object), "numpy.asarray(boxes, float) makes floats"),
    (lambda: BOXES.astype(str), "numpy.asarray(boxes, float) reads them"),
    (lambda: zip(BOXES[:, :3], BOXES[:, 3:]), "list(boxes) may be one"),
    (lambda: np.zeros(5, [("min", "f4", 3), ("max", "f4", 3)]), "structured_to_unstructured(boxes)"),
])
def test_errors_say_what_helps(wrong, hint):
    with pytest.raises((TypeError, ValueError)) as error:
        boxstream.find_pairs(wrong())
    assert hint in str(error.value)


@pytest.mark.parametrize("call, hint", [
    (lambda: boxstream.find_near_pairs(BOXES[:, :2].copy(), 1), "points of 2 dimensions take dimensions=2"),
    (lambda: boxstream.find_near_pairs(BOXES[:, :3], 1, radii=np.ones((300, 1))), "radii.ravel() has it"),
    (lambda: boxstream.find_pairs(BOXES, groups=np.full(300, -1)), "numpy.asarray(x).astype(numpy.uint32) has the bits"),
    (lambda: boxstream.BoxIndex.load("text"), "saved: expected bytes, got an object of type str"),
    (lambda: boxstream.World.load([1, 2]), "saved: expected bytes, got an object of type list"),
    (lambda: boxstream.find_pairs(BOXES, ids=np.full(300, "a")), "numpy.unique(x, return_inverse=True)[1]"),
    (lambda: boxstream.find_pairs_in_sets(BOXES, [100, 200]), "numpy.append(0, numpy.cumsum(sizes))"),
    (lambda: boxstream.World("float64").create(BOXES[:, :4]), "seem to have 2 dimensions; the others are from 0 to 1"),
])
def test_other_errors_say_what_helps(call, hint):
    with pytest.raises((TypeError, ValueError)) as error:
        call()
    assert hint in str(error.value)


def test_intervals_of_time():
    days = np.array([["2020-01-01", "2020-01-05"], ["2020-01-04", "2020-01-08"]], "datetime64[D]")
    assert boxstream.find_pairs(days.astype(np.int64), dimensions=1).tolist() == [[0, 1]]


def test_numpys_booleans():
    assert np.array_equal(boxstream.find_pairs(BOXES, closed=np.True_), boxstream.find_pairs(BOXES))
    with pytest.raises(TypeError, match="expected True or False"):
        boxstream.find_pairs(BOXES, closed=np.array([True]))
    assert len(boxstream.find_neighbours(BOXES, both=np.False_)[1]) == len(boxstream.find_pairs(BOXES))


def test_a_world_warns_of_layouts():
    with pytest.warns(boxstream.InvalidBoxesWarning, match="interleaved"):
        boxstream.World("float64").create(BOXES[:, [0, 3, 1, 4, 2, 5]])
