#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scenes for Siconos, whose contacts come from Bullet. siconos_scenes.py SCENE [SECONDS]: prints the last places of
all bodies, the number of contacts and the last forces, in full precision, as JSON."""
import contextlib
import json
import os
import sys
import tempfile

import numpy as np
from siconos.io.mechanics_run import MechanicsHdf5Runner
from siconos.mechanics.collision.tools import Contactor

RANDOM = np.random.default_rng(7)


def ground(io, orientation=None):
    io.add_primitive_shape("Ground", "Box", (30, 30, 0.5))
    io.add_object("ground", [Contactor("Ground")], translation=[0, 0, -0.25], orientation=orientation)
    io.add_Newton_impact_friction_nsl("contact", mu=0.3, e=0.0)


def cubes(io):
    """A leaning column comes down on itself."""
    ground(io)
    io.add_primitive_shape("Cube", "Box", (1, 1, 1))
    for i in range(8):
        io.add_object(f"cube{i}", [Contactor("Cube")], translation=[0.1 * i, 0.05 * i, 2 + 1.3 * i],
                      velocity=[0, 0, 0, 0.3, 0.2, 0.1 * i], mass=1)


def hulls(io):
    """Convex hulls of random points."""
    ground(io)
    for i in range(10):
        points = RANDOM.normal(size=(12, 3))
        io.add_convex_shape(f"Hull{i}", points / np.linalg.norm(points, axis=1)[:, None] * RANDOM.uniform(0.4, 0.8))
        io.add_object(f"hull{i}", [Contactor(f"Hull{i}")], translation=[0.3 * (i % 3), 0.2 * (i % 2), 1 + 1.2 * i],
                      velocity=[0, 0, 0, 0.5, 0.1 * i, 0], mass=1, inertia=np.eye(3) * 0.1)


def slope(io):
    """Balls, cylinders and capsules roll down, and into each other."""
    half = 0.15
    ground(io, orientation=[np.cos(half), 0, np.sin(half), 0])
    io.add_primitive_shape("Ball", "Sphere", (0.4,))
    io.add_primitive_shape("Roll", "Cylinder", (0.3, 1.0))
    io.add_primitive_shape("Pill", "Capsule", (0.25, 0.6))
    for i in range(15):
        io.add_object(f"body{i}", [Contactor(["Ball", "Roll", "Pill"][i % 3])],
                      translation=[-6 + 1.1 * (i % 5), 1.2 * (i // 5) - 1, 3.5 - 0.2 * (i % 5)],
                      velocity=[1, 0, 0, 0, 0, 0.1], mass=1)


def compounds(io):
    """Objects of two shapes each."""
    ground(io)
    io.add_primitive_shape("Bar", "Box", (1.2, 0.3, 0.3))
    io.add_primitive_shape("Head", "Sphere", (0.35,))
    for i in range(8):
        io.add_object(f"hammer{i}", [Contactor("Bar"), Contactor("Head", relative_translation=[0.6, 0, 0])],
                      translation=[0.2 * (i % 2), 0.15 * (i % 3), 1 + 1.1 * i],
                      velocity=[0, 0, 0, 0.2 * i, 0.3, 0.1], mass=1, inertia=np.eye(3) * 0.1)


def births(io):
    """One each quarter of a second comes into the world, and some leave it."""
    ground(io)
    io.add_primitive_shape("Cube", "Box", (0.8, 0.6, 0.7))
    for i in range(8):
        death = {"time_of_death": 1.1} if i in (1, 2) else {}
        io.add_object(f"cube{i}", [Contactor("Cube")], translation=[0.1 * i, 0.1 * (i % 2), 3],
                      velocity=[0, 0, -2, 0.1, 0.4, 0], mass=1, time_of_birth=0.25 * i - 0.1, **death)


def wide(io):
    """Plates, cones and balls, most of them wider than two units: their contacts reach farther than boxes do."""
    ground(io)
    io.add_primitive_shape("Plate", "Box", (6, 4, 0.4))
    io.add_primitive_shape("Cone", "Cone", (0.8, 1.6))
    io.add_primitive_shape("Ball", "Sphere", (2.0,))
    for i in range(6):
        io.add_object(f"body{i}", [Contactor(["Plate", "Cone", "Ball"][i % 3])], translation=[0.8 * (i % 2), 0.5 * (i % 3), 2 + 3.2 * i],
                      velocity=[0, 0, -5, 0.1, 0.1, 0.1], mass=1 + i)


def main(scene, seconds):
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        with open(os.devnull, "w", encoding="ascii") as nothing, contextlib.redirect_stdout(nothing):
            with MechanicsHdf5Runner("scene.hdf5", mode="w") as io:
                {f.__name__: f for f in (cubes, hulls, slope, compounds, births, wide)}[scene](io)
            with MechanicsHdf5Runner("scene.hdf5", mode="r+") as io:
                io.run(t0=0, T=seconds, h=0.005, multipoints_iterations=True, verbose=False, verbose_progress=False,
                       output_frequency=10)
                places, contacts = io.dynamic_data()[:], io.contact_forces_data()[:]
        last = places[places[:, 0] == places[:, 0].max()]
        print(json.dumps({"heights": last[:, 4].tolist(), "states": last[:, 1:].ravel().tolist(),
                          "contacts": len(contacts), "forces": contacts[-20:].ravel().tolist()}))


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 2)
