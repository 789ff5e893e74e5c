# SPDX-License-Identifier: MIT
"""Motion with contact."""
import math

from closed_form.parts import (BOUNCES, FIRM, G, GROUND, HEAVY, LYING, SUBSTEPS, Case, ball, body, box, cylinder, ground,
                               materials, on_slope, world)

TEXTBOOK = "Landau and Lifshitz, Mechanics"
COULOMB = "Coulomb"
FRICTION = 0.5
SLOPE = math.degrees(math.atan(FRICTION))
ROUGH = materials(rough=(FRICTION, 0), one=(1, 0), ice=(0, 0))


def gliding(seconds, shape, thing, degrees=0.0, material="one", **more):
    """`thing` on the ground, or on a slope: gravity is turned, not the ground."""
    return world(seconds, [ground(material), thing], [GROUND, shape], gravity=on_slope(degrees), reach=300,
                 materials=ROUGH, **more)


def slopes():
    def block(material="rough", **more):
        return body("box", (0, 0.5, 0), material=material, **more)
    cube = box((0.5, 0.5, 0.5))
    def pull(degrees, friction):
        a = math.radians(degrees)
        return G * (math.sin(a) - friction * math.cos(a))
    steep = SLOPE + 1
    yield Case("slides", f"A cube on a slope one degree steeper than its friction ({FRICTION}) holds: its way in 4 s.",
               "g (sin a - mu cos a) t^2 / 2", COULOMB, pull(steep, FRICTION) * 8, gliding(4, cube, block(), steep),
               lambda r: r.end(1, "x"), FIRM, unit="m")
    yield Case("sticks", "The same on one degree less: its way in 4 s, as a share of the one above.", "none", COULOMB, 0.0,
               gliding(4, cube, block(), SLOPE - 1), lambda r: r.end(1, "x"), FIRM, scale=pull(steep, FRICTION) * 8, unit="m")
    yield Case("slides_on_ice", "A cube on a slope of 20 degrees without friction: its way in 3 s.", "g sin a t^2 / 2",
               "Galilei", pull(20, 0) * 4.5, gliding(3, cube, block("ice"), 20), lambda r: r.end(1, "x"), FIRM, unit="m")
    yield Case("skids", "A cube of friction 0.5 is pushed with 5 m/s: its way.", "v^2 / 2 mu g", COULOMB,
               25 / 2 / FRICTION / G, gliding(3, cube, block(velocity=[5, 0, 0])), lambda r: r.end(1, "x"), FIRM, unit="m")
    yield Case("skids_diagonally", "The same along a diagonal of its sides: its way.", "v^2 / 2 mu g", COULOMB, 25 / 2 / FRICTION / G,
               gliding(3, cube, block(velocity=[5 * math.sqrt(0.5), 0, 5 * math.sqrt(0.5)])),
               lambda r: math.hypot(r.end(1, "x"), r.end(1, "z")), (*FIRM, "two friction directions"), unit="m")
    tall = box((0.25, 1, 0.25), "tall")
    corner = math.degrees(math.atan(0.25))
    for degrees, falls in ((corner - 1, 0), (corner + 1, 1)):
        word = "falls" if falls else "stands"
        yield Case(f"column_{word}", f"A column four times as high as wide on a slope of {degrees:.1f} degrees: does it tip in 5 s?",
                   "tan a = w / h", TEXTBOOK, float(falls), gliding(5, tall, body("tall", (0, 1, 0), material="one"), degrees),
                   lambda r: float(r.up(1) < 0.8), FIRM, scale=1)
    belt = world(3, [ground("one") | {"surface_velocity": [2, 0, 0]}, block()], [GROUND, cube], materials=ROUGH)
    yield Case("belt", "A cube is put on a belt of 2 m/s: how far it lags behind.", "v^2 / 2 mu g", COULOMB, 4 / 2 / FRICTION / G,
               belt, lambda r: 6 - r.end(1, "x"), FIRM, unit="m")


def rolling():
    degrees, seconds = 20, 3
    fall = G * math.sin(math.radians(degrees)) * seconds ** 2 / 2
    yield Case("ball_rolls", "A ball rolls down a slope of 20 degrees for 3 s.", "5/7 g sin a t^2 / 2", TEXTBOOK, fall * 5 / 7,
               gliding(seconds, ball(0.5), body("ball", (0, 0.5, 0), material="rough"), degrees),
               lambda r: r.end(1, "x"), FIRM, unit="m")
    for name, about, factor, inertia in (("cylinder_rolls", "A cylinder", 2 / 3, 0.5), ("ring_rolls", "A ring", 1 / 2, 1.0)):
        along, across = inertia * 0.25, (inertia / 2) * 0.25 + 1 / 12
        yield Case(name, f"{about} rolls down a slope of 20 degrees for 3 s.",
                   f"{'2/3' if inertia < 1 else '1/2'} g sin a t^2 / 2", TEXTBOOK, fall * factor,
                   gliding(seconds, cylinder(0.5, 1), body("cylinder", (0, 0.5, 0), material="one", rotation=LYING,
                                                           inertia=[across, along, across]), degrees),
                   lambda r: r.end(1, "x"), FIRM, unit="m")
    yield Case("skid_to_roll", "A billiard ball that slides at 5 m/s comes to roll: at which speed.", "5/7 v", "Coriolis", 25 / 7,
               gliding(3, ball(0.5), body("ball", (0, 0.5, 0), material="rough", velocity=[5, 0, 0])),
               lambda r: r.end(1, "vx"), FIRM, unit="m/s")
    yield Case("backspin", "A ball of 0.5 m with backspin of 20 rad/s at 2 m/s: the speed at which it rolls.",
               "5/7 v - 2/7 r w", "Coriolis", 2 * 5 / 7 - 2 / 7 * 10,
               gliding(5, ball(0.5), body("ball", (0, 0.5, 0), material="rough", velocity=[2, 0, 0], spin=[0, 0, 20])),
               lambda r: r.end(1, "vx"), FIRM, unit="m/s")


def bounce(restitution, height=1.0, seconds=6.0, **more):
    return world(seconds, [ground("elastic"), body("ball", (0, 0.5 + height, 0), material="bouncing", **more)],
                 [GROUND, ball(0.5)], materials=materials(elastic=(0, 1), bouncing=(0, restitution)))


def after(r, number):
    peaks = r.peaks(1, "y")
    return peaks[number - 1] - 0.5 if len(peaks) >= number else 0.0


def bounces():
    for e in (0.25, 0.5, 0.75, 0.9, 1.0):
        yield Case(f"bounce_{e:g}", f"A ball of restitution {e:g} is dropped 1 m: how high it bounces.", "e^2 h", "Newton",
                   e * e, bounce(e), lambda r: after(r, 1), BOUNCES, unit="m")
    yield Case("bounce_0", "A ball of restitution 0 is dropped 1 m: how high it bounces.", "not at all", "Newton", 0.0,
               bounce(0), lambda r: max(after(r, 1), 0), SUBSTEPS, scale=1, unit="m")
    yield Case("bounce_fifth", "A ball of restitution 0.9: its fifth bounce.", "e^10 h", "Newton", 0.9 ** 10, bounce(0.9),
               lambda r: after(r, 5), BOUNCES, unit="m")
    yield Case("bounce_forever", "A ball of restitution 1: its twentieth bounce.", "h", "Newton", 1.0, bounce(1, seconds=20),
               lambda r: after(r, 20), BOUNCES, unit="m")
    yield Case("bounce_comes_to_rest", "A ball of restitution 0.5 is dropped 1 m: its height after 6 s.", "none", "Newton", 0.0,
               bounce(0.5), lambda r: r.end(1, "y") - 0.5, BOUNCES, scale=1, unit="m")
    plate = world(1.5, [ground("elastic"), body("plate", (0, 2.1, 0), material="bouncing")],
                  [GROUND, box((0.5, 0.1, 0.5), "plate")], materials=materials(elastic=(0, 1), bouncing=(0, 0.7)))
    yield Case("plate_bounces", "A plate of restitution 0.7 falls flat from 2 m: how high it bounces.", "e^2 h", "Newton", 0.98, plate,
               lambda r: (max(r.peaks(1, "y"), default=0.1) - 0.1), BOUNCES, unit="m")


def cradle(balls, seconds):
    radius, length = 0.1, 1.0
    a = math.radians(45)
    bodies, joints = [], []
    for i in range(balls):
        x = 2 * radius * i
        place = (x - length * math.sin(a), length - length * math.cos(a), 0) if i == 0 else (x, 0, 0)
        bodies.append(body("ball", place, name=f"b{i}", material="steel"))
        joints.append({"type": "ball", "a": f"b{i}", "pivot": [x, length, 0]})
    return world(seconds, bodies, [ball(radius)], joints=joints, materials=materials(steel=(0, 1)))


def cradles():
    height = 1 - math.cos(math.radians(45))
    for balls in range(2, 8):
        yield Case(f"cradle_{balls}", f"Newton's cradle of {balls} balls, the first lifted by 45 degrees: how high the last one rises.",
                   "L (1 - cos a)", TEXTBOOK, height, cradle(balls, 1.5),
                   lambda r, last=balls - 1: max(r.series(last, "y")), (*BOUNCES, *(f"on contact, dantzig, {n} substeps" for n in (4, 8, 16))), unit="m")
    def energy(step):
        return sum(0.5 * (f["vx"] ** 2 + f["vy"] ** 2 + f["vz"] ** 2) + G * f["y"] for f in step.values())
    yield Case("cradle_energy", "The cradle of 5: energy after 10 s.", "it stays", TEXTBOOK, G * height, cradle(5, 10),
               lambda r: energy(r.steps[-1]), (*BOUNCES, *(f"on contact, dantzig, {n} substeps" for n in (4, 8, 16))), unit="J", tolerance=0.05)


def collisions():
    def two(m, e, offset=0.0, v=4.0, seconds=1.5):
        return world(seconds, [body("ball", (-2.1, offset, 0), material="steel", velocity=[v, 0, 0]),
                               body("ball", (0, 0, 0), mass=m, material="plain")], [ball(0.5)], gravity=(0, 0, 0),
                     materials=materials(steel=(0, 1), plain=(0, e)))
    for m, e in ((1, 1), (3, 1), (0.2, 1), (1, 0.5), (3, 0)):
        v = 4 * (1 + e) / (1 + m)
        yield Case(f"collision_{m:g}_{e:g}", f"A ball of 1 kg and 4 m/s meets one of {m:g} kg head on, restitution {e:g}: the speed of that.",
                   "(1 + e) v m1 / (m1 + m2)", "Newton", v, two(m, e), lambda r: r.end(1, "vx"), (*BOUNCES, *SUBSTEPS[:3]), unit="m/s")
    aim = math.radians(30)
    glancing = two(1, 1, offset=math.sin(aim))
    yield Case("billiard_angle", "A billiard ball is hit 30 degrees off: where it goes.", "along the line of centres", TEXTBOOK, 30.0,
               glancing, lambda r: math.degrees(math.atan2(-r.end(1, "vy"), r.end(1, "vx"))), BOUNCES, unit="degrees")
    yield Case("billiard_speed", "The same: its speed.", "v cos a", TEXTBOOK, 4 * math.cos(aim), glancing,
               lambda r: math.hypot(r.end(1, "vx"), r.end(1, "vy")), BOUNCES, unit="m/s")
    yield Case("billiard_right_angle", "The same: the angle between the two balls afterwards.", "90 degrees", TEXTBOOK, 90.0, glancing,
               lambda r: math.degrees(math.acos(max(-1, min(1, (r.end(0, "vx") * r.end(1, "vx") + r.end(0, "vy") * r.end(1, "vy"))
                                                            / max(1e-9, math.hypot(r.end(0, "vx"), r.end(0, "vy"))
                                                                  * math.hypot(r.end(1, "vx"), r.end(1, "vy"))))))), BOUNCES, unit="degrees")
    three = world(1.5, [body("ball", (-2.1, 0, 0), material="steel", velocity=[4, 0, 0]),
                        body("ball", (0, 0.5, 0), material="steel"), body("ball", (0, -0.5, 0), material="steel")], [ball(0.5)],
                  gravity=(0, 0, 0), materials=materials(steel=(0, 1)))
    yield Case("billiard_break", "A ball hits two that touch, between them: the speed at which it comes back.", "v / 5", TEXTBOOK, 0.8, three,
               lambda r: -r.end(0, "vx"), (*BOUNCES, *SUBSTEPS[:4]), unit="m/s")
    block = world(1, [body("bullet", (-3, 0, 0), mass=0.01, velocity=[800, 0, 0], material="dead"),
                      body("box", (0, 0, 0), mass=4, material="dead")], [ball(0.0025, "bullet"), box((0.5, 0.5, 0.5))],
                  gravity=(0, 0, 0), materials=materials(dead=(0, 0)))
    yield Case("bullet_in_block", "A bullet of 5 mm, 10 g and 800 m/s hits a block of 4 kg: the speed of that.", "v m / (m + M)", "Robins",
               8 / 4.01, block, lambda r: r.end(1, "vx"), SUBSTEPS, unit="m/s")
    plate = world(0.5, [body("bullet", (-3, 0, 0), mass=0.01, velocity=[800, 0, 0], material="dead"),
                        {"shape": "plate", "type": "static", "position": [0, 0, 0], "material": "dead"}],
                  [ball(0.0025, "bullet"), box((0.01, 1, 1), "plate")], gravity=(0, 0, 0), materials=materials(dead=(0, 0)))
    yield Case("bullet_at_plate", "The same at a fixed plate of 2 cm: does it stay in front?", "yes", "impenetrable", 1.0, plate,
               lambda r: float(r.end(0, "x") < 0), SUBSTEPS, scale=1)


def statics():
    for degrees, slips in ((46, 0), (44, 1)):
        a = math.radians(degrees)
        # Against a wall of ice; the floor has friction 0.5.
        half, thin = 2.0, 0.02
        foot = (half * math.cos(a), half * math.sin(a))
        # The lower edge is on the floor and the upper edge at the wall.
        ladder = world(3, [ground("one"), {"shape": "wall", "type": "static", "position": [1 + foot[0] + thin * math.sin(a), 4, 0], "material": "ice"},
                           body("ladder", (0, foot[1] + thin * math.cos(a), 0), material="rough",
                                rotation={"axis": [0, 0, 1], "degrees": degrees})],
                       [GROUND, box((1, 6, 3), "wall"), box((half, thin, 0.3), "ladder")], materials=ROUGH)
        word = "slips" if slips else "stays"
        yield Case(f"ladder_{word}", f"A ladder at a wall of ice, on a floor of friction 0.5, at {degrees} degrees: does it slip in 3 s?",
                   "tan a = 1 / 2 mu", COULOMB, float(slips), ladder, lambda r: float(abs(r.end(2, "x")) > 0.2), (*FIRM, "dantzig, 8 substeps", "16 substeps"), scale=1)
    for share, falls in ((0.95, 0), (1.05, 1)):
        bodies, x = [ground("one")], 0.0
        count, half = 4, (1.0, 0.2, 0.5)
        # The uppermost overhangs by half of its length, the next by a quarter ...
        for i in range(count):
            bodies.append(body("brick", (x, half[1] * (2 * i + 1), 0), material="one"))
            x += share * half[0] / (count - 1 - i) if i < count - 1 else 0
        pile = world(6, bodies, [GROUND, box(half, "brick")], materials=ROUGH)
        word = "falls" if falls else "stands"
        yield Case(f"overhang_{word}", f"Four bricks overhang by {share:g} of what they can: do they fall in 6 s?", "1 + 1/2 + 1/3 ... of half a brick",
                   "the book-stacking problem", float(falls), pile, lambda r: float(r.end(4, "y") < 1.2), (*FIRM, *HEAVY), scale=1)
    masses = [1, 10, 3, 40]
    tower = world(10, [ground("grip"), *(body("plate", (0.018 * i, 0.15 + 0.3 * i, 0), masses[i % 4], material="grip") for i in range(16))],
                  [GROUND, box((0.5, 0.15, 0.5), "plate")], materials=materials(grip=(0.6, 0)))
    yield Case("leaning_tower", "A tower of 16 plates of 1, 10, 3, 40 kg that leans by 1.8 cm a plate: its height after 10 s.", "it stands", TEXTBOOK, 4.65,
               tower, lambda r: r.end(16, "y"), (*HEAVY, "2 substeps", "50 iterations, 2 substeps"), unit="m")
    stack = world(10, [ground("one"), *(body("box", (0, 0.5 + i, 0), 1 if i < 9 else 20, material="one") for i in range(10))],
                  [GROUND, box((0.5, 0.5, 0.5))], materials=ROUGH)
    yield Case("stack", "A stack of ten cubes, the uppermost of 20 kg: its height after 10 s.", "it stands", TEXTBOOK, 9.5, stack,
               lambda r: r.end(10, "y"), HEAVY, unit="m")
    for load in (10, 1000):
        links = [body("link", (0, -0.25 - 0.5 * i, 0), 1, name=f"l{i}") for i in range(20)] + [body("ball", (0, -10.5, 0), load, name="l20")]
        joints = [{"type": "ball", "a": "l0", "pivot": [0, 0, 0]},
                  *({"type": "ball", "a": f"l{i}", "b": f"l{i - 1}", "pivot": [0, -0.5 * i, 0]} for i in range(1, 21))]
        rope = world(10, links, [{"name": "link", "type": "capsule", "radius": 0.1, "height": 0.2}, ball(0.5)], joints=joints)
        yield Case(f"rope_{load}", f"A chain of 20 links of 1 kg with {load} kg at its end: where that hangs after 10 s.", "20 links and half a metre", "statics", -10.5,
                   rope, lambda r: r.end(20, "y"), HEAVY, unit="m", tolerance=0.001)
    yield Case("multibody_rope", "The same as a multibody.", "20 links and half a metre", "statics", -10.5,
               rope | {"solver": {"kind": "multibodies"}}, lambda r: r.end(20, "y"), unit="m", tolerance=0.001)


def rests():
    """Heights of shapes of all sizes at rest on a box."""
    shapes = {
        "box": (lambda s: box((s / 2, s / 2, s / 2), "it"), 0.5),
        "ball": (lambda s: ball(s / 2, "it"), 0.5),
        "cylinder": (lambda s: cylinder(s / 2, s, "it"), 0.5),
        "capsule": (lambda s: {"name": "it", "type": "capsule", "radius": s / 4, "height": s / 2}, 0.25),
        "hull": (lambda s: {"name": "it", "type": "hull",
                            "points": [[s / 2 * x, s / 2 * y, s / 2 * z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]}, 0.5),
    }
    for name, (make, share) in shapes.items():
        for size in (0.001, 0.01, 0.1, 1, 10, 100):
            floor = box((max(50 * size, 1),) * 3, "ground")
            top = floor["half_extents"][1]
            scene = world(2, [{"shape": "ground", "type": "static", "position": [0, -top, 0]},
                              {"shape": "it", "density": 1000 if size < 100 else 1, "position": [0, share * size, 0],
                               **({"rotation": LYING} if name == "capsule" else {})}], [floor, make(size)], reach=1000 * max(size, 1))
            label = f"{size * 1000:g} mm" if size < 0.1 else f"{size:g} m"
            yield Case(f"rest_{name}_{size:g}", f"A {name} of {label} lies on a box: its height after 2 s.", "half of it" if share == 0.5 else "its radius", "geometry", share * size,
                       scene, lambda r: r.end(1, "y"), ("2 substeps", "8 substeps", "split impulses", "dantzig"), tolerance=0.002, unit="m")


def heavy():
    scene = world(2, [ground("one"), body("ball", (0, 5, 0), 1e8, material="one")], [GROUND, ball(5)], materials=ROUGH)
    yield Case("rest_heavy", "A ball of 10 m and 100 000 t lies on the ground: its height after 2 s.", "its radius", "geometry", 5.0,
               scene, lambda r: r.end(1, "y"), ("2 substeps", "dantzig"), unit="m",
               why="Bullet takes the inverse of masses above 14 000 t for zero and makes no contacts of them.")


def cases():
    for family in (slopes, rolling, bounces, cradles, collisions, statics, rests, heavy):
        yield from family()
