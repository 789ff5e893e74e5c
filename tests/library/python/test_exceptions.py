# SPDX-License-Identifier: MIT
"""What callbacks raise ends where it is caught, with the frames that its traceback holds."""
import gc
import os
import signal
import weakref

import numpy as np
import pytest
from reference import random_boxes

import boxstream

BOXES = random_boxes(60000, np.float32, size=0.05)
POINTS = np.ascontiguousarray(BOXES[:, :3])
EXECUTORS = [None, boxstream.Executor(3)]


class Large:
    """Something that a frame holds."""


class Mine(Exception):
    pass


def raise_in(call, search):
    """Lets a callback raise in that call; returns a weak reference to a local of a frame of the traceback."""
    large = Large()
    seen, calls = weakref.ref(large), []

    def fail(pairs):
        calls.append(pairs)
        if len(calls) == call:
            raise Mine(large)

    with pytest.raises(Mine):
        search(fail)
    return seen


def gone(seen):
    gc.collect()
    return seen() is None


@pytest.mark.parametrize("executor", EXECUTORS, ids=["alone", "threads"])
@pytest.mark.parametrize("call", [1, 2, 7])
@pytest.mark.parametrize("search", [
    lambda detector, fail: detector.stream_pairs(BOXES, fail, block=100),
    lambda detector, fail: detector.stream_pairs(BOXES, fail, BOXES, block=100),
    lambda detector, fail: detector.stream_near_pairs(POINTS, 0.03, fail, block=100),
], ids=["one_set", "two_sets", "near"])
def test_of_a_stream(search, call, executor):
    detector = boxstream.Detector(executor)
    assert gone(raise_in(call, lambda fail: search(detector, fail)))
    assert len(detector.find_pairs(BOXES)) > 0


def test_of_a_stream_that_is_not_caught_by_a_search_within():
    """The inner search's exception passes through the outer one."""
    inner, outer = boxstream.Detector(EXECUTORS[1]), boxstream.Detector(EXECUTORS[1])
    assert gone(raise_in(2, lambda fail: outer.stream_pairs(
        BOXES, lambda _: inner.stream_pairs(BOXES, fail, block=100), block=100)))


def raise_by_signal(search):
    large = Large()
    seen = weakref.ref(large)

    def handle(*_):
        signal.setitimer(signal.ITIMER_REAL, 0)
        raise Mine(large)

    old = signal.signal(signal.SIGALRM, handle)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(Mine):
            search()
    finally:
        signal.signal(signal.SIGALRM, old)
        del handle
    return seen


@pytest.mark.parametrize("executor", EXECUTORS, ids=["alone", "threads"])
def test_of_a_signals_handler(executor):
    """8 * 10^8 pairs, and queries for as long."""
    crowd = np.zeros((40000, 6), np.float32)
    assert gone(raise_by_signal(lambda: boxstream.stream_pairs(crowd, lambda _: None, executor=executor)))
    assert gone(raise_by_signal(lambda: boxstream.stream_pairs(crowd, lambda _: None, block=10**9, executor=executor)))
    world = boxstream.World(executor=executor)
    world.create(crowd[:2000])
    many = np.zeros((10**6, 3), np.float32)
    assert gone(raise_by_signal(lambda: world.query_nearest(many, 100)))


def resident_megabytes():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_memory_does_not_grow():
    detectors = [boxstream.Detector(EXECUTORS[1]) for _ in range(30)]

    def fail_once(detector, size):
        def fail(pairs):
            block = np.ones(size)
            raise Mine(len(block))

        with pytest.raises(Mine):
            detector.stream_pairs(BOXES, fail, block=100)

    for detector in detectors:
        fail_once(detector, 1)  # they keep their scratch memory
    before = resident_megabytes()
    for detector in detectors:
        fail_once(detector, 10**6)  # 8 MB in the frame
    gc.collect()
    assert resident_megabytes() - before < 100
