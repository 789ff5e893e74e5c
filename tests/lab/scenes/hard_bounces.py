#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Drops a ball of restitution 1 from several heights, in steps of several lengths, and prints in how many of these
worlds its energy stayed as it was, by substeps and by `contact_erp`, which pushes it out of the floor."""
import csv

from made_scene import bounds, simulate, table_script

HEIGHTS = [1, 2, 3, 5, 7, 9, 12]  # of the ball's centre above where it rests, in metres
RATES = [30, 50, 60]
SUBSTEPS = [1, 2, 4, 8, 16]
SECONDS = 20
VARIANTS = {"default": {}, "no split impulses": {"split_impulse": False}, "`contact_erp` 0": {"contact_erp": 0}}


def energies(tool, height, rate, substeps, variant, folder):
    """Of each step, over the energy at the start."""
    scene = {"time": {"dt": 1 / rate, "steps": SECONDS * rate, "substeps": substeps}, "solver": variant,
             "world": {"gravity": [0, -10, 0], "bounds": bounds(1000)},
             "materials": {"elastic": {"friction": 0, "restitution": 1}},
             "shapes": [{"name": "ball", "type": "sphere", "radius": 0.5},
                        {"name": "ground", "type": "box", "half_extents": [5, 1, 5]}],
             "bodies": [{"shape": "ground", "type": "static", "position": [0, -1, 0], "material": "elastic"},
                        {"shape": "ball", "mass": 1, "material": "elastic", "position": [0, 0.5 + height, 0],
                         "sleep": False}]}
    table = folder / "run.csv"
    simulate(tool, scene, folder, "--csv", str(table))
    at_rest = 10 * 0.5  # of which the bounce has nothing
    return [(float(row["energy"]) - at_rest) / (10 * height) for row in csv.DictReader(table.open())]


def row_of(tool, substeps, name, folder):
    runs = [energies(tool, height, rate, substeps, VARIANTS[name], folder) for height in HEIGHTS for rate in RATES]
    within = [sum(all(abs(e - 1) <= bound for e in run) for run in runs) for bound in (0.01, 0.05)]
    return [str(substeps), name, *map(str, within), str(sum(run[-1] < 0.05 for run in runs)),
            f"{max(map(max, runs)):.3g}"]


def table(tool, folder):
    rows = [row_of(tool, substeps, name, folder) for name in VARIANTS for substeps in SUBSTEPS]
    head = ["Substeps", "Setting", "within 1 %", "within 5 %", "stopped", "greatest energy"]
    return head, rows, ["---:", "---"] + ["---:"] * 4


if __name__ == "__main__":
    table_script(__doc__, "hard bounces", table)
