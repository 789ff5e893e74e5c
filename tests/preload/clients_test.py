#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Debian's programs on boxstream, not rebuilt: dartpy on FCL and on Bullet. Skipped where they are not installed."""
import subprocess
import sys

SKIPPED = 77
PYTHON = "/usr/bin/python3"  # Debian's: its packages are for this one

DART = """
import sys
import numpy as np
import dartpy as dart

world = dart.simulation.World()
world.setGravity([0, 0, -9.81])
detector = {"fcl": dart.collision.FCLCollisionDetector, "bullet": dart.collision.BulletCollisionDetector}[sys.argv[1]]
world.getConstraintSolver().setCollisionDetector(detector())


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


world.addSkeleton(body("ground", [30, 30, 0.2], [0, 0, -0.1], True))
random = np.random.default_rng(5)
for i in range(40):
    place = np.array([random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 0.4 + 0.2 * i])
    world.addSkeleton(body(f"box {i}", [0.35, 0.25, 0.3], place))
for _ in range(400):
    world.step()
heights = sum(float(world.getSkeleton(i).getPositions()[-1]) for i in range(1, world.getNumSkeletons()))
print(f"{heights:.6f}")
"""


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, timeout=250)


def main(tried):
    if run(PYTHON, "-c", "import dartpy").returncode != 0:
        print("dartpy is not installed (Debian: python3-dartpy)")
        return SKIPPED
    for engine, library in (("fcl", "libfcl"), ("bullet", "libBulletCollision")):
        plain = run(PYTHON, "-c", DART, engine)
        checked = run(tried, "--check", "--", PYTHON, "-c", DART, engine)
        replaced = run(tried, "--", PYTHON, "-c", DART, engine)
        print(engine, plain.stdout.strip(), replaced.stdout.strip(), checked.stderr, sep="\n")
        assert plain.returncode == checked.returncode == replaced.returncode == 0, (plain.stderr, checked.stderr)
        assert f"{library}.so" in checked.stderr and "no difference" in checked.stderr
        # The order of contacts differs, and with it the last digits.
        for result in (checked, replaced):
            assert abs(float(result.stdout) - float(plain.stdout)) < 1e-3 * float(plain.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
