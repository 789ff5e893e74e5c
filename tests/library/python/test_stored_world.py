# SPDX-License-Identifier: MIT
"""Worlds as bytes, and pickled."""
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference import DTYPES, random_boxes

import boxstream


def same(a, b, ids):
    assert len(a) == len(b) and a.dtype == b.dtype
    live = a.contains(ids)
    assert np.array_equal(live, b.contains(ids))
    ids = ids[live]
    assert np.array_equal(a.boxes(ids), b.boxes(ids), equal_nan=True)
    assert np.array_equal(a.users(ids), b.users(ids))
    for what in ("pairs", "begun", "ended", "bounds"):
        assert np.array_equal(getattr(a, what), getattr(b, what)), what


@given(st.sampled_from(DTYPES), st.booleans(), st.lists(st.tuples(
    st.sampled_from(["create", "move", "destroy", "filter", "update"]), st.integers(0, 2**20)), max_size=40))
def test_a_loaded_world_goes_on(dtype, sticky, history):
    world = boxstream.World(dtype, sticky_filters=sticky)
    ids = np.zeros(0, np.uint64)
    boxes = random_boxes(64, dtype, size=0.6)
    boxes[::9, 0] = np.nan

    def act(world, what, seed):
        random = np.random.default_rng(seed)
        count = random.integers(0, 12)
        some = ids[random.integers(0, len(ids), count)] if len(ids) else ids
        rows = boxes[random.integers(0, 64, count if what == "create" else len(some))]
        if what == "create":
            return world.create(rows, groups=random.integers(0, 4, count), users=random.integers(-5, 5, count))
        if what == "move":
            world.move(some, rows)
        elif what == "destroy":
            world.destroy(some)
        elif what == "filter":
            world.set_filters(some, groups=random.integers(0, 4, len(some)))
        else:
            world.update()

    for what, seed in history:
        new = act(world, what, seed)
        if what == "create":
            ids = np.concatenate([ids, new])
    if history and history[-1][0] != "update":
        world.update()
    loaded = pickle.loads(pickle.dumps(world))
    same(world, loaded, ids)
    for what, seed in [("update", 0), ("move", 1), ("filter", 2), ("update", 0), ("destroy", 3), ("update", 0)]:
        act(world, what, seed)
        act(loaded, what, seed)
        if what == "update":
            same(world, loaded, ids)
    # What is created now has ids that neither has had.
    assert not np.isin(loaded.create(boxes), ids).any()


def test_many_proxies_and_a_slot_that_was_used_often():
    world = boxstream.World("float64")
    ids = world.create(random_boxes(20_000, np.float64, size=0.02), users=np.arange(20_000))
    for _ in range(300):
        world.destroy(ids[5:7])
        ids[5:7] = world.create(random_boxes(2, np.float64))
    world.update()
    saved = world.save()
    loaded = boxstream.World.load(saved, boxstream.Executor(2))
    same(world, loaded, ids)
    assert loaded.save() == saved


def test_changes_since_the_last_update_are_refused():
    world = boxstream.World()
    pickle.dumps(world)
    ids = world.create(random_boxes(9, np.float32))
    for change in (lambda: None, lambda: world.move(ids[:1], random_boxes(1, np.float32, seed=7)),
                   lambda: world.set_filters(ids, groups=np.full(9, 2)), lambda: world.destroy(ids[3:])):
        change()
        with pytest.raises(RuntimeError, match="after update"):
            world.save()
        world.update()
        pickle.dumps(world)
    world.clear()
    assert len(pickle.loads(pickle.dumps(world))) == 0


def test_other_bytes_are_refused():
    world = boxstream.World()
    world.create(random_boxes(30, np.float32, size=0.5))
    world.update()
    saved = world.save()
    for wrong in (b"", saved[:79], saved[:-4], saved + b"xxxx", *(
            saved[:i] + bytes([saved[i] ^ 64]) + saved[i + 1:] for i in range(0, len(saved), 7))):
        with pytest.raises(ValueError):
            boxstream.World.load(wrong)
