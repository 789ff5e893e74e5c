#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Times the Python package beside C++ and beside what Python users have, and prints a table for docs/python.md.

Runs of a row take turns; values are medians of elapsed time, in one thread. Pairs are compared in every row.
"""
import argparse
import ctypes
import datetime
import pathlib
import platform
import statistics
import sys
import time

import numpy as np
import peers

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLOATS = np.ctypeslib.ndpointer(np.float32, flags="C")


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="the build to measure")
    parser.add_argument("--rows", default="ours,brute,kd,rtree,near", help="of ours, brute, kd, rtree, near")
    parser.add_argument("--seconds", type=float, default=5, help="for each row, at least")
    return parser.parse_args()


def load(build):
    """The package and the C++ reference of a build."""
    sys.path.insert(0, str(build / "adapters/python"))
    import boxstream

    library = ctypes.CDLL(str(build / "bench/python/libboxstream_python_reference.so"))
    library.boxstream_reference_boxes.argtypes = [ctypes.c_char_p, ctypes.c_size_t, FLOATS]
    library.boxstream_reference_pairs.argtypes = [np.ctypeslib.ndpointer(np.uint32, flags="C")]
    library.boxstream_reference_boxes.restype = library.boxstream_reference_pairs.restype = None
    for search in (library.boxstream_reference_once, library.boxstream_reference_kept):
        search.argtypes, search.restype = [FLOATS, ctypes.c_size_t], ctypes.c_uint64
    return boxstream, library


def medians(seconds, *calls):
    """Milliseconds of each call, from runs in turns, at least three, after one to warm up; and what each returned."""
    results = [call() for call in calls]
    times = [[] for _ in calls]
    end = time.perf_counter() + seconds
    while len(times[0]) < 3 or time.perf_counter() < end:
        for call, own in zip(calls, times):
            begin = time.perf_counter()
            result = call()
            own.append(1000 * (time.perf_counter() - begin))
            del result
    return [statistics.median(own) for own in times], results


def ordered(pairs):
    pairs = np.sort(np.asarray(pairs, np.int64).reshape(-1, 2), axis=1)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def row(seconds, search, n, ours, name, peer, pairs_of=lambda result: result):
    """One line of the table. `pairs_of` makes pairs of what the peer returned."""
    (our_time, its_time), (our_pairs, its_pairs) = medians(seconds, ours, peer)
    if not np.array_equal(ordered(our_pairs), ordered(pairs_of(its_pairs))):
        sys.exit(f"{search}, {n}: {name} finds other pairs")
    ratio = its_time / our_time
    cells = search, n, len(our_pairs), f"{our_time:.4g}", name, f"{its_time:.4g}", f"{ratio:.{0 if ratio >= 100 else 2}f}"
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as lines:
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))


def main():
    given = options()
    boxstream, cpp = load(given.build)
    rows = given.rows.split(",")

    def batch(n):
        boxes = np.empty((n, 6), np.float32)
        cpp.boxstream_reference_boxes(b"U", n, boxes)
        return boxes

    def pairs_in_cpp(count):
        """The result of both searches in C++ is a number of pairs; one keeps them."""
        pairs = np.empty((count, 2), np.uint32)
        cpp.boxstream_reference_pairs(pairs)
        return pairs

    print(f"{processor()}; SIMD target {boxstream.simd_target()}; Python {platform.python_version()}, "
          f"NumPy {np.__version__}, {peers.versions()}; {datetime.date.today()}\n")
    print("| search | n | pairs | ours, ms | peer | its ms | ratio |\n|---|--:|--:|--:|---|--:|--:|")
    detector = boxstream.Detector()
    if "ours" in rows:
        for n in (1000, 10_000, 100_000, 1_000_000):
            boxes = batch(n)
            row(given.seconds, "`Detector.find_pairs`", n, lambda: detector.find_pairs(boxes), "C++, `Detector`",
                lambda: cpp.boxstream_reference_kept(boxes, n), pairs_in_cpp)
            row(given.seconds, "`find_pairs`", n, lambda: boxstream.find_pairs(boxes), "C++, `find_pairs`",
                lambda: cpp.boxstream_reference_once(boxes, n), pairs_in_cpp)
    for kind, name, peer, sizes in (("brute", "NumPy, all pairs", peers.brute_force, (1000, 10_000)),
                                    ("kd", "SciPy, `cKDTree` and NumPy", peers.kd_tree, (1000, 10_000, 100_000)),
                                    ("rtree", "Rtree", peers.rtree, (1000, 10_000, 100_000))):
        for n in sizes if kind in rows else ():
            boxes = batch(n)
            row(given.seconds, "`find_pairs`", n, lambda: boxstream.find_pairs(boxes), name, lambda: peer(boxes))
    if "near" in rows:
        for n in (1000, 10_000, 100_000):
            points = np.random.default_rng(1).random((n, 3))
            distance = (3 / (4 * np.pi * n)) ** (1 / 3)
            row(given.seconds, "`find_near_pairs`", n, lambda: boxstream.find_near_pairs(points, distance),
                "SciPy, `cKDTree`", lambda: peers.kd_tree_points(points, distance))


if __name__ == "__main__":
    main()
