# SPDX-License-Identifier: MIT
"""What the cases of closed forms are made of: scenes, what is measured of their runs, and settings."""
import csv
import dataclasses
import json
import math
import subprocess
import typing

G = 9.81
DT = 1 / 60


@dataclasses.dataclass
class Case:
    """A world of which it is known what must come of it."""
    name: str
    about: str
    formula: str
    source: str
    truth: float
    scene: dict
    measure: typing.Callable  # of a Run
    settings: tuple = ()      # names in SETTINGS, beside the default
    tolerance: float = 0.01
    scale: float = 0          # what an error is a share of; 0: the truth
    unit: str = ""
    why: str = ""             # where no setting reaches it

    def error(self, value):
        if value is None or math.isnan(value):
            return math.inf
        return abs(value - self.truth) / (self.scale or abs(self.truth))


# Changes of a scene (RFC 7396).
SETTINGS = {"default": {}}
for _n in (2, 4, 8, 16, 32, 64):
    SETTINGS[f"{_n} substeps"] = {"time": {"substeps": _n}}
for _n in (50, 200):
    SETTINGS[f"{_n} iterations"] = {"solver": {"iterations": _n}}
for _kind in ("nncg", "dantzig", "lemke"):
    SETTINGS[_kind] = {"solver": {"kind": _kind}}
    for _n in (2, 4, 8, 16):
        SETTINGS[f"{_kind}, {_n} substeps"] = {"solver": {"kind": _kind}, "time": {"substeps": _n}}
SETTINGS["multibodies"] = {"solver": {"kind": "multibodies"}}
SETTINGS["on contact"] = {"solver": {"bounces": "on_contact"}}
for _n in (2, 4, 8, 16, 32):
    SETTINGS[f"on contact, {_n} substeps"] = {"solver": {"bounces": "on_contact"}, "time": {"substeps": _n}}
    SETTINGS[f"on contact, dantzig, {_n} substeps"] = {"solver": {"bounces": "on_contact", "kind": "dantzig"},
                                                       "time": {"substeps": _n}}
    SETTINGS[f"50 iterations, {_n} substeps"] = {"solver": {"iterations": 50}, "time": {"substeps": _n}}
SETTINGS["double"] = {"solver": {"precision": "double"}}
for _n in (4, 8):
    SETTINGS[f"double, {_n} substeps"] = {"solver": {"precision": "double"}, "time": {"substeps": _n}}
SETTINGS["split impulses"] = {"solver": {"split_impulse": True}}
SETTINGS["two friction directions"] = {"solver": {"friction_directions": "two"}}

SUBSTEPS = tuple(f"{n} substeps" for n in (2, 4, 8, 16, 32, 64))
BOUNCES = ("on contact", *(f"on contact, {n} substeps" for n in (2, 4, 8, 16)))
HEAVY = ("50 iterations", "dantzig", "multibodies", "4 substeps", "dantzig, 4 substeps", "16 substeps", "50 iterations, 4 substeps")
FIRM = ("2 substeps", "4 substeps", "8 substeps", "dantzig", "dantzig, 4 substeps")


def merged(scene, change):
    out = dict(scene)
    for key, value in change.items():
        out[key] = merged(out.get(key, {}), value) if isinstance(value, dict) else value
    return out


class Run:
    """What a run left: `place[step][body]` and so on, for bodies that are not fixed, by their number in the scene."""

    def __init__(self, rows, dt):
        self.dt = dt
        self.steps = []
        for row in csv.DictReader(rows):
            step = int(row["step"])
            if step == len(self.steps):
                self.steps.append({})
            f = {key: float(text) for key, text in row.items() if key not in ("step", "object")}
            self.steps[step][int(row["object"])] = f

    def series(self, body, key):
        return [step[body][key] for step in self.steps]

    def end(self, body, key):
        return self.steps[-1][body][key]

    def at(self, body, key, seconds):
        """Between steps along a straight line."""
        values = self.series(body, key)
        place = min(seconds / self.dt, len(values) - 1)
        low = min(int(place), len(values) - 2)
        return values[low] + (values[low + 1] - values[low]) * (place - low)

    def crossings(self, body, key, level=0.0):
        """Times at which a value passes a level."""
        values = self.series(body, key)
        times = []
        for i in range(1, len(values)):
            a, b = values[i - 1] - level, values[i] - level
            if a != 0 and a * b <= 0 and a != b:
                times.append((i - 1 + a / (a - b)) * self.dt)
        return times

    def peaks(self, body, key):
        """Local maxima, by parabolas through three values."""
        v = self.series(body, key)
        found = []
        for i in range(1, len(v) - 1):
            if v[i] > v[i - 1] and v[i] >= v[i + 1]:
                a, b = (v[i + 1] + v[i - 1]) / 2 - v[i], (v[i + 1] - v[i - 1]) / 2
                found.append(v[i] - b * b / (4 * a) if a < 0 else v[i])
        return found

    def up(self, body):
        """The vertical part of a body's own y at the end."""
        f = self.steps[-1][body]
        return 1 - 2 * (f["qx"] ** 2 + f["qz"] ** 2)


def period(run, body, key, level=0.0):
    times = run.crossings(body, key, level)
    return 2 * (times[-1] - times[0]) / (len(times) - 1) if len(times) > 2 else math.nan


def run(tool, case, setting, folder):
    """A Run and the processor time of its steps."""
    scene = merged(case.scene, SETTINGS[setting])
    file, states, report = folder / "case.json", folder / "states.csv", folder / "report.json"
    file.write_text(json.dumps({"format": 1, "meta": {"name": case.name, "about": case.about}} | scene))
    done = subprocess.run([tool, "simulate", str(file), "--states", str(states), "--json", str(report)],
                          capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{case.name}, {setting}: {done.stderr}")
    summary = json.loads(report.read_text())["worlds"][0]["summary"]
    return Run(states.open(), scene["time"]["dt"]), summary["step"]["total_ms"]


# Scenes. Bounds are wide: they only say where things are expected.

def world(seconds, bodies, shapes, dt=DT, gravity=(0, -G, 0), reach=100, **more):
    return {"time": {"dt": dt, "steps": round(seconds / dt)},
            "world": {"gravity": list(gravity), "bounds": {"min": [-reach] * 3, "max": [reach] * 3}},
            "shapes": shapes, "bodies": bodies, **more}


def ball(radius, name="ball"):
    return {"name": name, "type": "sphere", "radius": radius}


def box(half, name="box"):
    return {"name": name, "type": "box", "half_extents": list(half)}


def cylinder(radius, height, name="cylinder"):
    return {"name": name, "type": "cylinder", "radius": radius, "height": height}


GROUND = box((200, 1, 200), "ground")


def ground(material="default"):
    return {"name": "ground", "shape": "ground", "type": "static", "position": [0, -1, 0], "material": material}


def body(shape, position=(0, 0, 0), mass=1.0, **more):
    return {"shape": shape, "mass": mass, "position": list(position), "sleep": False, **more}


def on_slope(degrees):
    """Gravity on a slope that goes down along +x, in the slope's own axes."""
    a = math.radians(degrees)
    return (G * math.sin(a), -G * math.cos(a), 0)


LYING = {"axis": [1, 0, 0], "degrees": 90}  # y becomes z


def materials(**named):
    return {name: dict(zip(("friction", "restitution"), values)) for name, values in named.items()}
