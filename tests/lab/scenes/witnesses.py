#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs worlds without a closed form here and on an engine of others, and writes the table of docs/internals/witnesses.md, what the
witnesses said (witnessed/recorded.json) and the differences that a test allows (witnessed/bands.json).

With --check nothing is written: a case fails if it is further from what the witness said than noted, at default settings
or at those that are named. That takes no engine of others. With --live these are asked again, and have to say the same.
"""
import concurrent.futures
import copy
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402
from closed_form import parts  # noqa: E402
from closed_forms import unwarned  # noqa: E402
from witnessed import cases as witnessed  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent / "witnessed"
BANDS, RECORDED = FOLDER / "bands.json", FOLDER / "recorded.json"
MARK = "witnesses"
ROOM = 1.02, 2e-4  # by which a difference may be larger than the one noted: other compilers round otherwise
NOT_BUILT = 3      # what the witness ends with


def all_cases(only):
    return [case for case in witnessed.cases() if not only or case.name in only]


def ask(witness, case, *options):
    """What a witness says; None if it is not built in."""
    with tempfile.TemporaryDirectory() as folder:
        scene, states = (pathlib.Path(folder) / name for name in ("scene.json", "states.csv"))
        scene.write_text(json.dumps(case.scene))
        done = subprocess.run([witness, case.witness, str(scene), "--states", str(states), *options],
                              capture_output=True, text=True)
        if done.returncode == NOT_BUILT:
            return None
        if done.returncode != 0:
            raise SystemExit(f"{case.name}: {done.stderr}")
        return case.taken(parts.Run(states.open(), case.scene["time"]["dt"]))


def finest(case):
    return () if case.witness == "simbody" else ("--substeps", str(case.substeps))


def coarser(case):
    return ("--accuracy", "1e-8") if case.witness == "simbody" else ("--substeps", str(case.substeps // 2))


def ours(tool, case, setting):
    """What comes of a case here, and the processor time of its steps."""
    changed = copy.copy(case)
    changed.scene = parts.merged(case.scene, {**parts.SETTINGS, **case.own}[setting])
    with tempfile.TemporaryDirectory() as folder:
        run, ms = parts.run(tool, changed, "default", pathlib.Path(folder))
    try:
        return case.taken(run), ms
    except (IndexError, ValueError, OverflowError, ZeroDivisionError):
        return None, ms


def share(case, mine, said):
    return case.difference(mine, said) / case.size


def rounded(value):
    return float(f"{value:.7g}") if isinstance(value, float) else [rounded(v) for v in value]


def band_of(tool, witness, case):
    """What is noted of a case, and what its witness says."""
    said = ask(witness, case, *finest(case))
    if said is None:
        raise SystemExit(f"{case.witness} is not built in")
    change = share(case, ask(witness, case, *coarser(case)), said)
    said = rounded(said)
    tried = {}
    for setting in ("default", *case.settings, *case.own):
        mine, ms = ours(tool, case, setting)
        tried[setting] = share(case, mine, said), ms, mine
    within = [(of[1], setting) for setting, of in tried.items() if of[0] <= case.tolerance]
    if tried["default"][0] <= case.tolerance:
        best = "default"
    elif within:
        best = min(within)[1]
    else:
        best = min(tried, key=lambda setting: tried[setting][0])
    print(f"{case.name}: witness {change:.2g}, default {tried['default'][0]:.4g}, {best} {tried[best][0]:.4g}", file=sys.stderr,
          flush=True)
    number = lambda x: float(f"{x:.6g}") if isinstance(x, float) and math.isfinite(x) else None  # noqa: E731
    return {"witness_change": number(change), "default": number(tried["default"][2]), "difference": number(tried["default"][0]),
            "setting": best, "value": number(tried[best][2]), "setting_difference": number(tried[best][0]),
            "within": tried[best][0] <= case.tolerance,
            "price": float(f"{max(tried[best][1], 1e-6) / max(tried['default'][1], 1e-6):.2g}"),
            "about": case.about, "witness": case.witness, "compared": case.compared, "why": case.why}, said


def percent(x):
    if x is None:
        return "-"
    return "0" if x < 5e-8 else f"{100 * x:.2g} %"


def shown(case, value):
    if case.measure is None:
        return "-"
    return "never" if value is None else f"{value:.4g} {case.unit}"


def table(cases, bands, recorded):
    head = ["World", "What happens", "Compared", "Witness", "It says", "It changes by", "Default", "Differs by", "Setting", "There",
            "Differs by", "Price"]
    rows = []
    for case in cases:
        band = bands[case.name]
        witness = {"simbody": "Simbody", "ode": f"ODE, {case.substeps} substeps"}[case.witness]
        setting = band["setting"] if band["within"] else f"none; nearest: {band['setting']}"
        if case.tolerance != 0.01 and band["setting"] != "default":
            setting += f" ({percent(case.tolerance)})"
        rows.append([f"`{case.name}`", case.about, case.compared, witness,
                     shown(case, recorded[case.name]), percent(band["witness_change"]), shown(case, band["default"]),
                     percent(band["difference"]), setting, shown(case, band["value"]), percent(band["setting_difference"]),
                     f"{band['price']:.2g}"])
    right = sum(band["difference"] is not None and band["difference"] <= case.tolerance
                for case, band in ((c, bands[c.name]) for c in cases))
    none = sum(not bands[case.name]["within"] for case in cases)
    lines = [f"{len(cases)} worlds: {right} agree at default settings, {len(cases) - right - none} at the setting that is named, "
             f"{none} at none that was tried.", ""]
    reasons = [f"- `{case.name}`: {case.why}" for case in cases if case.why]
    return "\n".join(lines) + "\n" + marked_page.lines_of(head, rows) + "\n" + "\n".join(reasons) + "\n"


def complaints(tool, case, band, said):
    """What is further from the witness than noted."""
    difference = share(case, ours(tool, case, "default")[0], said)
    allowed = math.inf if band["difference"] is None else max(band["difference"] * ROOM[0] + ROOM[1], case.tolerance)
    if difference > allowed:
        yield f"{case.name}: differs by {difference:.4g} at default settings, where {allowed:.4g} was noted"
    if band["setting"] != "default":
        there = share(case, ours(tool, case, band["setting"])[0], said)
        allowed = max(band["setting_difference"] * ROOM[0] + ROOM[1], case.tolerance if band["within"] else 0)
        if there > allowed:
            yield f"{case.name}: differs by {there:.4g} with {band['setting']}, where {allowed:.4g} was noted"


def told_otherwise(witness, case, band, said):
    """Where a witness no longer says what is noted. It rounds otherwise elsewhere, so as much as a coarser step changes
    is allowed."""
    now = ask(witness, case, *finest(case))
    if now is None:
        return f"{case.name}: skipped, {case.witness} is not built in"
    change = share(case, now, said)
    if change > max(2 * band["witness_change"], 1e-4):
        return f"{case.name}: {case.witness} says what differs by {change:.3g} from what is noted"
    return None


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("tool", metavar="BOXSTREAM")
    parser.add_argument("witness", metavar="BOXSTREAM_WITNESS", nargs="?")
    parser.add_argument("--check", action="store_true", help="compare with what is noted; write nothing")
    parser.add_argument("--warnings", action="store_true",
                        help="check that explain and simulate warn of what differs at default settings")
    parser.add_argument("--live", action="store_true", help="ask the witnesses again; write nothing")
    parser.add_argument("--only", nargs="*", default=[], metavar="NAME")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    marked_page.require_marks(options.into, MARK)
    cases = all_cases(options.only)
    bands = json.loads(BANDS.read_text()) if BANDS.exists() else {}
    recorded = json.loads(RECORDED.read_text()) if RECORDED.exists() else {}
    if not options.check and not options.warnings and options.witness is None:
        parser.error("which BOXSTREAM_WITNESS?")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        if options.live:
            found = list(filter(None, pool.map(
                lambda case: told_otherwise(options.witness, case, bands[case.name], recorded[case.name]), cases)))
            print("\n".join(found) or f"{len(cases)} witnesses say what is noted")
            return 77 if found and all(": skipped, " in line for line in found) else 1 if found else 0
        if options.warnings:
            wrong = [case for case in cases if bands[case.name]["setting"] != "default"]
            silent = [case.name for case, silent in zip(wrong, pool.map(lambda case: unwarned(options.tool, case), wrong)) if silent]
            print("\n".join(f"{name}: differs at default settings, and nothing says so" for name in silent)
                  or f"{len(wrong)} cases differ at default settings; all of them are warned of")
            return 1 if silent else 0
        if options.check:
            missing = [f"{case.name}: nothing is noted" for case in cases if case.name not in bands]
            worse = pool.map(lambda case: list(complaints(options.tool, case, bands[case.name], recorded[case.name])),
                             [case for case in cases if case.name in bands])
            found = [*missing, *(line for lines in worse for line in lines)]
            print("\n".join(found) or f"{len(cases)} cases are as noted, or nearer")
            return 1 if found else 0
        for case, (band, said) in zip(cases, pool.map(lambda case: band_of(options.tool, options.witness, case), cases)):
            bands[case.name], recorded[case.name] = band, said
    everything = [case for case in all_cases([]) if case.name in bands]
    if options.into is not None:
        for file, noted in ((BANDS, bands), (RECORDED, recorded)):
            lines = [f'"{case.name}": {json.dumps(noted[case.name], separators=(",", ":") if noted is recorded else None)}'
                     for case in everything]
            file.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    marked_page.put_out(table(everything, bands, recorded), options.into, MARK)
    return 0


if __name__ == "__main__":
    sys.exit(main())
