# SPDX-License-Identifier: MIT
"""Runs of scenes that a script makes."""
import json
import pathlib
import subprocess
import sys


def simulate(tool, scene, folder, *options):
    """What `boxstream simulate` printed for `scene`, which needs no "format" and "meta". Ends the program with its line
    if it refused; a criterion that failed is no refusal."""
    file = pathlib.Path(folder) / "world.json"
    about = pathlib.Path(sys.argv[0]).name
    file.write_text(json.dumps({"format": 1, "meta": {"name": "made", "about": about}} | scene))
    run = subprocess.run([tool, "simulate", str(file), *options], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        raise SystemExit(run.stderr)
    return run


def bounds(size):
    return {"min": [-size] * 3, "max": [size] * 3}
