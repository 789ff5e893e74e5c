# SPDX-License-Identifier: MIT
"""No call traps, whatever its numbers, in a process whose floating-point exceptions do."""
import os
import subprocess
import sys

import pytest

SETUP = """
import ctypes, sys
import numpy as np
import boxstream

dtype = np.dtype(sys.argv[1])
random = np.random.default_rng(7)
limits = np.finfo(dtype)
numbers = np.array([0.0, -0.0, 1, -2, np.inf, -np.inf, np.nan, limits.max, -limits.max, limits.tiny,
                    limits.smallest_subnormal, limits.max], dtype)
signalling = numbers[-1:].view(np.uint32 if dtype == np.float32 else np.uint64)
signalling[:] = 0x7f800001 if dtype == np.float32 else 0x7ff0000000000001
def any_numbers(*shape):
    return numbers.view(signalling.dtype)[random.integers(0, len(numbers), shape)].view(dtype)

boxes, points, directions, balls = any_numbers(6000, 6), any_numbers(500, 3), any_numbers(500, 3), any_numbers(3000, 4)
wide = np.where(np.abs(boxes) < 1e30, boxes.astype(np.float64) / 3, boxes)
executor = boxstream.Executor(2)
detector = boxstream.Detector(executor)
world = boxstream.World(dtype, executor)
ids = world.create(boxes)
def near(distance, **options):
    return detector.find_near_pairs(balls[:, :3], distance, radii=balls[:, 3], **options)
libm = ctypes.CDLL("libm.so.6")
libm.feenableexcept(1 | 4 | 8)  # invalid, division by zero, overflow
try:
    %s
except (ValueError, TypeError):
    pass
finally:
    libm.fedisableexcept(1 | 4 | 8)
"""

CALLS = ["detector.find_pairs(boxes)", "detector.find_pairs(boxes, boxes)", "boxstream.find_pairs(boxes[:50])",
         "detector.find_pairs(boxes, invalid='raise')", "near(0.5, invalid='raise')", "near(0.5)",
         "boxstream.World().create(wide)", "boxstream.find_pairs(np.asfortranarray(boxes))", "detector.find_near_pairs(points, 1e300)",
         "detector.find_near_pairs(points, float('nan'))",
         "world.update(); world.move(ids, boxes[::-1].copy()); world.update(); world.bounds",
         "world.query_boxes(boxes[:300])", "world.query_nearest(points, 3)", "world.query_rays(points, directions)",
         "world.cast_rays(points, directions, 1e300)", "world.cast_rays(points, directions, points[:, 0].copy())"]


@pytest.mark.skipif(not sys.platform.startswith("linux") or os.uname().machine != "x86_64", reason="needs glibc's traps")
@pytest.mark.parametrize("dtype", ["float32", "float64"])
@pytest.mark.parametrize("call", CALLS)
def test_no_trap(call, dtype):
    run = subprocess.run([sys.executable, "-W", "ignore", "-c", SETUP % call, dtype], capture_output=True, text=True, timeout=120,
                         env=dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path)))
    assert (run.returncode, run.stderr) == (0, "")
