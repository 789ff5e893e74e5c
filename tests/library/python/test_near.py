# SPDX-License-Identifier: MIT
"""find_near_pairs against rational numbers."""
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference import DTYPES, as_set, is_near

import boxstream


def expected_pairs(balls, distance):
    count = len(balls)
    return {(i, j) for i in range(count) for j in range(i + 1, count) if is_near(balls[i], balls[j], distance)}


def near(balls, distance, **options):
    return boxstream.find_near_pairs(balls[:, :3], distance, radii=balls[:, 3], **options)


@st.composite
def ball_arrays(draw):
    dtype = draw(st.sampled_from(DTYPES))
    coordinate = st.one_of(st.integers(-3, 3).map(float), st.sampled_from([0.1, 1e-20, np.nan, np.inf]))
    radius = st.sampled_from([0.0, 0.5, 1.0, 0.1, -1.0, np.nan])
    rows = draw(st.lists(st.tuples(coordinate, coordinate, coordinate, radius), max_size=20))
    return np.array(rows, dtype=dtype).reshape(len(rows), 4)


@settings(deadline=None)
@given(ball_arrays(), st.sampled_from([0.0, 0.25, 1.0, 0.1]))
def test_balls(balls, distance):
    found = as_set(near(balls, distance))
    assert found == expected_pairs(balls, distance)


@pytest.mark.parametrize("dtype", DTYPES)
def test_points_are_balls_of_radius_zero(dtype):
    points = np.random.default_rng(3).random((300, 3)).astype(dtype)
    balls = np.hstack([points, np.zeros((300, 1), dtype)])
    expected = expected_pairs(balls, 0.1)
    assert len(expected) > 50
    assert as_set(boxstream.find_near_pairs(points, 0.1)) == expected
    assert as_set(near(balls, 0.1)) == expected
    assert as_set(boxstream.Detector().find_near_pairs(points, 0.06, radii=0.02)) == expected_pairs(
        np.hstack([points, np.full((300, 1), 0.02)]), 0.06)


def test_stream():
    points = np.random.default_rng(4).random((2000, 3))
    blocks = []
    count = boxstream.stream_near_pairs(points, 0.1, blocks.append, block=100)
    assert np.array_equal(np.concatenate(blocks), boxstream.find_near_pairs(points, 0.1))
    assert count == sum(map(len, blocks)) and {len(block) for block in blocks[:-1]} == {100}


@pytest.mark.parametrize("distance", [-1, np.nan, np.inf])
def test_bad_distance(distance):
    with pytest.raises(ValueError, match="distance: expected a finite number that is not below 0, got"):
        boxstream.find_near_pairs(np.zeros((2, 3)), distance)


def test_distance_beyond_floats():
    points = np.zeros((2, 3), np.float32)
    for dtype in DTYPES:
        assert len(boxstream.find_near_pairs(points.astype(dtype), 1e300)) == 1


def test_distance_is_not_rounded_to_floats():
    balls = np.array([[0, 0, 0, 0], [np.float32(0.1), 0, 0, 0]], np.float32)
    assert len(near(balls, 0.1)) == 0  # np.float32(0.1) is above it
    assert len(near(balls, float(np.float32(0.1)))) == 1


def test_one_radius_is_not_rounded_to_floats():
    points = np.array([[0, 0, 0], [0, np.float32(0.3), 0]], np.float32)
    assert len(boxstream.find_near_pairs(points, 0, radii=0.15)) == 0  # np.float32(0.3) is above 2 * 0.15
    assert len(boxstream.find_near_pairs(points, 0, radii=np.float32(0.15))) == 1  # and is twice this


def test_invalid_balls_can_be_an_error():
    balls = np.array([[0, 0, 0, 1], [0, 0, 0, -1], [np.inf, 0, 0, 1]], np.float32)
    assert len(near(balls, 1)) == 0
    with pytest.raises(ValueError, match=r"points: expected none that is invalid .*got 2 of 3; the first is points\[1\]"):
        near(balls, 1, invalid="raise")
