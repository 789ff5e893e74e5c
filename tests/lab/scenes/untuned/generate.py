#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Random scenes, made from a seed, at default settings, of sizes, masses, speeds and loads that hold
and that do not.

    python3 tests/lab/scenes/untuned/generate.py --seed 1 --count 200 --into FOLDER
"""
import argparse
import json
import math
import pathlib
import random

G = 9.81
GROUND = {"shape": "ground", "type": "static", "position": [0, -1, 0]}


def log(chance, low, high):
    return math.exp(chance.uniform(math.log(low), math.log(high)))


def box(name, *half):
    return {"name": name, "type": "box", "half_extents": list(half)}


def hull(name, half):
    return {"name": name, "type": "hull", "points": [[x, y, z] for x in (-half, half) for y in (-half, half) for z in (-half, half)]}


def ground_of(size):
    return box("ground", 40 * size, 1, 40 * size)


def world(shapes, bodies, seconds, size=1.0, joints=(), gravity=(0, -G, 0), **more):
    made = {"time": {"dt": 1 / 60, "steps": round(seconds * 60)},
            "world": {"gravity": list(gravity), "bounds": {"min": [-100 * size - 10] * 3, "max": [100 * size + 10] * 3}},
            "shapes": shapes, "bodies": bodies, **more}
    if joints:
        made["joints"] = list(joints)
    return made


def stack(chance):
    """Cubes, boxes or hulls, all alike or the uppermost heavier."""
    half, count, load = log(chance, 0.01, 1), chance.randint(2, 24), chance.choice([1, 1, log(chance, 1, 500)])
    shape = chance.choice([box("b", half, half, half), hull("b", half)])
    mass = 1000 * 8 * half**3
    bodies = [{"shape": "b", "mass": mass * (load if i == count - 1 else 1), "position": [chance.uniform(-0.01, 0.01) * half, half * (2 * i + 1), 0]}
              for i in range(count)]
    return world([ground_of(half), shape], [GROUND, *bodies], 5, half)


def chain(chance):
    """Links that hang or swing, with a ball at the end."""
    count, load, pitch = chance.randint(2, 30), log(chance, 0.5, 1000), log(chance, 0.1, 1)
    angle = chance.choice([0, 0, chance.uniform(0.1, 0.8)])
    along = (math.sin(angle), -math.cos(angle), 0)
    at = lambda way: [way * d for d in along]  # noqa: E731
    links = [{"name": f"l{i}", "shape": "link", "mass": 1, "position": at(pitch * (i + 0.5)), "rotation": {"axis": [0, 0, 1], "degrees": math.degrees(angle)}}
             for i in range(count)]
    links.append({"name": f"l{count}", "shape": "end", "mass": load, "position": at(pitch * (count + 0.5))})
    joints = [{"type": "ball", "a": "l0", "pivot": at(0)},
              *({"type": "ball", "a": f"l{i}", "b": f"l{i - 1}", "pivot": at(pitch * i)} for i in range(1, count + 1))]
    return world([{"name": "link", "type": "capsule", "radius": 0.15 * pitch, "height": 0.5 * pitch}, {"name": "end", "type": "sphere", "radius": 0.4 * pitch}],
                 links, 4, count * pitch, joints)


def pendulum(chance):
    arm, angle = log(chance, 0.05, 5), chance.choice([0, chance.uniform(0.2, 1.5)])
    ball = {"name": "b", "shape": "ball", "mass": log(chance, 0.1, 50), "position": [arm * math.sin(angle), -arm * math.cos(angle), 0]}
    return world([{"name": "ball", "type": "sphere", "radius": 0.2 * arm}], [ball], 6, arm, [{"type": "ball", "a": "b", "pivot": [0, 0, 0]}])


def spring(chance):
    mass, period = log(chance, 0.1, 50), log(chance, 0.05, 3)
    ball = {"name": "b", "shape": "ball", "mass": mass, "position": [0, 0, 0], "velocity": [1, 0, 0]}
    return world([{"name": "ball", "type": "sphere", "radius": 0.2}], [ball], 4, 1,
                 [{"type": "spring", "a": "b", "pivot": [0, 0, 0], "stiffness": mass * (2 * math.pi / period)**2, "damping": 0}], gravity=(0, 0, 0))


def motor(chance):
    arm = log(chance, 0.1, 2)
    bar = {"name": "b", "shape": "bar", "mass": 2, "position": [arm, 0, 0]}
    return world([box("bar", arm, 0.1 * arm, 0.1 * arm)], [bar], 4, arm,
                 [{"type": "hinge", "a": "b", "pivot": [0, 0, 0], "axis": [0, 1, 0], "motor": {"speed": log(chance, 0.5, 60), "max_force": 1e4}}])


def thrown(chance):
    size = log(chance, 0.02, 2)
    body = {"shape": "b", "mass": 1, "position": [0, 0, 0], "velocity": [chance.uniform(-5, 5), log(chance, 0.5, 30), 0], "spin": [chance.uniform(-20, 20) for _ in range(3)]}
    return world([box("b", size, 0.6 * size, 0.3 * size)], [body], 1.5, 10)


def spinning(chance):
    half = [log(chance, 0.05, 0.5) for _ in range(3)]
    body = {"shape": "b", "mass": 1, "position": [0, 0, 0], "spin": [chance.uniform(-1, 1), log(chance, 1, 200), chance.uniform(-1, 1)]}
    return world([box("b", *half)], [body], 5, 1, gravity=(0, 0, 0))


def bouncing(chance):
    radius = log(chance, 0.02, 0.5)
    rubber = {"friction": 0.5, "restitution": chance.choice([0, 0, chance.uniform(0.2, 1)])}
    ball = {"shape": "ball", "mass": 1, "position": [0, radius * chance.uniform(1, 8), 0], "material": "m"}
    return world([ground_of(1), {"name": "ball", "type": "sphere", "radius": radius}], [{**GROUND, "material": "m"}, ball], 3, materials={"m": rubber})


def sliding(chance):
    half, friction = log(chance, 0.05, 0.5), chance.uniform(0.1, 0.8)
    speed = chance.choice([0, log(chance, 0.3, 8)])
    wood = {"friction": math.sqrt(friction), "restitution": 0}
    body = {"shape": "b", "mass": 2, "position": [0, half, 0], "velocity": [speed, 0, 0], "material": "m"}
    return world([ground_of(1), box("b", 3 * half, half, 2 * half)], [{**GROUND, "material": "m"}, body], 3, materials={"m": wood})


def shot(chance):
    radius, speed = log(chance, 0.005, 0.2), log(chance, 1, 300)
    wall = {"shape": "wall", "type": "static", "position": [3, 0, 0]}
    ball = {"shape": "ball", "mass": 1, "position": [0, 0, 0], "velocity": [speed, 0, 0]}
    return world([box("wall", log(chance, 0.005, 0.3), 2, 2), {"name": "ball", "type": "sphere", "radius": radius}], [wall, ball], 1, 2, gravity=(0, 0, 0))


def sunk(chance):
    half = log(chance, 0.05, 0.5)
    depth = chance.choice([0, 0.002, chance.uniform(0.1, 1)]) * half
    cubes = [{"shape": "b", "mass": 1, "position": [4 * half * i, half - depth, 0]} for i in range(chance.randint(1, 4))]
    return world([ground_of(1), box("b", half, half, half)], [GROUND, *cubes], 2, solver={"split_impulse": chance.random() < 0.5})


def limited(chance):
    low = chance.uniform(-0.8, 0.6)
    bar = {"name": "b", "shape": "bar", "mass": 2, "position": [0.6, 0, 0]}
    return world([box("bar", 0.5, 0.05, 0.05)], [bar], 2, 1,
                 [{"type": "hinge", "a": "b", "pivot": [0, 0, 0], "axis": [0, 0, 1], "limits": [low, low + chance.uniform(0.3, 1)]}], gravity=(0, 0, 0))


def falling(chance):
    size = log(chance, 0.001, 1)
    body = {"shape": "b", "mass": 1, "position": [0, size * chance.uniform(1.0, 4), 0]}
    return world([ground_of(1), box("b", size, size, size)], [GROUND, body], 2)


def gliding(chance):
    far = chance.choice([0, log(chance, 10, 9e4)])
    body = {"shape": "ball", "mass": 1, "position": [far, 0, 0], "velocity": [log(chance, 0.02, 5), 0, 0]}
    made = world([{"name": "ball", "type": "sphere", "radius": 0.2}], [body], 4, 1, gravity=(0, 0, 0))
    made["world"]["bounds"] = {"min": [-1e5] * 3, "max": [1e5] * 3}
    return made


KINDS = [stack, stack, chain, chain, pendulum, spring, motor, thrown, spinning, bouncing, sliding, shot, sunk, limited, falling, gliding]


def scene(seed, number):
    """The number-th scene of a seed."""
    chance = random.Random(f"{seed} {number}")
    kind = KINDS[number % len(KINDS)]
    return {"format": 1, "meta": {"name": f"{kind.__name__}_{number}", "about": (kind.__doc__ or kind.__name__).strip()}} | kind(chance)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--into", type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.into.mkdir(parents=True, exist_ok=True)
    for number in range(options.count):
        made = scene(options.seed, number)
        (options.into / f"{made['meta']['name']}.json").write_text(json.dumps(made) + "\n")


if __name__ == "__main__":
    main()
