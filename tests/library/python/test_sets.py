# SPDX-License-Identifier: MIT
"""find_pairs_in_sets: each set against searches of its own, which other tests hold against NumPy."""
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference import DTYPES, as_set, bit_arrays, box_arrays, random_boxes, self_pairs

import boxstream


def joined(sets, dtype):
    """Their boxes, and where each begins."""
    boxes = np.concatenate([np.reshape(each, (len(each), 6)) for each in sets] + [np.zeros((0, 6), dtype)])
    return boxes, np.cumsum([0] + [len(each) for each in sets])


def split(pairs, pair_offsets, offsets, other_offsets):
    """The pairs of each set, by its own indices."""
    for i in range(len(offsets) - 1):
        yield pairs[int(pair_offsets[i]):int(pair_offsets[i + 1])] - np.array([offsets[i], other_offsets[i]])


def lists_of(dtype):
    return st.lists(box_arrays(dtype), max_size=6)


@pytest.mark.parametrize("dtype", DTYPES)
@given(st.data())
def test_one_set_each(dtype, data):
    sets = data.draw(lists_of(dtype))
    boxes, offsets = joined(sets, dtype)
    pairs, pair_offsets = boxstream.find_pairs_in_sets(boxes, offsets)
    assert pair_offsets.shape == offsets.shape and pair_offsets[-1] == len(pairs)
    for own, found in zip(sets, split(pairs, pair_offsets, offsets, offsets)):
        assert np.array_equal(found, boxstream.find_pairs(own))
        assert as_set(found) == self_pairs(own)


@given(st.data())
def test_two_sets_each_with_filters(data):
    sets = data.draw(lists_of(np.float32))
    others = [data.draw(box_arrays(np.float32)) for _ in sets]
    boxes, offsets = joined(sets, np.float32)
    other, other_offsets = joined(others, np.float32)
    masks = data.draw(bit_arrays(len(other)))
    found = boxstream.find_pairs_in_sets(boxes, offsets, other, other_offsets, masks=(None, masks))
    for i, own in enumerate(split(*found, offsets, other_offsets)):
        part = masks[other_offsets[i]:other_offsets[i + 1]]
        assert np.array_equal(own, boxstream.find_pairs(sets[i], others[i], masks=(None, part)))


def test_uneven_sets_on_threads():
    sets = [random_boxes(n, np.float32, seed) for seed, n in enumerate([3, 0, 20000, 100, 170] + 300 * [64])]
    boxes, offsets = joined(sets, np.float32)
    alone = boxstream.find_pairs_in_sets(boxes, offsets.astype(np.uint64))
    for other_type in (offsets.tolist(), offsets.astype(np.int32), np.repeat(offsets, 2)[::2]):
        assert np.array_equal(boxstream.find_pairs_in_sets(boxes, other_type)[1], alone[1])
    detector = boxstream.Detector(executor=boxstream.Executor(2))
    shared = detector.find_pairs_in_sets(boxes, offsets)
    assert all(np.array_equal(a, b) for a, b in zip(alone, shared))
    assert detector.stats.boxes == len(boxes) and detector.stats.pairs == len(alone[0])


@pytest.mark.parametrize("offsets", [[], [0], [0, 1], [1, 2], [0, 2, 1, 2], [0, -1, 2], [0, 3]])
def test_wrong_offsets(offsets):
    with pytest.raises(ValueError, match="ascend from 0 to the number of boxes"):
        boxstream.find_pairs_in_sets(random_boxes(2, np.float32), np.array(offsets, dtype=np.int64))


def test_wrong_types():
    boxes = random_boxes(2, np.float32)
    with pytest.raises(TypeError, match=r"offsets: expected integers of shape \(n,\), got float64"):
        boxstream.find_pairs_in_sets(boxes, np.array([0.0, 2.0]))
    with pytest.raises(ValueError, match=r"offsets: expected integers of shape \(n,\), got int64 of shape \(1, 2\)"):
        boxstream.find_pairs_in_sets(boxes, [[0, 2]])
    with pytest.raises(TypeError, match="expected both or neither"):
        boxstream.find_pairs_in_sets(boxes, np.array([0, 2]), boxes)
    with pytest.raises(ValueError, match="as many offsets"):
        boxstream.find_pairs_in_sets(boxes, np.array([0, 2]), boxes, np.array([0, 1, 2]))
