# SPDX-License-Identifier: MIT
"""Threads: the same results, shared by searches."""
import os
import threading

import numpy as np
import pytest
from reference import random_boxes

import boxstream


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_same_pairs_in_the_same_order(threads):
    boxes = random_boxes(50000, np.float32, size=0.05)
    alone = boxstream.find_pairs(boxes)
    executor = boxstream.Executor(threads)
    assert executor.threads == threads and repr(executor) == f"boxstream.Executor(threads={threads})"
    assert len(alone) > 10000
    assert np.array_equal(boxstream.find_pairs(boxes, executor=executor), alone)
    blocks = []
    boxstream.stream_pairs(boxes, blocks.append, executor=executor)
    assert np.array_equal(np.concatenate(blocks), alone)


def test_as_many_threads_as_the_process_may_use():
    assert boxstream.Executor().threads == len(os.sched_getaffinity(0))


def test_one_executor_for_searches_at_the_same_time():
    boxes = random_boxes(30000, np.float32, size=0.05)
    alone = boxstream.find_pairs(boxes)
    executor = boxstream.Executor(3)
    right = []

    def search():
        for _ in range(5):
            right.append(np.array_equal(boxstream.find_pairs(boxes, executor=executor), alone))

    threads = [threading.Thread(target=search) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert right == [True] * 20


def test_a_search_within_a_callback():
    boxes = random_boxes(20000, np.float32, size=0.05)
    executor = boxstream.Executor(2)
    alone = boxstream.find_pairs(boxes)
    inner = []
    boxstream.stream_pairs(boxes, lambda _: inner.append(boxstream.find_pairs(boxes, executor=executor)),
                           executor=executor, block=len(alone) // 2)
    assert len(inner) >= 2 and all(np.array_equal(each, alone) for each in inner)


def test_an_executor_lives_as_long_as_what_uses_it():
    detector = boxstream.Detector(boxstream.Executor(2))
    world = boxstream.World(executor=boxstream.Executor(2))
    boxes = random_boxes(20000, np.float32)
    world.create(boxes)
    assert world.update().pairs == len(detector.find_pairs(boxes)) > 0
