# SPDX-License-Identifier: MIT
"""Streams: blocks, stopping, exceptions, Ctrl-C, and other threads meanwhile."""
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from reference import random_boxes

import boxstream


@pytest.mark.parametrize("block", [1, 7, 1000, 10**9])
def test_blocks(block):
    boxes = random_boxes(700, np.float32)
    blocks = []
    count = boxstream.stream_pairs(boxes, blocks.append, block=block)
    expected = boxstream.find_pairs(boxes)
    assert count == len(expected) > 100
    assert np.array_equal(np.concatenate(blocks), expected)
    assert all(len(each) == block for each in blocks[:-1]) and 0 < len(blocks[-1]) <= block


def test_two_sets_and_filters():
    boxes, other = random_boxes(500, np.float64, 1), random_boxes(400, np.float64, 2)
    groups = (np.arange(500, dtype=np.uint32) % 4, None)
    blocks = []
    boxstream.stream_pairs(boxes, blocks.append, other, groups)
    expected = boxstream.find_pairs(boxes, other, groups)
    assert len(expected) > 50 and np.array_equal(np.concatenate(blocks), expected)


def test_no_call_without_pairs():
    assert boxstream.stream_pairs(np.zeros((0, 6)), lambda pairs: pytest.fail("called")) == 0


def test_false_stops():
    boxes = random_boxes(1000, np.float32, size=0.5)
    calls = []
    count = boxstream.stream_pairs(boxes, lambda pairs: (calls.append(pairs), len(calls) < 3)[1], block=50)
    assert len(calls) == 3 and count == 150
    assert np.array_equal(np.concatenate(calls), boxstream.find_pairs(boxes)[:150])


def test_only_false_itself_stops():
    boxes = random_boxes(1000, np.float32, size=0.5)
    assert boxstream.stream_pairs(boxes, lambda pairs: 0, block=50) == len(boxstream.find_pairs(boxes))


def test_an_exception_passes_through():
    class Mine(Exception):
        pass

    def fail(pairs):
        raise Mine("here")

    detector = boxstream.Detector()
    boxes = random_boxes(1000, np.float32)
    with pytest.raises(Mine, match="here"):
        detector.stream_pairs(boxes, fail)
    assert np.array_equal(detector.find_pairs(boxes), boxstream.find_pairs(boxes))


def test_a_detector_refuses_a_second_use():
    detector = boxstream.Detector()
    boxes = random_boxes(300, np.float32)
    with pytest.raises(RuntimeError, match="this Detector is in use"):
        detector.stream_pairs(boxes, lambda pairs: detector.find_pairs(boxes))


CROWD = """
import os, signal, sys, threading, time
import numpy as np
import boxstream
boxes = np.zeros((400000, 6), np.float32)
boxes[:, 3:] = 1
"""

# 8 * 10^10 pairs take minutes.
INTERRUPTED = CROWD + """
world = boxstream.World()
world.create(boxes)
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
begin = time.monotonic()
try:
    %s
    sys.exit("not interrupted")
except KeyboardInterrupt:
    print(time.monotonic() - begin)
"""


def ends_soon(statement):
    """A KeyboardInterrupt, sent after half a second, comes out of the statement before two, once of three times."""
    for _ in range(3):  # other work on the machine may come between
        seconds = interrupted(statement)
        assert seconds > 0.4
        if seconds < 2:
            return True
    return False


def interrupted(statement):
    """Seconds until a KeyboardInterrupt came out of the statement."""
    run = subprocess.run([sys.executable, "-c", INTERRUPTED % statement], capture_output=True, text=True, timeout=100,
                         env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert run.returncode == 0, run.stderr
    return float(run.stdout)


@pytest.mark.parametrize("block", [65536, 10**8])
@pytest.mark.parametrize("executor", ["None", "boxstream.Executor(2)"])
def test_a_keyboard_interrupt_stops_a_stream(block, executor):
    call = f"boxstream.stream_pairs(boxes, lambda pairs: None, block={block}, executor={executor})"
    assert ends_soon(call)


def test_a_keyboard_interrupt_stops_queries():
    assert ends_soon("world.query_nearest(boxes[:, :3].copy(), 100)")


def progress_during(search):
    """How often another Python thread got to run during a search."""
    ticks, done = [0], threading.Event()

    def tick():
        while not done.is_set():
            ticks[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=tick)
    other.start()
    while ticks[0] == 0:
        time.sleep(0.001)
    before = ticks[0]
    search()
    after = ticks[0]
    done.set()
    other.join()
    return after - before


@pytest.mark.parametrize("count", [150_000, 200_000])  # the latter are enough for a thread of the search
def test_other_threads_run_during_a_search(count):
    boxes = random_boxes(count, np.float64, size=0.05)
    world = boxstream.World("float64")
    world.create(boxes)
    assert progress_during(lambda: boxstream.find_pairs(boxes)) > 5
    assert progress_during(lambda: boxstream.find_near_pairs(boxes[:, :3].copy(), 0.02)) > 5
    assert progress_during(world.update) > 5
    assert progress_during(lambda: world.query_boxes(boxes)) > 5


@pytest.mark.skipif(not hasattr(signal, "raise_signal"), reason="needs signal.raise_signal")
def test_a_handler_that_does_not_raise_lets_the_stream_go_on():
    boxes = random_boxes(1000, np.float32, size=0.5)
    seen = []
    old = signal.signal(signal.SIGUSR1, lambda *_: seen.append(True))
    try:
        count = boxstream.stream_pairs(boxes, lambda pairs: signal.raise_signal(signal.SIGUSR1), block=1000)
    finally:
        signal.signal(signal.SIGUSR1, old)
    assert seen and count == len(boxstream.find_pairs(boxes))
