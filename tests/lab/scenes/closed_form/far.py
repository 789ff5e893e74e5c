# SPDX-License-Identifier: MIT
"""Worlds far from the origin, and ways made of steps that are small against where they begin: what limits them is how
many places numbers can tell apart. Between 65 and 131 km floats are 7.8 mm apart, doubles 15 pm."""
import math

from closed_form.moving import TEXTBOOK, elliptic_k
from closed_form.parts import DT, G, Case, ball, body, box, ground, materials, on_slope, period, world, GROUND

DOUBLE = ("8 substeps", "double")
ROUGH = materials(one=(1, 0))


def moved(scene, by):
    """All of a scene, and what is expected of its bounds, somewhere else."""
    put = lambda place: [x + d for x, d in zip(place, by)]  # noqa: E731
    out = dict(scene, bodies=[dict(one, position=put(one["position"])) for one in scene["bodies"]])
    out["world"] = dict(scene["world"], bounds={"min": [-100000] * 3, "max": [100000] * 3})
    if "joints" in scene:
        out["joints"] = [dict(one, pivot=put(one["pivot"])) for one in scene["joints"]]
    return out


def flights():
    for far, speed, seconds, dt, why in ((90_000, 0.1, 20, DT, "90 km away"), (12_000, 0.05, 20, DT, "12 km away"),
                                         (1_000, 1.0, 1, 1e-4, "1 km away and in steps of 0.1 ms")):
        scene = moved(world(seconds, [body("ball", velocity=[speed, 0, 0])], [ball(0.1)], dt=dt, gravity=(0, 0, 0)), (far, 0, 0))
        yield Case(f"far_glide_{far}", f"A ball glides at {speed:g} m/s, {why}: its way in {seconds} s.", "v t", "Galilei", speed * seconds,
                   scene, lambda r, far=far: r.end(0, "x") - far, DOUBLE, unit="m")
    seconds = 2000
    scene = world(seconds, [body("ball", velocity=[0.02, 0, 0])], [ball(0.1)], dt=1 / 50, gravity=(0, 0, 0))
    yield Case("far_glide_long", "A ball glides at 2 cm/s from the origin for 100 000 steps: its way.", "v t", "Galilei", 0.02 * seconds,
               scene, lambda r: r.end(0, "x"), DOUBLE, unit="m")
    yield Case("far_fall", "A ball falls for 2 s, 90 km up.", "g t^2 / 2", TEXTBOOK, G * 2,
               moved(world(2, [body("ball")], [ball(0.1)]), (0, 90_000, 0)), lambda r: 90_000 - r.end(0, "y"), DOUBLE, unit="m")


def pendulums():
    radius, arm, angle = 0.1, 1.0, math.radians(20)
    inertia = 0.4 * radius * radius + arm * arm
    truth = 4 * math.sqrt(inertia / (G * arm)) * elliptic_k(math.sin(angle / 2))
    for far in (10_000, 90_000):
        hung = body("ball", (arm * math.sin(angle), -arm * math.cos(angle), 0), name="b")
        scene = moved(world(20, [hung], [ball(radius)], joints=[{"type": "ball", "a": "b", "pivot": [0, 0, 0]}]), (far, 0, 0))
        yield Case(f"far_pendulum_{far}", f"A ball of 10 cm on a rod of 1 m, let go at 20 degrees, {far // 1000} km away: period.",
                   "4 sqrt(I / m g L) K(sin a/2)", TEXTBOOK, truth, scene, lambda r, far=far: period(r, 0, "x", far),
                   ("8 substeps", "double", "double, 4 substeps", "double, 8 substeps"), unit="s")


def contacts():
    degrees, seconds = 10, 3
    shape = ball(0.2)
    scene = world(seconds, [ground("one"), body("ball", (0, 0.2, 0), material="one")], [GROUND, shape], gravity=on_slope(degrees), materials=ROUGH)
    yield Case("far_roll", "A ball of 20 cm rolls down a slope of 10 degrees, 90 km away: its way in 3 s.", "5/7 g sin a t^2 / 2", TEXTBOOK,
               5 / 7 * G * math.sin(math.radians(degrees)) * seconds ** 2 / 2, moved(scene, (90_000, 0, 0)),
               lambda r: r.end(1, "x") - 90_000, ("8 substeps", "double", "double, 4 substeps", "double, 8 substeps"), unit="m")
    for size, far in ((1, 90_000), (0.1, 9_000), (0.01, 9_000), (0.001, 900)):
        half = size / 2
        floor = box((100 * size,) * 3, "ground")
        scene = world(5, [{"shape": "ground", "type": "static", "position": [0, -100 * size, 0]}, body("it", (0, 1.1 * half, 0), size ** 3 * 1000)],
                      [floor, box((half,) * 3, "it")])
        yield Case(f"far_rest_{size:g}_{far}", f"A cube of {size * 1000:g} mm is dropped on a box by a twentieth of that, {far} m up: its height after 5 s.", "half of it", "geometry", half,
                   moved(scene, (0, far, 0)), lambda r, far=far: r.end(1, "y") - far, ("8 substeps", "double", "double, 4 substeps"), unit="m")
    speed, friction, far = 2.0, 0.25, 90_000
    scene = world(3, [ground("half"), body("box", (0, 0.1, 0), material="half", velocity=[speed, 0, 0])], [GROUND, box((0.3, 0.1, 0.3))],
                  materials=materials(half=(math.sqrt(friction), 0)))
    yield Case("far_skid", f"A flat box of friction 0.25 is pushed with 2 m/s, {far // 1000} km away: its way.", "v^2 / 2 mu g", "Coulomb",
               speed ** 2 / (2 * friction * G), moved(scene, (far, 0, 0)), lambda r, far=far: r.end(1, "x") - far,
               ("8 substeps", "double", "double, 4 substeps", "double, 8 substeps"), unit="m")
    side, far = 0.2, 20_000
    scene = world(20, [ground("one"), *(body("box", (0, side * (i + 0.5), 0), material="one") for i in range(4))],
                  [GROUND, box((side / 2,) * 3)], materials=ROUGH)
    yield Case("far_stack", f"A stack of four cubes of 20 cm, {far // 1000} km up: its height after 20 s.", "it stands", TEXTBOOK, 3.5 * side,
               moved(scene, (0, far, 0)), lambda r, far=far: r.end(4, "y") - far, DOUBLE, unit="m")


def cases():
    for family in (flights, pendulums, contacts):
        yield from family()
