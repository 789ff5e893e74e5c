#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what docs/effects.md says effects do not do: sweep compounds, keep a fast body out of a thick obstacle, carry
a box on a belt that is a plane without letting it sink in."""
import csv
import struct

from made_scene import bounds, simulate, table_script

FLOORS = {"plane": {"type": "plane", "normal": [0, 1, 0], "offset": 0},
          "box": {"type": "box", "half_extents": [50, 1, 50]}}
HEAD = 304  # bytes of an .aabbs file before its boxes
SWEPT = {"threshold": 0.01, "radius": 0.25}


def place(floor):
    """With its surface at 0."""
    return [0, 0 if floor == "plane" else -1, 0]


def time(steps):
    return {"dt": 1 / 60, "steps": steps}


def places(tool, steps, folder, **scene):
    """The centre of the last body's box at the start and after each step. Where a body is swept, its box is longer."""
    record = folder / "run.aabbs"
    simulate(tool, {"time": time(steps)} | scene, folder, "--record", str(record))
    boxes = struct.Struct("<8f")
    count = len(scene["bodies"])
    all_boxes = list(boxes.iter_unpack(record.read_bytes()[HEAD:]))[count - 1::count]
    assert len(all_boxes) == steps + 1
    return [[(box[axis] + box[axis + 4]) / 2 for axis in range(3)] for box in all_boxes]


def through_a_wall(tool, folder, shape):
    ball = {"name": "ball", "type": "sphere", "radius": 0.25}
    shapes = [ball, {"name": "wall", "type": "box", "half_extents": [0.01, 5, 5]},
              {"name": "compound", "type": "compound", "children": [{"shape": "ball"}]}]
    bodies = [{"shape": "wall", "type": "static"},
              {"shape": shape, "mass": 1, "position": [-5, 0, 0], "velocity": [100, 0, 0], "ccd": SWEPT}]
    x = places(tool, 60, folder, world={"gravity": [0, 0, 0], "bounds": bounds(200)}, shapes=shapes, bodies=bodies)[-1][0]
    return "passes" if x > 0 else "stays in front"


def fall(tool, folder, floor, ccd):
    shapes = [{"name": "ball", "type": "sphere", "radius": 0.25}, {"name": "floor"} | FLOORS[floor]]
    bodies = [{"shape": "floor", "type": "static", "position": place(floor)},
              {"shape": "ball", "mass": 1, "position": [0, 100, 0], "ccd": SWEPT if ccd else False, "sleep": False}]
    scene = {"time": time(600), "world": {"gravity": [0, -9.81, 0], "bounds": bounds(200)}, "shapes": shapes, "bodies": bodies}
    simulate(tool, scene, folder, "--csv", str(folder / "run.csv"))
    heights = [float(row["lowest"]) for row in csv.DictReader((folder / "run.csv").open())]
    lands = next(i for i, y in enumerate(heights) if y < 0.5)
    return f"centre from {min(heights):.2f} to {max(heights[lands:]):.2f} m"


def carried(tool, folder, floor, speed, friction):
    shapes = [{"name": "crate", "type": "box", "half_extents": [0.3] * 3}, {"name": "belt"} | FLOORS[floor]]
    bodies = [{"shape": "belt", "type": "static", "material": "rough", "surface_velocity": [speed, 0, 0],
               "position": place(floor)},
              {"shape": "crate", "mass": 1, "material": "rough", "position": [-20, 0.3, 0]}]
    path = places(tool, 300, folder, world={"gravity": [0, -9.81, 0], "bounds": bounds(200)},
                  materials={"rough": {"friction": friction}}, shapes=shapes, bodies=bodies)
    seconds = (len(path) - 1 - 120) / 60
    along, aside = ((path[-1][axis] - path[120][axis]) / seconds / speed for axis in (0, 2))
    depth = 0.3 - min(y for _, y, _ in path)
    return f"{along:.2f} of its speed, {abs(aside):.2f} aside; {1000 * depth:.0f} mm in at most"


def table(tool, folder):
    rows = [[f"ball of 0.25 m{text}, 100 m/s, at a wall of 2 cm", through_a_wall(tool, folder, shape)]
            for text, shape in (("", "ball"), (" as the part of a compound", "compound"))]
    rows += [[f"ball of 0.25 m, dropped 100 m onto a {floor}, {'swept' if ccd else 'not swept'}",
              fall(tool, folder, floor, ccd)] for floor in FLOORS for ccd in (False, True)]
    rows += [[f"box of 0.6 m on a belt that is a {floor}, {speed} m/s, friction {friction}, from 2 to 5 s",
              carried(tool, folder, floor, speed, friction)]
             for floor in FLOORS for speed, friction in ((1, 0.3), (1, 1), (5, 1))]
    return ["World", "Measured"], rows


if __name__ == "__main__":
    table_script(__doc__, "effect limits", table)
