# SPDX-License-Identifier: MIT
"""Pairs, and a world, through ctypes, against brute force: ctypes_test.py LIBRARY"""
import ctypes as c
import random
import sys

library = c.CDLL(sys.argv[1])
library.boxstream_error_text.restype = c.c_char_p


class Boxes(c.Structure):
    _fields_ = [("scalar", c.c_int), ("data", c.c_void_p), ("count", c.c_size_t), ("filters", c.c_void_p)]


class Pair(c.Structure):
    _fields_ = [("a", c.c_uint32), ("b", c.c_uint32)]


class Id(c.Structure):
    _fields_ = [("slot", c.c_uint32), ("generation", c.c_uint32)]


class IdPair(c.Structure):
    _fields_ = [("a", Id), ("b", Id)]


def brute_force(boxes):
    return {(i, k) for i, a in enumerate(boxes) for k, b in enumerate(boxes[:i])
            if all(a[d] <= b[d + 3] and b[d] <= a[d + 3] for d in range(3))}


def unordered(pairs):
    return {(max(pair), min(pair)) for pair in pairs}


def view(boxes, scalar):
    kind = (c.c_float, c.c_double)[scalar]
    data = (kind * (6 * len(boxes)))(*(x for box in boxes for x in box))
    return data, Boxes(scalar, c.cast(data, c.c_void_p), len(boxes), None)


def check(status):
    assert status == 0, library.boxstream_error_text()


def test_pairs(boxes, scalar):
    detector, pairs, count = c.c_void_p(), c.POINTER(Pair)(), c.c_size_t()
    check(library.boxstream_detector_create(None, c.byref(detector)))
    data, boxes_view = view(boxes, scalar)
    check(library.boxstream_find_pairs(detector, c.byref(boxes_view), None, c.byref(pairs), c.byref(count), None))
    found = [(pairs[i].a, pairs[i].b) for i in range(count.value)]
    assert len(found) == len(set(found)) and unordered(found) == brute_force(boxes)

    streamed = []

    @c.CFUNCTYPE(c.c_bool, c.c_void_p, c.POINTER(Pair), c.c_size_t)
    def sink(_, batch, size):
        streamed.extend((batch[i].a, batch[i].b) for i in range(size))
        return True

    check(library.boxstream_stream_pairs(detector, c.byref(boxes_view), None, sink, None, None))
    assert streamed == found
    assert library.boxstream_find_pairs(detector, None, None, c.byref(pairs), c.byref(count), None) == 3
    assert library.boxstream_error_text() == b"no boxes"
    library.boxstream_detector_destroy(detector)
    return len(found)


def test_world(boxes, moved):
    world, count = c.c_void_p(), c.c_size_t()
    check(library.boxstream_world_create(0, None, c.byref(world)))
    ids = (Id * len(boxes))()
    data, boxes_view = view(boxes, 0)
    check(library.boxstream_world_insert(world, c.byref(boxes_view), None, ids))
    number = {(ids[i].slot, ids[i].generation): i for i in range(len(boxes))}

    def pairs_of(name):
        function = getattr(library, name)
        function.restype = c.POINTER(IdPair)
        pairs = function(world, c.byref(count))
        return unordered((number[pairs[i].a.slot, pairs[i].a.generation], number[pairs[i].b.slot, pairs[i].b.generation])
                         for i in range(count.value))

    check(library.boxstream_world_update(world, None, None, None))
    before = brute_force(boxes)
    assert pairs_of("boxstream_world_begun") == before and pairs_of("boxstream_world_ended") == set()
    data, boxes_view = view(moved, 0)
    check(library.boxstream_world_move(world, ids, c.byref(boxes_view), None))
    check(library.boxstream_world_update(world, None, None, None))
    after = brute_force(moved)
    assert pairs_of("boxstream_world_begun") == after - before and pairs_of("boxstream_world_ended") == before - after
    library.boxstream_world_destroy(world)


def random_boxes(count):
    corners = [[random.randrange(20) for _ in range(3)] for _ in range(count)]
    return [corner + [x + random.randrange(4) for x in corner] for corner in corners]


if __name__ == "__main__":
    for seed in range(30):
        random.seed(seed)
        size = random.randrange(200)
        boxes, moved = random_boxes(size), random_boxes(size)
        pairs = test_pairs(boxes, seed % 2)
        assert size < 50 or pairs > 0
        test_world(boxes, moved)
