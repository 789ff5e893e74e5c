# SPDX-License-Identifier: MIT
"""Motion without contact."""
import math

from closed_form.parts import (BOUNCES, DT, G, LYING, SUBSTEPS, Case, ball, body, box, cylinder, period, world)  # noqa: F401

TEXTBOOK = "Landau and Lifshitz, Mechanics"


def elliptic_k(k):
    """The complete elliptic integral of the first kind, by the arithmetic-geometric mean."""
    a, b = 1.0, math.sqrt(1 - k * k)
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


def euler(moments, spin, seconds, dt=1e-4):
    """Angular velocities in a body's own axes, by Runge and Kutta."""
    def rate(w):
        a, b, c = moments
        return ((b - c) / a * w[1] * w[2], (c - a) / b * w[2] * w[0], (a - b) / c * w[0] * w[1])
    w, path = tuple(spin), [tuple(spin)]
    for _ in range(round(seconds / dt)):
        k1 = rate(w)
        k2 = rate([x + dt / 2 * k for x, k in zip(w, k1)])
        k3 = rate([x + dt / 2 * k for x, k in zip(w, k2)])
        k4 = rate([x + dt * k for x, k in zip(w, k3)])
        w = tuple(x + dt / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(w, k1, k2, k3, k4))
        path.append(w)
    return path


def box_moments(half, mass):
    x, y, z = (2 * h for h in half)
    return [mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)]


def own(f, vector):
    """A vector of the world in the axes of a body."""
    x, y, z, w = -f["qx"], -f["qy"], -f["qz"], f["qw"]
    vx, vy, vz = vector
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx)


def own_spin(f):
    return own(f, (f["wx"], f["wy"], f["wz"]))


def falls():
    yield Case("free_fall", "A ball falls for 2 s.", "g t^2 / 2", TEXTBOOK, G * 2, world(2, [body("ball")], [ball(0.1)]),
               lambda r: -r.end(0, "y"), SUBSTEPS, unit="m")
    v = 20 * math.sin(math.pi / 4)
    thrown = world(3, [body("ball", velocity=[v, v, 0])], [ball(0.1)])
    yield Case("apex", "A ball is thrown at 20 m/s and 45 degrees: how high.", "v^2 sin^2 a / 2 g", TEXTBOOK,
               v * v / 2 / G, thrown, lambda r: max(r.peaks(0, "y"), default=math.nan), SUBSTEPS, unit="m")
    yield Case("range", "The same: how far until it is as low as it was.", "v^2 sin 2 a / g", TEXTBOOK, 2 * v * v / G,
               thrown, lambda r: r.at(0, "x", r.crossings(0, "y")[-1]), SUBSTEPS, unit="m")
    yield Case("terminal_linear", "A ball falls in oil: speed in the end.", "m g / c", "Stokes", G / 2,
               world(5, [body("ball")], [ball(0.1)], fields=[{"type": "drag", "linear": 2}]),
               lambda r: -r.end(0, "vy"), SUBSTEPS, unit="m/s")
    yield Case("terminal_quadratic", "A ball falls in air: speed in the end.", "sqrt(m g / k)", "Newton",
               math.sqrt(G / 0.05), world(10, [body("ball")], [ball(0.1)], fields=[{"type": "drag", "quadratic": 0.05}]),
               lambda r: -r.end(0, "vy"), SUBSTEPS, unit="m/s")
    yield Case("drag_decay", "A ball glides in oil: speed after 2 s.", "v e^(-c t / m)", "Stokes", 10 * math.exp(-2),
               world(2, [body("ball", velocity=[10, 0, 0])], [ball(0.1)], gravity=(0, 0, 0),
                     fields=[{"type": "drag", "linear": 1}]), lambda r: r.end(0, "vx"), SUBSTEPS, unit="m/s")
    yield Case("damping", "Damping of 0.5: speed after 2 s.", "v (1 - d)^t", "Bullet's definition", 2.5,
               world(2, [body("ball", velocity=[10, 0, 0], linear_damping=0.5)], [ball(0.1)], gravity=(0, 0, 0)),
               lambda r: r.end(0, "vx"), SUBSTEPS, unit="m/s")


def springs():
    def held(stiffness, damping, seconds):
        return world(seconds, [body("ball", velocity=[1, 0, 0])], [ball(0.1)], gravity=(0, 0, 0),
                     joints=[{"type": "spring", "a": "b", "pivot": [0, 0, 0], "stiffness": stiffness,
                              "damping": damping}]) | {}
    def named(scene):
        scene["bodies"][0]["name"] = "b"
        return scene
    yield Case("spring_period", "1 kg on a spring of 100 N/m.", "2 pi sqrt(m / k)", TEXTBOOK, 2 * math.pi / 10,
               named(held(100, 0, 5)), lambda r: period(r, 0, "x"), SUBSTEPS, unit="s")
    yield Case("spring_amplitude", "The same, pushed with 1 m/s: how far in the fifth second.", "v sqrt(m / k)", TEXTBOOK, 0.1,
               named(held(100, 0, 5)), lambda r: max(r.peaks(0, "x")[-2:], default=math.nan), SUBSTEPS, unit="m")
    yield Case("spring_stiff", "1 kg on a spring of 10 kN/m, whose period is four steps.", "2 pi sqrt(m / k)", TEXTBOOK,
               2 * math.pi / 100, named(held(10000, 0, 2)), lambda r: period(r, 0, "x"), SUBSTEPS, unit="s")
    decay = math.exp(-1 * 2 * math.pi / math.sqrt(99))
    yield Case("spring_damped", "1 kg on a spring of 100 N/m with 2 N s/m: a peak over the one before.",
               "e^(-c T / 2 m)", TEXTBOOK, decay, named(held(100, 2, 3)),
               lambda r: (lambda p: p[1] / p[0] if len(p) > 1 else math.nan)(r.peaks(0, "x")), SUBSTEPS)


def pendulums():
    def hung(degrees, seconds, radius=0.1):
        a = math.radians(degrees)
        return world(seconds, [body("ball", (math.sin(a), -math.cos(a), 0), name="bob")], [ball(radius)],
                     joints=[{"type": "ball", "a": "bob", "pivot": [0, 0, 0]}])
    length = 1 + 0.4 * 0.1 ** 2
    slow = 2 * math.pi * math.sqrt(length / G)
    yield Case("pendulum_small", "A ball of 10 cm on a rod of 1 m, let go at 5 degrees: period.",
               "4 sqrt(I / m g L) K(sin a/2)", TEXTBOOK, slow * 2 / math.pi * elliptic_k(math.sin(math.radians(2.5))),
               hung(5, 20), lambda r: period(r, 0, "x"), SUBSTEPS, unit="s")
    yield Case("pendulum_large", "The same, let go at 90 degrees.", "4 sqrt(I / m g L) K(sin a/2)", TEXTBOOK,
               slow * 2 / math.pi * elliptic_k(math.sin(math.pi / 4)), hung(90, 20), lambda r: period(r, 0, "x"),
               SUBSTEPS, unit="s")
    yield Case("pendulum_height", "The same: how far below the pivot it comes to rest after 20 s.", "the height is kept", TEXTBOOK, 1.0,
               hung(90, 20), lambda r: 1 + max(r.series(0, "y")[-120:]), (*SUBSTEPS, "dantzig, 4 substeps"), unit="m")
    rod = world(20, [body("rod", (0.5 * math.sin(math.radians(5)), -0.5 * math.cos(math.radians(5)), 0), name="rod",
                          rotation={"axis": [0, 0, 1], "degrees": 5})], [box((0.05, 0.5, 0.05), "rod")],
                joints=[{"type": "hinge", "a": "rod", "pivot": [0, 0, 0], "axis": [0, 0, 1]}])
    moment = (1 + 0.01) / 12 + 0.25
    yield Case("pendulum_rod", "A rod of 1 m hung at its end, let go at 5 degrees: period.",
               "4 sqrt(I / m g L) K(sin a/2)", TEXTBOOK,
               4 * math.sqrt(moment / G / 0.5) * elliptic_k(math.sin(math.radians(2.5))), rod,
               lambda r: period(r, 0, "x"), SUBSTEPS, unit="s")
    slow_mode = 3 - 6 / math.sqrt(7)
    bends = (3 / 2 - 4 * slow_mode / 3) / (slow_mode / 2)
    upper, lower = math.radians(2), math.radians(2 * bends)
    knee = math.sin(upper), -math.cos(upper)
    rods = [body("rod", place, name=name, inertia=[1 / 12, 0.001, 1 / 12], rotation={"axis": [0, 0, 1], "degrees": math.degrees(angle)})
            for name, angle, place in (("upper", upper, (knee[0] / 2, knee[1] / 2, 0)),
                                       ("lower", lower, (knee[0] + math.sin(lower) / 2, knee[1] - math.cos(lower) / 2, 0)))]
    double = world(20, rods, [box((0.02, 0.5, 0.02), "rod")],
                   joints=[{"type": "hinge", "a": "upper", "pivot": [0, 0, 0], "axis": [0, 0, 1]},
                           {"type": "hinge", "a": "lower", "b": "upper", "pivot": [*knee, 0], "axis": [0, 0, 1]}])
    both = "2 pi sqrt(L / (3 - 6/sqrt 7) g)", TEXTBOOK, 2 * math.pi / math.sqrt(slow_mode * G)
    yield Case("pendulum_double", "Two rods of 1 m on hinges swing by 2 and 2.9 degrees, in the slower of their two ways: period.", *both, double,
               lambda r: period(r, 0, "x"), ("2 substeps", "4 substeps", "8 substeps", "dantzig", "multibodies"), unit="s")
    yield Case("multibody_pendulum", "The same as a multibody.", *both, double | {"solver": {"kind": "multibodies"}},
               lambda r: period(r, 0, "x"), ("2 substeps", "4 substeps"), unit="s")
    a = math.radians(30)
    turn = math.sqrt(G / math.cos(a) / 1.0)
    cone = hung(30, 10)
    # As one piece with its rod it would have a moment about itself; a ball turns freely, so it is small.
    cone["bodies"][0] |= {"velocity": [0, 0, -turn * math.sin(a)], "spin": [0, turn, 0]}
    yield Case("pendulum_conical", "A ball goes round at 30 degrees: turns in 10 s.", "sqrt(g / L cos a)", TEXTBOOK,
               turn * 10, cone, lambda r: unwound(r, 0), SUBSTEPS, unit="rad")
    ring = hung(90, 10)
    ring["world"]["gravity"] = [0, 0, 0]
    ring["bodies"][0] |= {"position": [1, 0, 0], "velocity": [0, 0, -10], "spin": [0, 10, 0]}
    yield Case("whirled", "A ball is whirled round at 10 m/s: its distance after 10 s.", "it stays", TEXTBOOK, 1.0, ring,
               lambda r: math.hypot(r.end(0, "x"), r.end(0, "z")), (*SUBSTEPS, "dantzig"), unit="m")
    yield Case("whirled_speed", "The same: its speed after 10 s.", "it stays", TEXTBOOK, 10.0, ring,
               lambda r: math.hypot(r.end(0, "vx"), r.end(0, "vz")), (*SUBSTEPS, "dantzig", "dantzig, 4 substeps"), unit="m/s")


def unwound(run, body_number):
    """How far a body has gone round y."""
    last = total = None
    for x, z in zip(run.series(body_number, "x"), run.series(body_number, "z")):
        angle = math.atan2(-z, x)
        if last is None:
            total = 0.0
        else:
            total += math.remainder(angle - last, 2 * math.pi)
        last = angle
    return total


def free_bodies():
    half = (0.5, 0.1, 0.25)
    moments = box_moments(half, 1)  # y is the largest, x the least, z between them
    spin = (0.01, 0.0, 5.0)
    path = euler(moments, spin, 60)
    flips = [i * 1e-4 for i in range(1, len(path)) if path[i - 1][2] * path[i][2] < 0]
    scene = world(60, [body("racket", spin=list(spin), name="racket")], [box(half, "racket")], gravity=(0, 0, 0))
    scene["bodies"][0] |= {"inertia": moments}

    def flips_of(r):
        w = [own_spin(step[0])[2] for step in r.steps]
        return [(i - 1 + w[i - 1] / (w[i - 1] - w[i])) * r.dt for i in range(1, len(w)) if w[i - 1] * w[i] < 0]

    yield Case("racket_first_flip", "A racket spins about its middle axis: when it flips first.",
               "Euler's equations, by Runge and Kutta with 0.1 ms", TEXTBOOK, flips[0], scene,
               lambda r: next(iter(flips_of(r)), math.nan), SUBSTEPS, unit="s")
    yield Case("racket_flips", "The same: flips in 60 s.", "Euler's equations", TEXTBOOK, float(len(flips)), scene,
               lambda r: float(len(flips_of(r))), SUBSTEPS)

    def energy(f):
        return sum(m * w * w for m, w in zip(moments, own_spin(f))) / 2

    yield Case("racket_energy", "The same: energy after 60 s over that at the start.", "it stays", TEXTBOOK, 1.0, scene,
               lambda r: energy(r.steps[-1][0]) / energy(r.steps[0][0]), SUBSTEPS)
    # A disc that wobbles: its axis goes round at L / I.
    radius, height = 0.5, 0.1
    along, across = 0.5 * radius ** 2, (3 * radius ** 2 + height ** 2) / 12
    disc = world(5, [body("disc", spin=[1.0, 10.0, 0], inertia=[across, along, across])], [cylinder(radius, height, "disc")],
                 gravity=(0, 0, 0))
    turn = math.hypot(along * 10, across * 1) / across

    def wobble(r):
        last, total = None, 0.0
        l = (across, along * 10, 0)
        size = math.hypot(*l)
        e = [c / size for c in l]
        for step in r.steps:
            f = step[0]
            axis = own({"qx": -f["qx"], "qy": -f["qy"], "qz": -f["qz"], "qw": f["qw"]}, (0, 1, 0))
            # In the plane across the angular momentum, which lies in x and y.
            u = axis[0] * e[1] - axis[1] * e[0]
            angle = math.atan2(-axis[2], u)
            if last is not None:
                total += math.remainder(angle - last, 2 * math.pi)
            last = angle
        return abs(total)

    yield Case("wobble", "A thrown disc wobbles: how far its axis has gone round in 5 s.", "L t / I", TEXTBOOK, turn * 5,
               disc, wobble, SUBSTEPS, unit="rad")
    # A gyroscope whose axis is level goes round steadily.
    spin, arm = 100.0, 0.5
    along = 0.5 * radius ** 2
    rate = G * arm / (along * spin)
    # Its axis is x; it turns about the vertical at the same time.
    gyro = world(4, [body("disc", (arm, 0, 0), name="disc", rotation={"axis": [0, 0, 1], "degrees": -90},
                          spin=[spin, rate, 0], velocity=[0, 0, -rate * arm], inertia=[across, along, across])],
                 [cylinder(radius, height, "disc")], joints=[{"type": "ball", "a": "disc", "pivot": [0, 0, 0]}])
    yield Case("gyroscope", "A gyroscope of 1 kg on an arm of 0.5 m, 100 rad/s: how far it goes round in 4 s.",
               "m g r t / I w", TEXTBOOK, rate * 4, gyro, lambda r: unwound(r, 0), SUBSTEPS, unit="rad")
    yield Case("gyroscope_level", "The same: its height.", "it stays level", TEXTBOOK, 0.0, gyro,
               lambda r: r.end(0, "y"), (*SUBSTEPS, "dantzig, 4 substeps", "dantzig, 16 substeps"), scale=0.5, unit="m")


def driven():
    flywheel = world(2, [body("disc", name="disc", inertia=[0.07, 0.125, 0.07])], [cylinder(0.5, 0.1, "disc")], gravity=(0, 0, 0),
                     joints=[{"type": "hinge", "a": "disc", "pivot": [0, 0, 0], "axis": [0, 1, 0],
                              "motor": {"speed": 100, "max_force": 1}}])
    yield Case("motor_torque", "A motor of 1 N m turns a flywheel of 0.125 kg m^2 for 2 s.", "M t / I", TEXTBOOK, 16.0,
               flywheel, lambda r: abs(r.end(0, "wy")), SUBSTEPS, unit="rad/s")
    sled = world(2, [body("ball", name="sled", mass=2)], [ball(0.1)], gravity=(0, 0, 0),
                 joints=[{"type": "slider", "a": "sled", "pivot": [0, 0, 0], "axis": [1, 0, 0],
                          "motor": {"speed": 100, "max_force": 5}}])
    yield Case("motor_force", "A motor of 5 N pushes 2 kg for 2 s.", "F t^2 / 2 m", TEXTBOOK, 5.0, sled,
               lambda r: r.end(0, "x"), SUBSTEPS, unit="m")
    for word, ratio in (("gear", 2), ("belt", -2)):
        wheels = world(2, [body("disc", (0, 0, 0), name="a", inertia=[0.07, 0.125, 0.07]), body("disc", (2, 0, 0), name="b", inertia=[0.07, 0.5, 0.07])],
                       [cylinder(0.5, 0.1, "disc")], gravity=(0, 0, 0),
                       joints=[{"type": "hinge", "a": "a", "pivot": [0, 0, 0], "axis": [0, 1, 0], "motor": {"speed": 100, "max_force": 1}},
                               {"type": "hinge", "a": "b", "pivot": [2, 0, 0], "axis": [0, 1, 0]},
                               {"type": "gear", "a": "a", "b": "b", "pivot": [1, 0, 0], "axis": [0, 1, 0], "ratio": ratio}])
        sign = -1 if ratio > 0 else 1
        yield Case(f"motor_{word}", f"The same wheel turns one of 0.5 kg m^2 half as fast over a {word}: how fast that is.", "M t / n (I + J / n^2)",
                   TEXTBOOK, sign * 2 / 2 / (0.125 + 0.5 / 4), wheels, lambda r: r.end(1, "wy"), ("2 substeps", "4 substeps", "50 iterations", "dantzig"), unit="rad/s")
    for share, holds in ((0.95, 0), (1.05, 1)):
        arm = world(3, [body("ball", (1, 0, 0), name="arm")], [ball(0.1)],
                    joints=[{"type": "hinge", "a": "arm", "pivot": [0, 0, 0], "axis": [0, 0, 1],
                             "motor": {"speed": 0, "max_force": share * G}}])
        word = "holds" if holds else "gives"
        yield Case(f"motor_{word}", f"A motor with {share:g} of the torque that a level arm takes: does it hold for 3 s?",
                   "M = m g L", TEXTBOOK, float(holds), arm, lambda r: float(r.end(0, "y") > -0.2), SUBSTEPS, scale=1)
        yield Case(f"multibody_motor_{word}", "The same as a multibody.", "M = m g L", TEXTBOOK, float(holds),
                   arm | {"solver": {"kind": "multibodies"}}, lambda r: float(r.end(0, "y") > -0.2), SUBSTEPS, scale=1)
    yield Case("multibody_motor_torque", "A motor of 1 N m turns a flywheel of 0.125 kg m^2 for 2 s, as a multibody.", "M t / I", TEXTBOOK, 16.0,
               flywheel | {"solver": {"kind": "multibodies"}}, lambda r: abs(r.end(0, "wy")), SUBSTEPS, unit="rad/s")


def floating():
    def afloat(density, half, depth, seconds, drag):
        return world(seconds, [body("box", (0, half[1] - depth, 0), mass=density * 8 * half[0] * half[1] * half[2],
                                    spin=[0, 0, 0])], [box(half)],
                     fields=[{"type": "buoyancy", "level": 0, "density": 1000, "drag": drag}])
    for density in (300, 500, 850):
        yield Case(f"draught_{density}", f"A cube of 1 m and {density} kg/m^3 floats: how much of it is under water.",
                   "density over that of water", "Archimedes", density / 1000,
                   afloat(density, (0.5, 0.5, 0.5), density / 1000, 20, 1), lambda r: 0.5 - r.end(0, "y"), SUBSTEPS,
                   tolerance=0.02, unit="m")
    flat = afloat(500, (1, 0.25, 1), 0.35, 10, 0)
    yield Case("heave", "A raft of 0.5 m, half under water, bobs: period.", "2 pi sqrt(draught / g)", "Archimedes",
               2 * math.pi * math.sqrt(0.25 / G), flat, lambda r: period(r, 0, "y"), SUBSTEPS, tolerance=0.02, unit="s")


def cases():
    for family in (falls, springs, pendulums, free_bodies, driven, floating):
        yield from family()
