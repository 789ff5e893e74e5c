# SPDX-License-Identifier: MIT
"""Forks: a child has one thread, and searches on, with the same Executor too."""
import contextlib
import multiprocessing
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from reference import random_boxes

import boxstream

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")

BOXES = random_boxes(30000, np.float32, size=0.05)
BLOCK = 500


@pytest.fixture(scope="module")
def executor():
    return boxstream.Executor(3)


@pytest.fixture(scope="module")
def alone():
    pairs = boxstream.find_pairs(BOXES)
    assert len(pairs) > 10 * BLOCK
    return pairs


def fork():
    """As os.fork, for a child that is not to hang."""
    child = os.fork()
    if child == 0:
        signal.alarm(60)
    return child


@contextlib.contextmanager
def ending(is_child):
    """A child ends here, with exit code 0 if all went well."""
    try:
        yield
    except BaseException:
        if is_child():
            os._exit(1)
        raise
    if is_child():
        os._exit(0)


def expect_right(child):
    assert os.waitpid(child, 0)[1] == 0


def in_child(search):
    """Calls it in a child, where it must return something true."""
    child = fork()
    with ending(lambda: child == 0):
        if child == 0:
            assert search()
    expect_right(child)


def finds_them(executor, alone, detector=None):
    detector = detector or boxstream.Detector(executor)
    return np.array_equal(detector.find_pairs(BOXES), alone)


def test_between_searches(executor, alone):
    detector = boxstream.Detector(executor)
    assert finds_them(executor, alone, detector)
    in_child(lambda: finds_them(executor, alone, detector) and finds_them(executor, alone) and executor.threads == 1)
    assert finds_them(executor, alone, detector) and executor.threads == 3


class Mine(Exception):
    pass


def answer(how):
    """What a callback does in parent and child after it has forked."""
    if how == "raise":
        raise Mine
    if how == "exit":
        sys.exit(3)
    return how != "stop"


@pytest.mark.parametrize("with_executor", [False, True])
@pytest.mark.parametrize("call", [1, 2, 6])
@pytest.mark.parametrize("how, ends_as", [("go_on", contextlib.nullcontext()), ("stop", contextlib.nullcontext()),
                                          ("raise", pytest.raises(Mine)), ("exit", pytest.raises(SystemExit))])
def test_in_a_callback(executor, alone, with_executor, call, how, ends_as):
    detector = boxstream.Detector(executor if with_executor else None)
    blocks, children = [], []

    def callback(pairs):
        blocks.append(pairs)
        if len(blocks) != call:
            return True
        children.append(fork())
        return answer(how)

    with ending(lambda: children == [0]):
        with ends_as:
            detector.stream_pairs(BOXES, callback, block=BLOCK)
        expected = alone if how == "go_on" else alone[:call * BLOCK]
        assert np.array_equal(np.concatenate(blocks), expected)
        assert finds_them(executor, alone, detector)
    expect_right(children[0])


def test_a_child_of_a_callback_may_leave_by_the_interpreters_end():
    code = """
import os, sys
import numpy as np
import boxstream
low = np.random.default_rng(2).uniform(0, 20, (30000, 3))
executor = boxstream.Executor(3)
world = boxstream.World("float64", executor)
children = []
def callback(pairs):
    if not children:
        children.append(os.fork())
        if children == [0]:
            sys.exit(9)
boxstream.stream_pairs(np.hstack([low, low + 0.5]), callback, block=400, executor=executor)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(children[0], 0)[1]) - 9)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120,
                         env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


@contextlib.contextmanager
def searching(search):
    """Another thread searches again and again meanwhile."""
    done, begun, failed = threading.Event(), threading.Event(), []

    def work():
        try:
            while not done.is_set():
                search()
                begun.set()
        except BaseException as error:
            failed.append(error)
            begun.set()

    thread = threading.Thread(target=work)
    thread.start()
    begun.wait()
    try:
        yield
    finally:  # a failure of what is tested ends the thread too
        done.set()
        thread.join()
    assert not failed


def is_refused_or(search):
    """What was in use at the fork stays in use in the child."""
    try:
        return search()
    except RuntimeError as error:
        return "in use" in str(error)


@pytest.mark.parametrize("block", [10**7, 300])
def test_while_another_thread_searches(executor, alone, block):
    detector = boxstream.Detector(executor)
    with searching(lambda: detector.stream_pairs(BOXES, lambda pairs: None, block=block)):
        for _ in range(10):
            in_child(lambda: finds_them(executor, alone))
            in_child(lambda: is_refused_or(lambda: finds_them(executor, alone, detector)))


def test_while_another_thread_updates_a_world(executor, alone):
    world = boxstream.World(executor=executor)
    ids = world.create(BOXES)

    def update():
        world.move(ids, BOXES + np.float32(1))
        world.update()
        world.move(ids, BOXES)
        world.update()

    def fresh():
        other = boxstream.World(executor=executor)
        other.create(BOXES)
        return other.update().pairs == len(alone)

    with searching(update):
        for _ in range(10):
            in_child(fresh)
            in_child(lambda: is_refused_or(lambda: world.update() is not None))


GLOBAL = boxstream.Executor(2)


def count_pairs(threads):
    return len(boxstream.find_pairs(BOXES, executor=GLOBAL if threads else None))


def test_a_pool_of_processes_with_an_executor_of_the_module(alone):
    assert count_pairs(True) == len(alone)
    with multiprocessing.get_context("fork").Pool(3) as pool:
        assert pool.map(count_pairs, [True, False] * 6) == [len(alone)] * 12
