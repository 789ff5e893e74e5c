#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a pyramid and stacks of cubes with one and with two directions of friction (docs/effects.md): how deep contacts
come, what stands, and what a step takes."""
import csv
import json
import pathlib
import random
import statistics

from made_scene import bounds, simulate, table_script

PYRAMID = pathlib.Path(__file__).resolve().parents[3] / "demos" / "scenes" / "hard" / "pyramid_1240.json"
DIRECTIONS = ["one", "two"]
STEPS, ROUNDS = 60, 5
SMALL = [0.005, 0.007, 0.008, 0.01, 0.012, 0.015, 0.02, 0.03, 0.05, 0.1]  # m
LARGE = [(10, 0.3), (15, 1), (20, 1), (25, 1)]  # cubes, m


def last_places(file, count):
    return list(csv.DictReader(file.open()))[-count:]


def pyramid(tool, directions, folder):
    """Deepest contact and greatest speed at the end in mm and mm/s, and a step's median time in ms."""
    scene = json.loads(PYRAMID.read_text())
    scene.setdefault("solver", {})["friction_directions"] = directions
    states = folder / "states.csv"
    told = json.loads(simulate(tool, scene, folder, "--steps", str(STEPS), "--states", str(states), "--json", "-").stdout)
    world = told["worlds"][0]
    rows = [row for row in csv.DictReader(states.open()) if int(row["step"]) == STEPS]
    speed = max(sum(float(row[axis])**2 for axis in ("vx", "vy", "vz"))**0.5 for row in rows)
    return 1e3 * world["vitals"]["deepest_m"], 1e3 * speed, world["summary"]["step"]["median_ms"]


def stands(tool, directions, awake, count, size, aside, seed, folder):
    """Whether a stack that is set down askew by a share of its size is as high as it was after 10 s."""
    chance = random.Random(seed)
    places = [[aside * size * chance.uniform(-1, 1), (0.5 + i) * size, aside * size * chance.uniform(-1, 1)] for i in range(count)]
    cubes = [{"shape": "cube", "density": 800, "position": place, **({"sleep": False} if awake else {})} for place in places]
    scene = {"time": {"dt": 1 / 60, "steps": 600}, "solver": {"friction_directions": directions}, "world": {"bounds": bounds(1000)},
             "shapes": [{"name": "ground", "type": "box", "half_extents": [10 * size, size / 2, 10 * size]},
                        {"name": "cube", "type": "box", "half_extents": [size / 2] * 3}],
             "bodies": [{"shape": "ground", "type": "static", "position": [0, -size / 2, 0]}, *cubes]}
    states = folder / "states.csv"
    simulate(tool, scene, folder, "--states", str(states))
    return max(float(row["y"]) for row in last_places(states, count)) > (count - 1) * size


def table(tool, folder):
    times = {directions: [] for directions in DIRECTIONS}
    for _ in range(ROUNDS):
        for directions in DIRECTIONS:
            times[directions].append(pyramid(tool, directions, folder))
    step = {directions: statistics.median(run[2] for run in times[directions]) for directions in DIRECTIONS}

    def row(what, of):
        return [what, *(of(directions) for directions in DIRECTIONS)]

    def standing(stacks, awake):
        return lambda directions: str(sum(stands(tool, directions, awake, *stack, folder) for stack in stacks))

    small = [(2, size, 0, 0) for size in SMALL]
    askew = [(aside, seed) for aside in (0, 0.02) for seed in range(3)]
    large, tall = [(*of, *how) for of in LARGE for how in askew], [(30, 1, *how) for how in askew]
    rows = [row(f"`hard/pyramid_1240`, {STEPS} steps: deepest contact, greatest speed at the end",
                lambda directions: "{:.1f} mm, {:.1f} mm/s".format(*times[directions][0])),
            row(f"its step (medians of {ROUNDS} runs in turns)", lambda directions: f"{step[directions] / step['one']:.2f}"),
            row("2 cubes of 5 to 100 mm, kept awake: stand for 10 s, of 10", standing(small, True)),
            row("10 cubes of 0.3 m, and 15 to 25 of 1 m, that may sleep: stand for 10 s, of 24", standing(large, False)),
            row("the same, kept awake", standing(large, True)),
            row("30 cubes of 1 m that may sleep: stand for 10 s, of 6", standing(tall, False))]
    return ["", *(f"`{directions}`" for directions in DIRECTIONS)], rows, ["---", "---:", "---:"]


if __name__ == "__main__":
    table_script(__doc__, "friction directions", table)
