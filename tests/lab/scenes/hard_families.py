#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs families of stacks and chains and writes how much each step and number of iterations bore, as the list that
`boxstream explain` has its advice from, and as tables in a page.

A world of a family has `bodies` one upon or below another, of 1 kg each, the last of `load` kg. Each is run from
several starts. The load of a table is the greatest with which that many bodies held from all starts, as did all shorter
worlds and smaller loads.
"""
import concurrent.futures
import json
import pathlib
import random
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402
from made_scene import bounds, simulate  # noqa: E402

LIST = pathlib.Path(__file__).resolve().parents[3] / "demos" / "boxstream" / "advice" / "hard_families.json"
# Steps a second, and iterations: more of both takes hours.
SETTINGS = [(rate, n) for rate in (30, 60, 120, 240) for n in (5, 10, 20, 50, 100) if rate * n <= 6000]
# Small bodies fall as far, beside their size, as large ones in long steps.
LONG_STEPS = [(rate, n) for rate in (11, 15, 21, 42) for n in (10, 20, 50)]
LOADS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000]
SECONDS = 10
# As simulate has it, of links of 0.5 m: no joint opens by more than a twentieth.
MOST_GAP = 0.025


def stack_of(bodies, load, start):
    """Cubes of 1 m. Starts: in line, or up to 1 cm aside; listed upwards, or downwards."""
    aside = random.Random(bodies)
    offset = lambda: aside.uniform(-0.01, 0.01) if start >= 2 else 0  # noqa: E731
    cubes = [{"shape": "cube", "mass": load if i == bodies - 1 else 1, "position": [offset(), 0.5 + i, offset()]}
             for i in range(bodies)]
    height = 0.99 * (bodies - 0.5)
    return {
        "shapes": [{"name": "cube", "type": "box", "half_extents": [0.5] * 3},
                   {"name": "ground", "type": "box", "half_extents": [50, 1, 50]}],
        "bodies": [{"shape": "ground", "type": "static", "position": [0, -1, 0]}, *cubes[::-1 if start % 2 else 1]],
        "checks": [{"metric": "highest", "op": ">=", "value": height},
                   {"metric": "max_penetration", "op": "<", "value": 0.05},
                   {"metric": "lowest", "op": ">", "value": 0}]}


def awake_of(bodies, load, start):
    """The same, of cubes that may not fall asleep."""
    made = stack_of(bodies, load, start)
    for body in made["bodies"]:
        body["sleep"] = body.get("type") == "static"
    return made


def chain_of(bodies, load, start):
    """Links of 0.5 m as in hard/chain_40. Starts: hanging, or held 15, 30 or 45 degrees aside."""
    side = [(0, -1), (0.2588, -0.9659), (0.5, -0.866), (0.7071, -0.7071)][start]
    return {
        "shapes": [{"name": "link", "type": "capsule", "radius": 0.1, "height": 0.2},
                   {"name": "end", "type": "sphere", "radius": 0.5}],
        "bodies": [],
        "generators": [{"type": "chain", "links": bodies - 1, "anchor": [0, 0, 0], "direction": [side[0], side[1], 0],
                        "pitch": 0.5, "end_offset": 0.5, "link": {"shape": "link", "mass": 1, "sleep": False},
                        "end": {"shape": "end", "mass": load, "sleep": False}}],
        "checks": [{"metric": "lowest", "op": ">=", "value": -0.5 * bodies - MOST_GAP * bodies}]}


# How each is made, of how many bodies, and the settings. 1000 on 1 takes more than the rest.
FAMILIES = {"stack": (stack_of, [2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 100], sorted([*LONG_STEPS, *SETTINGS, (120, 100)])),
            "awake": (awake_of, [2, 4, 8, 12, 16, 24, 32], [(30, 10), (30, 20), (30, 50), (60, 5), (60, 10), (60, 20), (60, 50), (120, 10), (240, 10)]),
            "chain": (chain_of, [3, 6, 11, 21, 41, 81, 161], SETTINGS),
            "hanging": (chain_of, [3, 6, 11, 21, 41, 81, 161], [(60, 10), (60, 50), (240, 10), (240, 50), (480, 10), (960, 20)])}
STARTS = 4
# Of how many starts a family has, where it is not all of them: the first of a chain is that it hangs.
STARTS_OF = {"hanging": 1}

# Solvers beside Bullet's usual one, with the settings that they are run with. An exact one does not iterate.
SOLVERS = {"dantzig": [(60, 10), (120, 10), (240, 10)], "multibodies": [(60, 10), (120, 10), (240, 10)]}
CHAINS = {"chain": [3, 6, 11, 21, 41, 81], "hanging": [3, 6, 11, 21, 41, 81]}
# Contacts beside multibodies are solved as usual: stacks are no other ones.
SOLVERS_FAMILIES = {"dantzig": {"stack": [2, 3, 4, 6, 8, 12, 16], **CHAINS}, "multibodies": CHAINS}


def holds(tool, scene, rate, iterations, folder, solver="sequential_impulses"):
    # Smaller steps as substeps, for that is what the advice is.
    dt = 1 / min(rate, 60)
    scene |= {"time": {"dt": dt, "substeps": max(1, rate // 60), "steps": round(SECONDS / dt)},
              "solver": {"iterations": iterations, "kind": solver}, "world": {"bounds": bounds(500)}}
    run = simulate(tool, scene, folder, "--json", "-")
    return run.returncode == 0 and json.loads(run.stdout)["worlds"][0]["vitals"]["joint_gap_m"] <= MOST_GAP


def loads_of(job):
    """The greatest load for each number of bodies, 0 if none."""
    tool, family, solver, numbers, rate, iterations = job
    make = FAMILIES[family][0]
    bound, found = LOADS[-1], []
    with tempfile.TemporaryDirectory() as folder:
        for bodies in numbers:
            held = 0
            for load in LOADS:
                if load > bound or not all(holds(tool, make(bodies, load, start), rate, iterations, folder, solver)
                                           for start in range(STARTS_OF.get(family, STARTS))):
                    break
                held = load
            bound = held
            found.append(held)
    print(family, solver, rate, iterations, found, file=sys.stderr, flush=True)
    return {"steps_per_second": rate, "iterations": iterations, "loads": found}


def price(tool, family, bodies, solver, iterations):
    """What a step costs, over one of Bullet's usual solver with ten iterations: the median of five, in turns."""
    # Multibodies take far longer where a heavy end swings than where nothing moves.
    load, start = (100, 2) if (solver, family) == ("multibodies", "chain") else (1, 0)
    with tempfile.TemporaryDirectory() as folder:
        def step_ms(kind, count):
            scene = FAMILIES[family][0](bodies, load, start) | {"time": {"dt": 1 / 60, "steps": 200}, "world": {"bounds": bounds(500)},
                                                         "solver": {"kind": kind, "iterations": count}}
            for body in scene["bodies"]:
                body["sleep"] = False
            scene.pop("checks")
            run = simulate(tool, scene, folder, "--json", "-")
            return json.loads(run.stdout)["worlds"][0]["summary"]["step"]["total_ms"]
        ratios = sorted(step_ms(solver, iterations) / step_ms("sequential_impulses", 10) for _ in range(5))
    return round(ratios[2], 2)


def family_of(pool, tool, family, solver, numbers, settings):
    jobs = [(tool, family, solver, numbers, *setting) for setting in settings]
    return {"bodies": numbers, "held": list(pool.map(loads_of, jobs))}


def write(document, file, page):
    # A line for each setting.
    file.write_text(json.dumps(document).replace('{"steps', '\n{"steps') + "\n")
    rows = [[f"`{solver}`", family, str(row["steps_per_second"]), *[f"{n}: {load or '-'}" for n, load in zip(of[family]["bodies"], row["loads"])] + [""] * (7 - len(row["loads"])),
             ", ".join(map(str, of[family]["prices"]))]
            for solver, of in document["solvers"].items() for family in SOLVERS_FAMILIES[solver] for row in of[family]["held"]]
    marked_page.put_out(marked_page.lines_of(["Solver", "Family", "Steps a second", *["Bodies: load"] * 7, "Price of a substep"], rows), page,
                        "hard family solvers")
    for family in FAMILIES:
        head = ["Steps a second", "Iterations", *(f"{n} bodies" for n in document[family]["bodies"])]
        rows = [[str(row["steps_per_second"]), str(row["iterations"]), *(f"{load or '-'}" for load in row["loads"])]
                for row in document[family]["held"]]
        marked_page.put_out(marked_page.lines_of(head, rows, ["---:"] * len(head)), page, f"hard family {family}")


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("tool", metavar="BOXSTREAM")
    parser.add_argument("--list", type=pathlib.Path, default=LIST, help="where the list goes")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--solvers-only", action="store_true", help="keep what the list has of Bullet's usual solver")
    parser.add_argument("--family", choices=FAMILIES, help="measure this with Bullet's usual solver, and keep all else")
    parser.add_argument("--solver", choices=SOLVERS, help="keep what the list has of all others")
    options = parser.parse_args()
    marked_page.require_marks(options.into, *(f"hard family {family}" for family in (*FAMILIES, "solvers")))
    keeps = options.solvers_only or options.solver
    document = json.loads(options.list.read_text()) if keeps or options.family else {"starts": STARTS, "seconds": SECONDS}
    measured = [] if options.family else [options.solver] if options.solver else list(SOLVERS)
    document["solvers"] = {solver: of for solver, of in document.get("solvers", {}).items() if solver not in measured}
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        for family, (_, numbers, settings) in FAMILIES.items():
            if family == options.family or (not keeps and not options.family) or family not in document:
                document[family] = family_of(pool, options.tool, family, "sequential_impulses", numbers, settings)
        for solver in measured:
            document["solvers"][solver] = {family: family_of(pool, options.tool, family, solver, numbers, SOLVERS[solver])
                                           for family, numbers in SOLVERS_FAMILIES[solver].items()}
    for solver in measured:
        of = document["solvers"][solver]
        for family, numbers in SOLVERS_FAMILIES[solver].items():
            of[family]["prices"] = [price(options.tool, family, bodies, solver, 10) for bodies in numbers]
    write(document, options.list, options.into)


if __name__ == "__main__":
    main()
