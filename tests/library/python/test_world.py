# SPDX-License-Identifier: MIT
"""World against a dictionary of boxes and NumPy."""
import threading

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule
from reference import DTYPES, accepted, as_set, bit_arrays, box_arrays, pairs_of, random_boxes, touching

import boxstream


class Histories(RuleBasedStateMachine):
    """Any sequence of changes, updates and queries."""

    dtype = np.float32

    def __init__(self):
        super().__init__()
        self.world = boxstream.World(self.dtype)
        self.model = {}  # id: (box, group, mask), in order of creation
        self.gone = []
        self.held = set()

    def boxes(self):
        rows = [box for box, _, _ in self.model.values()]
        return np.array(rows, self.dtype).reshape(len(rows), 6)

    def ids(self):
        return np.array(list(self.model), np.uint64)

    def some_of(self, data, ids):
        chosen = data.draw(st.lists(st.sampled_from(ids), max_size=4, unique=True)) if ids else []
        return np.array(chosen, np.uint64)

    @rule(data=st.data())
    def create(self, data):
        boxes = data.draw(box_arrays(self.dtype, most=6))
        groups, masks = data.draw(bit_arrays(len(boxes))), data.draw(bit_arrays(len(boxes)))
        ids = self.world.create(boxes, groups, masks)
        assert ids.dtype == np.uint64 and ids.shape == (len(boxes),) and 0 not in ids
        for row in zip(ids, boxes, groups, masks):
            assert int(row[0]) not in self.model
            self.model[int(row[0])] = row[1:]

    @rule()
    def shrink_to_fit(self):
        self.world.shrink_to_fit()

    @rule(data=st.data())
    def move(self, data):
        ids = np.concatenate([self.some_of(data, list(self.model)), self.some_of(data, self.gone)])
        boxes = data.draw(box_arrays(self.dtype, most=8))[: len(ids)]
        ids = ids[: len(boxes)]
        live = 0
        for proxy, box in zip(ids, boxes):
            if int(proxy) in self.model:
                self.model[int(proxy)] = (box, *self.model[int(proxy)][1:])
                live += 1
        assert self.world.move(ids, np.ascontiguousarray(boxes)) == live

    @rule(data=st.data())
    def destroy(self, data):
        ids = np.concatenate([self.some_of(data, list(self.model)), self.some_of(data, self.gone)])
        live = [int(proxy) for proxy in ids if int(proxy) in self.model]
        assert self.world.destroy(ids) == len(live)
        for proxy in live:
            del self.model[proxy]
        self.gone += live

    @rule(data=st.data())
    def set_filters(self, data):
        ids = self.some_of(data, list(self.model))
        masks = data.draw(bit_arrays(len(ids)))
        assert self.world.set_filters(ids, masks=masks) == len(ids)
        for proxy, mask in zip(ids, masks):
            self.model[int(proxy)] = (self.model[int(proxy)][0], np.uint32(1), mask)

    def expected(self):
        boxes, ids = self.boxes(), self.ids()
        groups = np.array([group for _, group, _ in self.model.values()], np.uint32)
        masks = np.array([mask for _, _, mask in self.model.values()], np.uint32)
        matrix = np.triu(touching(boxes, boxes) & accepted(groups, masks, groups, masks), 1)
        return [(int(ids[i]), int(ids[j])) for i, j in np.argwhere(matrix)]

    @rule()
    def update(self):
        expected = self.expected()
        stats = self.world.update()
        assert [tuple(pair) for pair in self.world.pairs.tolist()] == expected
        assert as_set(self.world.begun) == set(expected) - self.held
        assert as_set(self.world.ended) == self.held - set(expected)
        assert (stats.pairs, stats.begun, stats.ended) == (
            len(expected), len(self.world.begun), len(self.world.ended))
        self.held = set(expected)

    @rule()
    def clear(self):
        self.world.clear()
        self.model, self.gone, self.held = {}, [], set()

    @rule(data=st.data())
    def query_boxes(self, data):
        asked = data.draw(box_arrays(self.dtype, most=3))
        queries, found = self.world.query_boxes(asked)
        ids = self.ids()
        expected = {(i, int(ids[j])) for i, j in pairs_of(touching(asked, self.boxes()))}
        assert as_set(zip(queries, found)) == expected
        assert (np.diff(queries) >= 0).all()

    @precondition(lambda self: self.model)
    @rule()
    def bounds(self):
        boxes = self.boxes()
        boxes = boxes[(boxes[:, :3] <= boxes[:, 3:]).all(axis=1)]
        bounds = self.world.bounds
        if len(boxes):
            assert np.array_equal(bounds, np.concatenate([boxes[:, :3].min(axis=0), boxes[:, 3:].max(axis=0)]))
        else:
            assert not (bounds[:3] <= bounds[3:]).all()

    @invariant()
    def contents(self):
        assert len(self.world) == len(self.model)
        assert self.world.contains(self.ids()).all()
        assert not self.world.contains(np.array(self.gone + [0], np.uint64)).any()
        assert np.array_equal(self.world.boxes(self.ids()), self.boxes(), equal_nan=True)


class HistoriesOfDoubles(Histories):
    dtype = np.float64


Histories.TestCase.settings = settings(max_examples=40, stateful_step_count=30, deadline=None)
HistoriesOfDoubles.TestCase.settings = Histories.TestCase.settings
TestHistories = Histories.TestCase
TestHistoriesOfDoubles = HistoriesOfDoubles.TestCase


@pytest.fixture(params=DTYPES)
def filled(request):
    boxes = random_boxes(2000, request.param)
    world = boxstream.World(request.param, executor=boxstream.Executor(2))
    return world, boxes, world.create(boxes, users=np.arange(2000, dtype=np.uint64) * 10)


def test_many_boxes_move(filled):
    world, boxes, ids = filled
    for step in range(5):
        assert world.move(ids, boxes) == 2000
        world.update()
        index = np.searchsorted(ids, world.pairs)
        assert np.array_equal(ids[index], world.pairs)
        assert as_set(index) == pairs_of(np.triu(touching(boxes, boxes), 1)) and len(index) > 100
        boxes = boxes + np.full((2000, 1), 0.001 * step, boxes.dtype) * (np.arange(2000)[:, None] % 2)
        boxes = boxes.astype(world.dtype)


def test_users(filled):
    world, _, ids = filled
    world.update()
    numbers = world.users(world.begun)
    assert numbers.shape == world.begun.shape and np.array_equal(world.users(ids), np.arange(2000) * 10)
    assert np.array_equal(numbers, np.searchsorted(ids, world.begun) * 10)


def slab_enter(boxes, origin, direction):
    """Where a ray enters each box, infinite where it does not. By doubles; the direction has no zeros."""
    near = (boxes[:, :3] - origin) / direction
    far = (boxes[:, 3:] - origin) / direction
    enter = np.minimum(near, far).max(axis=1).clip(0)
    leave = np.maximum(near, far).min(axis=1)
    return enter, leave


def test_rays(filled):
    world, boxes, ids = filled
    generator = np.random.default_rng(5)
    origins = generator.random((50, 3)).astype(world.dtype)
    directions = (generator.random((50, 3)) - 0.5).astype(world.dtype)
    rays, found, enters = world.query_rays(origins, directions, 0.7)
    first, at = world.cast_rays(origins, directions, np.full(50, 0.7, world.dtype))
    tolerance = 1e-5 if world.dtype == np.float32 else 1e-12
    seen = 0
    for ray in range(50):
        enter, leave = slab_enter(boxes.astype(float), origins[ray].astype(float), directions[ray].astype(float))
        surely = (enter < leave - tolerance) & (enter < 0.7 - tolerance)
        surely_not = (enter > leave + tolerance) | (enter > 0.7 + tolerance)
        hit = np.zeros(len(boxes), bool)
        index = np.searchsorted(ids, found[rays == ray])
        hit[index] = True
        assert len(index) == len(set(index)) and hit[surely].all() and not hit[surely_not].any()
        assert np.allclose(enters[rays == ray], enter[index], atol=10 * tolerance)
        if hit.any():
            assert at[ray] == enters[rays == ray].min()
            assert first[ray] in found[rays == ray][enters[rays == ray] == at[ray]]
        else:
            assert first[ray] == 0 and at[ray] == np.inf
        seen += hit.sum()
    assert seen > 50 and (first == 0).any()


def test_a_ray_without_length_has_no_end():
    world = boxstream.World()
    ids = world.create(np.array([[1e9, -1, -1, 2e9, 1, 1]], np.float32))
    origin, direction = np.zeros((1, 3), np.float32), np.array([[1, 0, 0]], np.float32)
    assert world.cast_rays(origin, direction)[0].tolist() == ids.tolist()
    assert world.cast_rays(origin, direction)[1].tolist() == [1e9]
    assert world.cast_rays(origin, direction, 5)[0].tolist() == [0]
    assert world.cast_rays(origin, -direction)[0].tolist() == [0]


@pytest.mark.parametrize("length", [-np.inf, -1, -1e-45, -1e-50, -5e-324])
def test_a_ray_of_negative_length_meets_nothing(length):
    """As a float it may be -0."""
    box = np.array([[-1, -1, -1, 1, 1, 1]], np.float32)
    world, index = boxstream.World(), boxstream.BoxIndex(box)
    ids = world.create(box)
    origin, direction = np.zeros((1, 3), np.float32), np.array([[1, 0, 0]], np.float32)
    assert world.cast_rays(origin, direction, length)[0].tolist() == [0]
    assert index.cast_rays(origin, direction, length)[0].tolist() == [-1]
    for zero in (0, -0.0):
        assert world.cast_rays(origin, direction, zero)[0].tolist() == ids.tolist()
        assert index.cast_rays(origin, direction, zero)[0].tolist() == [0]


def test_a_length_is_not_shortened():
    """The float nearest to 2.3 is below it."""
    face = np.nextafter(np.float32(2.3), np.float32(3))
    box = np.array([[face, -1, -1, 4, 1, 1]], np.float32)
    world, index = boxstream.World(), boxstream.BoxIndex(box)
    ids = world.create(box)
    origin, direction = np.zeros((1, 3), np.float32), np.array([[1, 0, 0]], np.float32)
    for asked, found in (world, ids[0]), (index, 0):
        assert [each.tolist() for each in asked.cast_rays(origin, direction, 2.3)] == [[found], [face]]
        assert asked.query_rays(origin, direction, float(np.float32(2.3)))[1].tolist() == []


def test_nearest(filled):
    world, boxes, ids = filled
    points = (2 * np.random.default_rng(6).random((40, 3)) - 0.5).astype(world.dtype)
    found = world.query_nearest(points, 7)
    assert found.shape == (40, 7)
    exact = boxes.astype(np.longdouble)
    for point, row in zip(points.astype(np.longdouble), found):
        gap = np.maximum(0, np.maximum(exact[:, :3] - point, point - exact[:, 3:]))
        distances = (gap**2).sum(axis=1)
        assert np.array_equal(ids[np.argsort(distances, kind="stable")[:7]], row)


def test_fewer_than_asked_for():
    world = boxstream.World("float64")
    ids = world.create(np.array([[0.0, 0, 0, 1, 1, 1], [5, 5, 5, 6, 6, 6], [np.nan] * 6]))
    assert world.query_nearest(np.array([[7.0, 7, 7]]), 4).tolist() == [[ids[1], ids[0], 0, 0]]
    assert world.query_nearest(np.zeros((0, 3)), 4).shape == (0, 4)
    assert world.query_nearest(np.zeros((2, 3)), 0).shape == (2, 0)


def test_sticky_filters():
    boxes = np.zeros((2, 6), np.float32)
    for sticky, held in ((False, 0), (True, 1)):
        world = boxstream.World(sticky_filters=sticky)
        ids = world.create(boxes)
        assert world.update().begun == 1
        world.set_filters(ids, masks=np.zeros(2, np.uint32))
        assert world.update().pairs == held


def test_results_are_the_callers():
    world = boxstream.World()
    ids = world.create(np.zeros((3, 6), np.float32))
    world.update()
    begun, pairs = world.begun, world.pairs
    world.destroy(ids)
    world.update()
    assert len(begun) == len(pairs) == 3 and len(world.begun) == 0 and len(world.ended) == 3
    del world
    assert len({tuple(pair) for pair in begun.tolist()}) == 3


def test_queries_of_several_threads_and_changes_alone():
    boxes = random_boxes(20000, np.float32)
    world = boxstream.World()
    ids = world.create(boxes)
    expected = world.query_boxes(boxes)
    results, refused = [], []

    def query():
        while True:
            try:
                return results.append(world.query_boxes(boxes))
            except RuntimeError:
                pass

    threads = [threading.Thread(target=query) for _ in range(3)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        try:
            world.move(ids, boxes)
        except RuntimeError as error:
            refused.append(str(error))
    for thread in threads:
        thread.join()
    assert len(results) == 3
    for result in results:
        assert all(np.array_equal(np.sort(a), np.sort(b)) for a, b in zip(result, expected))
    assert set(refused) == {"this World is in use, by another thread, by the caller's own callback, or by a search that "
                            "was left and goes on"}
