# SPDX-License-Identifier: MIT
"""find_pairs against all pairs of boxes, compared by NumPy."""
import re
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference import DTYPES, accepted, as_set, bit_arrays, box_arrays, pairs_of, random_boxes, self_pairs, touching

import boxstream


@given(box_arrays())
def test_one_set(boxes):
    pairs = boxstream.find_pairs(boxes)
    assert as_set(pairs) == self_pairs(boxes)
    assert (pairs[:, 0] < pairs[:, 1]).all()


@given(box_arrays(np.float32), box_arrays(np.float32))
def test_two_sets(boxes, other):
    assert as_set(boxstream.find_pairs(boxes, other)) == pairs_of(touching(boxes, other))


@given(box_arrays(np.float64), box_arrays(np.float64))
def test_two_sets_of_doubles(boxes, other):
    assert as_set(boxstream.find_pairs(boxes, other)) == pairs_of(touching(boxes, other))


@given(st.data())
def test_filters(data):
    boxes = data.draw(box_arrays())
    groups, masks = data.draw(bit_arrays(len(boxes))), data.draw(bit_arrays(len(boxes)))
    expected = touching(boxes, boxes) & accepted(groups, masks, groups, masks)
    assert as_set(boxstream.find_pairs(boxes, groups=groups, masks=masks)) == pairs_of(np.triu(expected, 1))


@given(st.data())
def test_filters_of_two_sets(data):
    boxes, other = data.draw(box_arrays(np.float32)), data.draw(box_arrays(np.float32))
    groups = data.draw(bit_arrays(len(boxes)))
    masks = data.draw(bit_arrays(len(other)))
    every, one = np.uint32(0xFFFFFFFF), np.uint32(1)
    expected = touching(boxes, other) & accepted(
        groups, np.full(len(boxes), every), np.full(len(other), one), masks)
    found = boxstream.find_pairs(boxes, other, groups=(groups, None), masks=(None, masks))
    assert as_set(found) == pairs_of(expected)


@pytest.mark.parametrize("dtype", DTYPES)
def test_many_boxes(dtype):
    boxes = random_boxes(3000, dtype)
    expected = self_pairs(boxes)
    assert len(expected) > 1000
    assert as_set(boxstream.find_pairs(boxes)) == expected


@pytest.mark.parametrize("dtype", DTYPES)
def test_shape_of_minima_and_maxima(dtype):
    boxes = random_boxes(200, dtype)
    nested = boxes.reshape(200, 2, 3)
    assert np.array_equal(boxstream.find_pairs(nested), boxstream.find_pairs(boxes))
    assert len(boxstream.find_pairs(nested)) > 0


def test_doubles_are_not_rounded_to_floats():
    gap = np.nextafter(1.0, 2.0)
    boxes = np.array([[0, 0, 0, 1, 1, 1], [gap, 0, 0, 2, 1, 1]])
    assert len(boxstream.find_pairs(boxes)) == 0
    assert len(boxstream.find_pairs(boxes.astype(np.float32))) == 1


@pytest.mark.parametrize("count", [0, 1])
def test_no_pairs(count):
    pairs = boxstream.find_pairs(np.zeros((count, 6), np.float32))
    assert pairs.shape == (0, 2) and pairs.dtype == np.int64


@pytest.mark.parametrize("dtype", ["int64", "int32", "uint32", np.int32])
def test_result_is_not_copied_and_outlives_the_search(dtype):
    detector = boxstream.Detector()
    boxes = random_boxes(500, np.float32)
    pairs = detector.find_pairs(boxes, dtype=dtype)
    assert pairs.dtype == dtype and not pairs.flags.owndata and pairs.flags.writeable and pairs.flags.c_contiguous
    assert type(pairs.base).__name__ == "PyCapsule"
    before = pairs.copy()
    detector.find_pairs(boxes[:100])
    del detector
    assert np.array_equal(pairs, before)


def test_input_may_be_read_only():
    boxes = random_boxes(50, np.float32)
    boxes.flags.writeable = False
    assert as_set(boxstream.find_pairs(boxes)) == self_pairs(boxes)


@pytest.mark.parametrize("dtype", DTYPES)
def test_numpy_makes_no_copy_of_input_or_result(dtype):
    boxes = random_boxes(20000, dtype).reshape(-1, 2, 3)
    tracemalloc.start()
    pairs = boxstream.find_pairs(boxes, dtype="int32")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < min(boxes.nbytes, pairs.nbytes) / 10


def test_a_detector_finds_the_same_and_tells_what_it_did():
    boxes = random_boxes(1000, np.float32)
    boxes[3, 0] = np.nan
    boxes[7, :3], boxes[7, 3:] = 1, 0
    detector = boxstream.Detector()
    pairs = detector.find_pairs(boxes)
    assert np.array_equal(pairs, boxstream.find_pairs(boxes))
    assert as_set(pairs) == self_pairs(boxes)
    assert (detector.stats.boxes, detector.stats.invalid, detector.stats.pairs) == (1000, 2, len(pairs))
    assert detector.scratch_bytes > 0
    assert "invalid=2" in repr(detector.stats)
    detector.shrink_to_fit()
    assert detector.scratch_bytes == 0
    assert np.array_equal(pairs, detector.find_pairs(boxes))


def test_scratch_memory_is_not_read_during_a_search():
    detector, calls = boxstream.Detector(), []

    def callback(pairs):
        calls.append(pairs)
        with pytest.raises(RuntimeError, match="this Detector is in use"):
            detector.scratch_bytes

    detector.stream_pairs(np.zeros((3, 6)), callback)
    assert len(calls) == 1 and detector.scratch_bytes >= 0


@pytest.mark.parametrize("cutoff", [0, 12])
@pytest.mark.parametrize("dtype", DTYPES)
def test_the_hybrid_method_finds_the_same(dtype, cutoff):
    boxes = random_boxes(700, dtype)
    detector = boxstream.Detector(method="hybrid", cutoff=cutoff)
    assert as_set(detector.find_pairs(boxes)) == self_pairs(boxes)
    assert as_set(detector.find_pairs(boxes[:300], boxes[300:])) == pairs_of(touching(boxes[:300], boxes[300:]))
    assert cutoff == 0 or detector.stats.nodes > 0
    world = boxstream.World(dtype, method="hybrid", cutoff=cutoff)
    world.create(boxes)
    assert world.update().search.boxes == 700
    assert world.update().search.boxes == 0
    assert len(world.pairs) == len(self_pairs(boxes))


def told_by(stats):
    """The counts that its text names, which is written from the struct itself."""
    return {name: int(value) for name, value in re.findall(r"(\w+)=(\d+)", repr(stats).split(", search=")[0])}


def test_counts_are_those_of_their_names():
    detector = boxstream.Detector()
    boxes = random_boxes(20_000, np.float32)
    boxes[:3, 0] = np.nan
    pairs = detector.find_pairs(boxes)
    told = told_by(detector.stats)
    assert told == {name: getattr(detector.stats, name) for name in told}
    assert told.pop("over_budget") == 0  # as none of the others is
    assert len(set(told.values())) == 7 and 0 not in told.values()
    assert (told["boxes"], told["invalid"], told["pairs"]) == (20_000, 3, len(pairs))


def test_counts_of_a_world_are_those_of_their_names():
    world = boxstream.World()
    boxes = np.zeros((40, 6), np.float32)
    boxes[:, 3] = 1
    boxes[:, [0, 3]] += np.arange(40)[:, None]  # in a row, each touches the next
    boxes[39, 0] = np.nan
    ids = world.create(boxes)
    world.update()
    boxes[:2, 1:3] = 7  # the first two by themselves, elsewhere
    boxes[:2, 4:] = 8
    world.move(ids[:2], boxes[:2])
    world.destroy(ids[20:21])
    stats = world.update()
    assert told_by(stats) == {"proxies": 39, "invalid": 1, "moved": 2, "pairs": 35, "begun": 0, "ended": 3}
    assert told_by(stats) == {name: getattr(stats, name) for name in told_by(stats)}
    assert stats.search.boxes == told_by(stats.search)["boxes"]
