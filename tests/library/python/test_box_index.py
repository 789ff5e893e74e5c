# SPDX-License-Identifier: MIT
"""BoxIndex: boxes that stay, asked, saved and pickled."""
import pickle
import threading

import numpy as np
import pytest
from hypothesis import given
from reference import DTYPES, as_set, box_arrays, pairs_of, random_boxes, touching

import boxstream


@given(box_arrays(), box_arrays())
def test_it_finds_what_touches(many, few):
    few = few.astype(many.dtype)
    index = boxstream.BoxIndex(many)
    assert len(index) == len(many) and index.dtype == many.dtype
    found = index.query_boxes(few)
    assert found.dtype == np.int64 and as_set(found) == pairs_of(touching(few, many))
    for other in (boxstream.BoxIndex.load(index.save()), pickle.loads(pickle.dumps(index))):
        assert len(other) == len(many) and other.save() == index.save()
        assert np.array_equal(other.query_boxes(few, dtype="int32"), found)


@pytest.mark.parametrize("dtype", DTYPES)
def test_many_queries_are_those_of_find_pairs(dtype):
    many, few = random_boxes(3000, dtype), random_boxes(9000, dtype, seed=2)
    assert as_set(boxstream.BoxIndex(many).query_boxes(few)) == as_set(boxstream.find_pairs(few, many))


@pytest.mark.parametrize("dimensions", [1, 2])
def test_of_fewer_dimensions(dimensions):
    low = np.random.default_rng(3).integers(0, 60, (500, dimensions))
    boxes = np.hstack([low, low + 4])
    index = pickle.loads(pickle.dumps(boxstream.BoxIndex(boxes, dimensions=dimensions)))
    assert index.dimensions == dimensions and index.dtype == np.float64
    assert as_set(index.query_boxes(boxes[:50])) == as_set(
        boxstream.find_pairs(boxes[:50], boxes, dimensions=dimensions))
    assert index.bounds.tolist() == [*boxes[:, :dimensions].min(axis=0), *boxes[:, dimensions:].max(axis=0)]
    points = low[:20] - 100.5
    gaps = np.maximum(0, np.maximum(low[None] - points[:, None], points[:, None] - low[None] - 4))
    nearest = (gaps**2).sum(axis=2)
    found = index.query_nearest(points, 3)
    np.testing.assert_array_equal(np.take_along_axis(nearest, found, 1), np.sort(nearest, axis=1)[:, :3])
    ahead = np.zeros((1, dimensions))
    ahead[0, 0] = 1
    hit, t = index.cast_rays(low[:1] - 200 * ahead, ahead)
    assert hit[0] >= 0 and low[hit[0], 0] - (low[0, 0] - 200) == t[0]


def test_rays_and_nearest_ones_are_those_of_a_world():
    boxes = random_boxes(800, np.float32)
    index, world = boxstream.BoxIndex(boxes), boxstream.World()
    number = dict(zip(world.create(boxes).tolist(), range(800)))
    random = np.random.default_rng(5)
    origins, directions = random.random((60, 3)).astype(np.float32), random.normal(size=(60, 3)).astype(np.float32)
    hit, t = index.cast_rays(origins, directions)
    ids, enters = world.cast_rays(origins, directions)
    assert hit.tolist() == [number.get(each, -1) for each in ids.tolist()] and np.array_equal(t, enters)
    which, found, at = index.query_rays(origins, directions, 0.5)
    rays, proxies, entered = world.query_rays(origins, directions, 0.5)
    assert sorted(zip(which, found, at)) == sorted(zip(rays, map(number.get, proxies.tolist()), entered))
    nearest = world.query_nearest(origins, 900)
    expected = [[number.get(each, -1) for each in row] for row in nearest.tolist()]
    assert index.query_nearest(origins, 900).tolist() == expected


def test_other_bytes_are_refused():
    saved = boxstream.BoxIndex(random_boxes(20, np.float64)).save()
    for wrong in (b"", b"boxindex", saved[:-1], saved + b"x", saved[:60] + bytes([saved[60] ^ 1]) + saved[61:]):
        with pytest.raises(ValueError):
            boxstream.BoxIndex.load(wrong)
    for same in (bytearray(saved), memoryview(saved), np.frombuffer(saved, np.uint8)):
        assert boxstream.BoxIndex.load(same).save() == saved


def test_arguments_are_those_of_searches():
    boxes = random_boxes(200, np.float64)
    with pytest.warns(boxstream.InvalidBoxesWarning, match="interleaved"):
        boxstream.BoxIndex(boxes[:, [0, 3, 1, 4, 2, 5]])
    with pytest.raises(ValueError, match="dimensions=2"):
        boxstream.BoxIndex(boxes[:, :4])
    with pytest.raises(ValueError, match="copy=False"):
        boxstream.BoxIndex(boxes.tolist(), copy=False)
    for integers in (np.int32, np.int64):
        with pytest.raises(ValueError, match=f"float64, as the index has, .* got {integers.__name__}, and copy=False"):
            boxstream.BoxIndex(boxes.astype(integers), copy=False)
    with pytest.raises(ValueError, match=r"boxes\[7\]"):
        boxes[7, 0] = np.nan
        boxstream.BoxIndex(boxes, invalid="raise")
    with pytest.raises(TypeError, match="as the index has"):
        boxstream.BoxIndex(boxes.astype(np.float32)).query_boxes(boxes)
    with pytest.raises(TypeError):
        boxstream.BoxIndex(np.array([[0, 0, 0, 2**60 + 1, 1, 1]]))


def test_threads_may_ask_at_once():
    boxes = random_boxes(20_000, np.float32)
    index = boxstream.BoxIndex(boxes)
    alone = index.query_boxes(boxes)
    assert len(alone) > len(boxes)
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(index.query_boxes(boxes))) for _ in range(4)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert len(answers) == 4 and all(np.array_equal(each, alone) for each in answers)
