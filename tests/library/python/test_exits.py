# SPDX-License-Identifier: MIT
"""The end of the interpreter: threads inside of calls do no harm, whatever the call and with an Executor too."""
import os
import subprocess
import sys

import pytest

# Each thread has its own objects, so that no call is refused; they are small, so that many calls return meanwhile.
SETUP = """
import atexit, sys, threading, time
import numpy as np
import boxstream
random = np.random.default_rng(3)
low = random.uniform(0, 12, (9000, 3))
boxes = np.hstack([low, low + 0.7])
points = low.copy()
offsets = np.arange(0, 9001, 50)
executor = boxstream.Executor(3) if sys.argv[1] == "threads" else None

class Own:
    def __init__(self):
        self.detector = boxstream.Detector(executor)
        self.world = boxstream.World("float64", executor)
        self.ids = self.world.create(boxes)
        self.world.update()
        self.turn = 0

    def again(self):
        self.turn += 1
        self.world.move(self.ids, boxes + self.turn % 7)
        self.world.update()
"""

CALLS = {
    "find_pairs": "own.detector.find_pairs(boxes)",
    "two_sets": "own.detector.find_pairs(boxes, boxes)",
    "many_sets": "own.detector.find_pairs_in_sets(boxes, offsets)",
    "stream_pairs": "own.detector.stream_pairs(boxes, lambda pairs: sum(range(50)), block=200)",
    "find_near_pairs": "own.detector.find_near_pairs(points, 0.4)",
    "stream_near_pairs": "own.detector.stream_near_pairs(points, 0.4, lambda pairs: None, block=100)",
    "function": "boxstream.find_pairs(boxes, executor=executor)",
    "invalid": "boxstream.find_pairs(boxes[:400], executor=executor, invalid='raise')",
    "update": "own.again()",
    "query_boxes": "own.world.query_boxes(boxes[:500])",
    "rays": "own.world.cast_rays(points[:500], points[:500], 0.1)",
    "nearest": "own.world.query_nearest(points[:500], 2)",
}

DAEMONS = SETUP + """
ready = [threading.Event() for _ in range(3)]

def work(event):
    own = Own()
    while True:
        {call}
        event.set()

for event in ready:
    threading.Thread(target=work, args=(event,), daemon=True).start()
for event in ready:
    event.wait()
print("main ends", flush=True)
"""


def run(code, *arguments):
    """Exit code and output of an interpreter of its own."""
    done = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, timeout=120,
                          env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("executor", ["none", "threads"])
@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_daemon_threads_end_with_the_process(call, executor):
    for _ in range(3):
        assert run(DAEMONS.format(call=call), executor) == (0, "main ends\n", "")


@pytest.mark.parametrize("executor", ["none", "threads"])
def test_other_threads_are_waited_for(executor):
    code = SETUP + """
def work():
    own = Own()
    for _ in range(20):
        own.detector.stream_pairs(boxes, lambda pairs: None, block=500)
        own.again()
    print("all done", flush=True)

threading.Thread(target=work).start()
print("main ends", flush=True)
"""
    assert run(code, executor) == (0, "main ends\nall done\n", "")


@pytest.mark.parametrize("executor", ["none", "threads"])
def test_an_atexit_function_may_search(executor):
    code = SETUP + """
def work():
    own = Own()
    while True:
        own.detector.stream_pairs(boxes, lambda pairs: None, block=300)

count = len(boxstream.find_pairs(boxes))
atexit.register(lambda: print(len(boxstream.find_pairs(boxes, executor=executor)) == count, flush=True))
threading.Thread(target=work, daemon=True).start()
time.sleep(0.1)
"""
    assert run(code, executor) == (0, "True\n", "")


@pytest.mark.parametrize("executor", ["none", "threads"])
def test_what_is_deleted_with_the_interpreter_may_search(executor):
    """Without daemon threads: their frames would keep it."""
    code = SETUP + """
boxstream.find_pairs(boxes)

class Last:
    def __del__(self, find=boxstream.find_pairs, boxes=boxes, executor=executor, say=print):
        say(len(find(boxes, executor=executor)) > 1000, flush=True)

last = Last()
"""
    assert run(code, executor) == (0, "True\n", "")


@pytest.mark.parametrize("executor", ["none", "threads"])
def test_sys_exit_in_a_callback(executor):
    code = SETUP + """
def leave(pairs):
    sys.exit(7)

{call}
"""
    call = "boxstream.stream_pairs(boxes, leave, block=300, executor=executor)"
    assert run(code.format(call=call), executor) == (7, "", "")
    thread = f"threading.Thread(target=lambda: {call}).start()"
    assert run(code.format(call=thread), executor) == (0, "", "")


@pytest.mark.parametrize("executor", ["none", "threads"])
def test_a_callback_may_end_the_process(executor):
    code = SETUP + "boxstream.stream_pairs(boxes, lambda pairs: __import__('os')._exit(5), block=300, executor=executor)"
    assert run(code, executor) == (5, "", "")


def test_a_subinterpreter_is_refused():
    pytest.importorskip("_xxsubinterpreters")
    code = """
import _xxsubinterpreters
try:
    _xxsubinterpreters.run_string(_xxsubinterpreters.create(), "import boxstream")
except _xxsubinterpreters.RunFailedError as error:
    print(error, flush=True)
"""
    assert run(code) == (0, "<class 'ImportError'>: boxstream: cannot be imported by a subinterpreter\n", "")
