# SPDX-License-Identifier: MIT
"""simulate: physics that is known, and pairs that do not depend on the broad-phase."""
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import boxstream

pytest.importorskip("boxstream._simulation", reason="built without the simulation")


def test_a_ball_falls():
    """By Bullet's steps: the velocity first, then the place. Single precision."""
    poses, pairs = boxstream.simulate("effects/gravity", steps=60)
    time, n = 1 / 60, np.arange(61)
    assert poses.shape == (61, 1, 7) and [len(each) for each in pairs] == [0] * 60
    assert np.allclose(poses[:, 0, 0], 0.5 * time * n, atol=1e-5)
    assert np.allclose(poses[:, 0, 1], 0.5 - 9.81 * time**2 * n * (n + 1) / 2, atol=1e-5)
    assert np.allclose(poses[:, 0, 2:], [0, 0, 0, 0, 1])


def test_shapes():
    poses, pairs = boxstream.simulate("wall", steps=3)
    assert poses.dtype == np.float64 and poses.shape[0] == 4 and poses.shape[1] > 100 and poses.shape[2] == 7
    assert len(pairs) == 3
    for each in pairs:
        assert each.dtype == np.uint32 and (each[:, 0] < each[:, 1]).all() and each.max() < poses.shape[1]
    assert np.allclose(np.linalg.norm(poses[:, :, 3:], axis=2), 1, atol=1e-5)


def test_the_same_pairs_on_another_broadphase():
    """Both hold all pairs whose boxes overlap; after one step from the same state ours are among the others'."""
    ours = boxstream.simulate("wall", steps=1).pairs[0]
    others = boxstream.simulate("wall", steps=1, broadphase="dbvt").pairs[0]
    assert len(ours) > 100
    assert set(map(tuple, ours.tolist())) <= set(map(tuple, others.tolist()))


def test_it_repeats():
    first, second = boxstream.simulate("pile", steps=20), boxstream.simulate("pile", 20)
    assert np.array_equal(first.poses, second.poses)
    assert not np.array_equal(first.poses[0], first.poses[20])
    assert all(np.array_equal(a, b) for a, b in zip(first.pairs, second.pairs))


def test_effects_are_those_of_the_steps_that_are_run():
    """The scene has 60 steps, in which nothing falls asleep; in 300 the box does, and stays where it is to the bit."""
    places = boxstream.simulate("effects/friction", steps=300).poses[:, 0]
    assert not np.array_equal(places[59], places[60])
    assert np.array_equal(places[299], places[300])


def test_no_steps():
    poses, pairs = boxstream.simulate("pile", steps=0)
    assert len(poses) == 1 and pairs == []


@pytest.mark.parametrize("scene, steps, broadphase, error, text", [
    ("no such scene", 1, "boxstream", RuntimeError, "no such scene: cannot be read"),
    ("wall", 1, "no such broad-phase", ValueError, "unknown broad-phase"),
    ("wall", -1, "boxstream", ValueError, "steps: expected an integer of at least 0, got -1"),
    ("wall", 1.5, "boxstream", TypeError, "'float' object cannot be interpreted as an integer"),
])
def test_errors(scene, steps, broadphase, error, text):
    with pytest.raises(error, match=text):
        boxstream.simulate(scene, steps, broadphase=broadphase)


def test_the_example_draws(tmp_path):
    example = pathlib.Path(__file__).resolve().parents[3] / "adapters/python/examples/pile.py"
    run = subprocess.run([sys.executable, str(example)], cwd=tmp_path, env=dict(os.environ, MPLBACKEND="Agg"),
                         capture_output=True, text=True, check=True)
    objects = boxstream.simulate("pile", steps=0).poses.shape[1]
    assert run.stdout.startswith(f"{objects} objects, 150 steps\n")
    assert (tmp_path / "pile.png").read_bytes().startswith(b"\x89PNG")
