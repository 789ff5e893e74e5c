# SPDX-License-Identifier: MIT
import operator
from typing import NamedTuple

import numpy as np


class Simulated(NamedTuple):
    """What simulate returns.

    poses: array of float64, shape (steps + 1, n, 7): of each object, in order of creation, place (x, y, z) and rotation
        (quaternion x, y, z, w), before the first step and after each. NaN while an object is not in the world.
    pairs: list of arrays of uint32, shape (k, 2), one for each step: objects that the broad-phase holds as pairs, a < b,
        sorted. The boxes of Bullet are larger than its shapes.
    """

    poses: np.ndarray
    pairs: list


def simulate(scene, steps=100, *, broadphase="boxstream"):
    """simulate(scene, steps=100, *, broadphase='boxstream')

    Runs a scene on Bullet.

    scene: the name of a scene that comes with the sources ('pile'), or the path of a file.
    steps: int.
    broadphase: 'boxstream', 'dbvt', 'sap' and so on: as the tool's --broadphase.

    Returns Simulated: poses and pairs. Ctrl-C stops it between two steps.
    Raises ImportError where the package was built without the simulation; ValueError for an unknown broad-phase or
    fewer than 0 steps; RuntimeError for a scene that cannot be read or run, and while another simulation runs in this
    process.
    """
    try:
        from . import _simulation
    except ImportError:
        raise ImportError(
            "boxstream.simulate needs a build of the sources where Bullet is (libbullet-dev); pip installs none"
        ) from None
    if operator.index(steps) < 0:
        raise ValueError(f"steps: expected an integer of at least 0, got {steps}")
    return Simulated(*_simulation.simulate(scene, steps, broadphase))
