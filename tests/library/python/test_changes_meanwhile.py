# SPDX-License-Identifier: MIT
"""Arrays that another thread changes during a call: results may be wrong, but no memory is touched that is not theirs."""
import os
import subprocess
import sys

import pytest

SETUP = """
import sys, threading, time
import numpy as np
import boxstream

n, m = 60000, 20000
random = np.random.default_rng(5)
low = random.uniform(0, 30, (n, 3))
boxes = np.hstack([low, low + 0.6])
offsets = np.linspace(0, n, m + 1).astype(np.uint64)
world = boxstream.World("float64")
ids = world.create(boxes)
groups = np.ones(n, np.uint32)
masks = np.ones(n, np.uint32)
users = np.zeros(n, np.uint64)
executor = {executor}
detector = boxstream.Detector(executor)

def flip(array, values):
    \"\"\"Copies them in turn without the interpreter's lock.\"\"\"
    def work():
        while True:
            for value in values:
                np.copyto(array, value)
    threading.Thread(target=work, daemon=True).start()

sys.setswitchinterval(1e-4)
end = time.monotonic() + 1
"""

WRONG_IDS = "[ids.copy(), random.integers(0, 2**63, n).astype(np.uint64), np.full(n, 2**33 - 1, np.uint64)]"
CASES = {
    "offsets": ("offsets, [offsets.copy(), random.integers(0, 2**63, m + 1).astype(np.uint64), offsets[::-1].copy()]",
                "detector.find_pairs_in_sets(boxes, offsets)"),
    "offsets_of_two": ("offsets, [offsets.copy(), np.full(m + 1, 2**40, np.uint64)]",
                       "detector.find_pairs_in_sets(boxes, offsets, boxes, offsets)"),
    "ids_moved": (f"ids, {WRONG_IDS}", "world.move(ids, boxes)"),
    "ids_read": (f"ids, {WRONG_IDS}", "world.boxes(ids)"),
    "ids_of_users": (f"ids, {WRONG_IDS}", "world.users(ids)"),
    "ids_filtered": (f"ids, {WRONG_IDS}", "world.set_filters(ids, groups, masks)"),
    "groups": ("groups, [np.uint32(1), random.integers(0, 2**32, n).astype(np.uint32)]",
               "detector.find_pairs(boxes, groups=groups, masks=masks)"),
    "masks_of_two": ("masks, [np.uint32(1), random.integers(0, 2**32, n).astype(np.uint32)]",
                     "detector.find_pairs(boxes, boxes, groups=(groups, None), masks=(None, masks))"),
    "users": ("users, [np.uint64(0), np.uint64(2**63)]", "world.create(boxes[:300].copy(), users=users[:300])"),
    "boxes": ("boxes, [boxes.copy(), -boxes, random.uniform(-50, 50, (n, 6)), np.nan]", "detector.find_pairs(boxes)"),
    "boxes_of_two": ("boxes, [boxes.copy(), -boxes, np.inf, random.uniform(-50, 50, (n, 6))]",
                     "detector.find_pairs(boxes, boxes[:30000])"),
    "boxes_filtered": ("boxes, [boxes.copy(), -boxes, random.uniform(-50, 50, (n, 6))]",
                       "detector.find_pairs(boxes, groups=groups, masks=masks)"),
    "boxes_of_sets": ("boxes, [boxes.copy(), -boxes, np.nan]", "detector.find_pairs_in_sets(boxes, offsets)"),
    "boxes_moved": ("boxes, [boxes.copy(), -boxes, np.nan, random.uniform(-50, 50, (n, 6))]",
                    "world.move(ids, boxes); world.update(); world.query_boxes(boxes[:200])"),
    "balls": ("low, [low.copy(), -low, np.nan, np.inf]", "detector.find_near_pairs(low, 0.2)"),
}


@pytest.mark.parametrize("executor", ["None", "boxstream.Executor(3)"])
@pytest.mark.parametrize("changed, call", CASES.values(), ids=CASES)
def test_no_memory_error(changed, call, executor):
    code = SETUP.format(executor=executor) + f"""
flip({changed})
def attempt():
    try:
        {call}
    except ValueError:
        pass
while time.monotonic() < end:
    attempt()
"""
    run = subprocess.run([sys.executable, "-X", "faulthandler", "-W", "ignore", "-c", code], capture_output=True, text=True, timeout=120,
                         env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert (run.returncode, run.stderr) == (0, "")
