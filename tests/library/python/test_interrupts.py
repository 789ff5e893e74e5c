# SPDX-License-Identifier: MIT
"""Ctrl-C has its effect within a fifth of a second, where no pairs are found, too."""
import os
import signal
import time

import numpy as np
import pytest

import boxstream

def grid(count):
    """Boxes of a grid, in no order, that do not touch."""
    side = round(count ** (1 / 3)) + 1
    place = np.random.default_rng(1).permutation(count)
    low = np.stack([place % side, place // side % side, place // side**2], axis=1).astype(np.float32) * 2
    return np.hstack([low, low + 1])


@pytest.fixture(scope="module")
def apart():
    """So many that a search of them takes longer than an alarm takes to come."""
    count = 3_000_000
    while True:
        boxes = grid(count)
        begin = time.monotonic()
        boxstream.find_pairs(boxes)
        if time.monotonic() - begin > 0.15:
            return boxes
        count *= 2


def interrupted(call):
    """Seconds from an alarm, whose handler raises, until the call is left; None if it ended before."""
    rung = []

    def handle(*_):
        rung.append(time.monotonic())
        raise KeyboardInterrupt

    old = signal.signal(signal.SIGALRM, handle)
    begin = time.monotonic()
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.06)
        call()
    except KeyboardInterrupt:
        return time.monotonic() - begin - 0.06
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)
    return None


def when_free(call):
    """What `call` returns as soon as its object is not in use."""
    for _ in range(1000):
        try:
            return call()
        except RuntimeError as error:
            assert "in use" in str(error)
            time.sleep(0.02)
    raise AssertionError("it stays in use")


def calls(boxes):
    world = boxstream.World()
    world.create(boxes)
    detector = boxstream.Detector()
    index = boxstream.BoxIndex(boxes[:1000])
    return {
        "find_pairs": lambda: boxstream.find_pairs(boxes),
        "find_pairs, two sets": lambda: boxstream.find_pairs(boxes, boxes + np.float32(0.6), closed=False),
        "hybrid": lambda: boxstream.Detector(method="hybrid").find_pairs(boxes),
        "threads": lambda: boxstream.find_pairs(boxes, executor=boxstream.Executor(2)),
        "find_neighbours": lambda: detector.find_neighbours(boxes),
        "find_pairs_in_sets": lambda: boxstream.find_pairs_in_sets(boxes, [0, 1, len(boxes)]),
        "find_near_pairs": lambda: boxstream.find_near_pairs(boxes[:, :3].copy(), 0.5),
        "BoxIndex": lambda: boxstream.BoxIndex(boxes),
        "query_boxes": lambda: index.query_boxes(boxes),
        "update": world.update,
    }


def test_every_search_is_left_at_once(apart):
    left = 0
    for name, call in calls(apart).items():
        for _ in range(10):  # other work on the machine may come between
            seconds = interrupted(call)
            if name in ("update", "find_neighbours"):
                time.sleep(1.5)  # the object is in use until then
            if seconds is None or seconds < 0.2:
                break
        else:
            raise AssertionError(f"{name} went on for {seconds} s")
        left += seconds is not None
    assert left >= 4


def test_what_was_left_ends_and_serves_again(apart):
    """An interrupted search ends later, on its own thread. Its detector is in use until then."""
    detector = boxstream.Detector()
    assert interrupted(lambda: detector.find_neighbours(apart)) is not None
    assert len(when_free(lambda: detector.find_pairs(apart[:10]))) == 0 and detector.stats.boxes == 10


def crowded(count, others=0):
    """A World of boxes in one place, and of others, before its first update."""
    world = boxstream.World()
    world.create(np.zeros((count, 6), np.float32))
    world.create(grid(others))
    return world


def test_few_boxes_with_many_pairs_are_left_while_they_go_on():
    crowd, detector, world = np.zeros((8000, 6), np.float32), boxstream.Detector(), crowded(5500, 20_000)
    for call, use in [(lambda: detector.find_neighbours(crowd), lambda: detector.scratch_bytes),
                      (lambda: detector.find_pairs_in_sets(crowd, [0, 8000]), lambda: detector.scratch_bytes),
                      (world.update, lambda: len(world))]:
        assert interrupted(call) is not None
        with pytest.raises(RuntimeError, match="in use"):
            use()
        when_free(use)


def handled_during(call):
    """How many signals of a timer Python handles until the call has returned, and what it returns."""
    rung = []
    old = signal.signal(signal.SIGALRM, lambda *_: rung.append(time.monotonic()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
        result = call()
        return len(rung), result
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_signals_are_handled_while_a_world_is_saved_and_loaded():
    world = crowded(3000)
    world.update()
    count, saved = handled_during(world.save)  # 144 MB, of which each byte is in a sum
    assert count >= 2
    count, loaded = handled_during(lambda: boxstream.World.load(saved))
    assert count >= 2 and len(loaded) == 3000


def test_what_is_thrown_apart_passes_through(apart):
    with pytest.raises(MemoryError, match="more pairs than max_pairs=7"):
        boxstream.find_pairs(apart[:300_000], tolerance=1.0, max_pairs=7)
    with pytest.raises(ValueError):
        boxstream.find_pairs_in_sets(apart[:300_000], [0, 5])


def test_a_search_that_was_left_finds_no_more_pairs():
    crowd = np.zeros((250_000, 6), np.float32)  # 3 * 10^10 pairs take minutes, and more memory than there is
    detector = boxstream.Detector()
    assert interrupted(lambda: detector.find_pairs(crowd)) is not None
    end = time.monotonic() + 5
    while True:
        try:
            detector.find_pairs(crowd[:10])
            break
        except RuntimeError:
            assert time.monotonic() < end
            time.sleep(0.02)


def test_a_handler_that_forks(apart):
    """The parent's search goes on; the child, which has no thread that searches, gets an exception."""
    children = []
    old = signal.signal(signal.SIGALRM, lambda *_: children.append(os.fork()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.06)
        try:
            pairs = boxstream.Detector(method="hybrid").find_pairs(apart)  # which takes longer
        except RuntimeError as error:
            goes_on = len(boxstream.find_pairs(apart[:10])) == 0
            os._exit(7 if "forked" in str(error) and children == [0] and goes_on else 8)
        if children == [0]:
            os._exit(9)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)
    assert len(pairs) == 0
    if children:  # the alarm came in time
        assert os.waitstatus_to_exitcode(os.waitpid(children[0], 0)[1]) == 7


def test_a_child_after_a_search_that_was_left(apart):
    """It has no thread of the search, and lets go of what that used."""
    detector = boxstream.Detector()
    assert interrupted(lambda: detector.find_neighbours(apart)) is not None
    time.sleep(1.5)  # until it has ended; no later call has let go of it
    child = os.fork()
    if child == 0:
        signal.alarm(60)  # a child is not to hang
        try:
            os._exit(7 if len(detector.find_pairs(apart[:10])) == 0 else 8)
        except RuntimeError as error:  # a slow machine: what was in use at the fork stays in use
            os._exit(7 if "in use" in str(error) else 9)
        finally:
            os._exit(10)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    assert len(when_free(lambda: detector.find_pairs(apart[:10]))) == 0
