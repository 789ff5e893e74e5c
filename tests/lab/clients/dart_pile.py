#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Boxes fall into a pile in DART. dart_pile.py fcl|bullet [STEPS]: prints their heights as JSON."""
import json
import sys

import dartpy as dart
import numpy as np


def body(name, size, place, is_fixed=False):
    skeleton = dart.dynamics.Skeleton(name)
    joint, node = (skeleton.createWeldJointAndBodyNodePair() if is_fixed else skeleton.createFreeJointAndBodyNodePair())
    shape = node.createShapeNode(dart.dynamics.BoxShape(size))
    shape.createCollisionAspect()
    shape.createDynamicsAspect()
    if is_fixed:
        transform = dart.math.Isometry3()
        transform.set_translation(place)
        joint.setTransformFromParentBodyNode(transform)
    else:
        skeleton.setPositions(np.concatenate([np.zeros(3), place]))
    return skeleton


def main(engine, steps):
    world = dart.simulation.World()
    world.setGravity([0, 0, -9.81])
    detector = {"fcl": dart.collision.FCLCollisionDetector, "bullet": dart.collision.BulletCollisionDetector}[engine]
    world.getConstraintSolver().setCollisionDetector(detector())
    world.addSkeleton(body("ground", [30, 30, 0.2], [0, 0, -0.1], True))
    random = np.random.default_rng(5)
    for i in range(40):
        place = np.array([random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 0.4 + 0.2 * i])
        world.addSkeleton(body(f"box {i}", [0.35, 0.25, 0.3], place))
    for _ in range(steps):
        world.step()
    places = [world.getSkeleton(i).getPositions() for i in range(1, world.getNumSkeletons())]
    print(json.dumps({"heights": [float(p[-1]) for p in places], "states": [float(x) for p in places for x in p]}))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 400)
