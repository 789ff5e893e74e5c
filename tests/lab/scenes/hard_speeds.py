#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Throws bodies of several shapes on floors and prints how many fall through, by how far they move in a step.

Of each, 60 bodies fall in steps of 1/60 s, turned at random, far enough from each other not to touch. They are swept,
as bodies are that `boxstream simulate` finds fast.
"""
import json
import random

from made_scene import simulate, table_script

COUNT, CELL, SIDE = 60, 3, 8
MOTIONS = [0.5, 1, 2, 4, 8, 16]  # in a step, in halves of the body's thickness

# Half of the thickness of each beside it.
BODIES = {
    "cube 0.2 x 0.2 x 0.2 m": ({"type": "box", "half_extents": [0.1, 0.1, 0.1]}, 0.1),
    "plank 1 x 0.04 x 0.2 m": ({"type": "box", "half_extents": [0.5, 0.02, 0.1]}, 0.02),
    "rod 0.86 m, radius 0.03 m": ({"type": "capsule", "radius": 0.03, "height": 0.8}, 0.03),
    "disc 0.05 m, radius 0.2 m": ({"type": "cylinder", "radius": 0.2, "height": 0.05}, 0.025),
    "cone 0.4 m, radius 0.2 m": ({"type": "cone", "radius": 0.2, "height": 0.4}, 0.1),
}


def mesh(half):
    n = 2 * half + 1
    return {"type": "mesh", "vertices": [[i - half, 0, j - half] for i in range(n) for j in range(n)],
            "triangles": [t for i in range(n - 1) for j in range(n - 1) for a in [i * n + j]
                          for t in ([a, a + 1, a + n], [a + 1, a + n + 1, a + n])]}


HALF = SIDE * CELL // 2
FLOORS = {
    "mesh": (mesh(HALF), 0),
    "height field": ({"type": "heightfield", "columns": 2 * HALF + 1, "rows": 2 * HALF + 1, "cell": 1,
                      "heights": [0] * (2 * HALF + 1) ** 2}, 0),
    "box of 0.1 m": ({"type": "box", "half_extents": [HALF, 0.05, HALF]}, -0.05),
}


def fallen(tool, shape, half, floor, motion, folder):
    draw = random.Random(7)
    speed = motion * half * 60
    bodies = []
    for i in range(COUNT):
        axis = [draw.gauss(0, 1) for _ in range(3)]
        place = [(i % SIDE + 0.5) * CELL - HALF + draw.uniform(-0.5, 0.5), 0.8 + draw.random() * max(0.2, speed / 60),
                 (i // SIDE + 0.5) * CELL - HALF + draw.uniform(-0.5, 0.5)]
        bodies.append({"shape": "body", "density": 1000, "position": place, "velocity": [0, -speed, 0],
                       "rotation": {"axis": axis, "degrees": draw.uniform(0, 360)}})
    ground, height = floor
    # The checks ask for centres below the floor.
    scene = {"time": {"dt": 1 / 60, "steps": 60},
             "world": {"gravity": [0, 0, 0], "bounds": {"min": [-1000, -0.15, -1000], "max": [1000] * 3}},
             "shapes": [{"name": "body"} | shape, {"name": "floor"} | ground],
             "bodies": [{"shape": "floor", "type": "static", "position": [0, height, 0]}, *bodies],
             "checks": [{"metric": "outside", "op": "==", "value": 0, "at": "end"}]}
    run = simulate(tool, scene, folder, "--json", "-")
    return round(json.loads(run.stdout)["worlds"][0]["checks"][0]["value"])


def table(tool, folder):
    rows = [[body, name, *(str(fallen(tool, shape, half, floor, motion, folder)) for motion in MOTIONS)]
            for body, (shape, half) in BODIES.items() for name, floor in FLOORS.items()]
    head = ["Body", "Floor", *(f"{motion:g} halves" for motion in MOTIONS)]
    return head, rows, ["---", "---"] + ["---:"] * len(MOTIONS)


if __name__ == "__main__":
    table_script(__doc__, "hard speeds", table)
