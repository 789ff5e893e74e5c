#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs worlds of which it is known by closed forms what must come of them, at default settings and at others, and writes
the table of docs/internals/closed-forms.md and the errors that a test allows (closed_form/bands.json).

With --check nothing is written: a case fails if its error at default settings is larger than the one noted, or if its
named setting is not within what was said.
"""
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import marked_page  # noqa: E402
from closed_form import far, moving, parts, touching  # noqa: E402

BANDS = pathlib.Path(__file__).resolve().parent / "closed_form" / "bands.json"
# What `boxstream accuracy --truth NAME` knows.
TRUTHS = pathlib.Path(__file__).resolve().parents[3] / "demos" / "boxstream" / "accuracy" / "closed_forms.json"
MARK = "closed forms"
ROOM = 1.02, 1e-4  # by which an error may be larger than the one noted: other compilers round otherwise


def all_cases(only):
    cases = [*moving.cases(), *touching.cases(), *far.cases()]
    assert len({case.name for case in cases}) == len(cases)
    for start in only:
        if not any(case.name.startswith(start) for case in cases):
            raise SystemExit(f"no case starts with {start}")
    return [case for case in cases if not only or case.name.startswith(tuple(only))]


def try_setting(tool, case, setting):
    with tempfile.TemporaryDirectory() as folder:
        run, ms = parts.run(tool, case, setting, pathlib.Path(folder))
    try:
        value = case.measure(run)
    except (IndexError, ValueError, OverflowError, ZeroDivisionError):
        value = math.nan
    return value, case.error(value), ms


def band_of(tool, case):
    """What is noted of a case: the default, and the cheapest setting of those tried that is within its tolerance."""
    tried = {setting: try_setting(tool, case, setting) for setting in ("default", *case.settings)}
    value, error, ms = tried["default"]
    within = [(of[2], setting) for setting, of in tried.items() if of[1] <= case.tolerance]
    if error <= case.tolerance:
        best = "default"
    elif within:
        best = min(within)[1]
    else:
        best = min(tried, key=lambda setting: tried[setting][1])
    print(f"{case.name}: {value:.6g} (truth {case.truth:.6g}), {best}: {tried[best][0]:.6g}", file=sys.stderr, flush=True)
    none = lambda x: None if math.isnan(x) or math.isinf(x) else float(f"{x:.6g}")  # noqa: E731
    return {"about": case.about, "truth": case.truth, "unit": case.unit, "formula": case.formula, "source": case.source,
            "tolerance": case.tolerance, "default": none(value), "error": none(error), "setting": best, "value": none(tried[best][0]),
            "setting_error": none(tried[best][1]), "within": tried[best][1] <= case.tolerance,
            "price": float(f"{max(tried[best][2], 1e-6) / max(ms, 1e-6):.2g}")}


def truth_of(band):
    return {key: band[key] for key in ("truth", "unit", "about")}


def number(x):
    return "nothing" if x is None else f"{x:.5g}"


def share(x):
    if x is None:
        return "-"
    return "0" if x < 5e-7 else f"{100 * x:.2g} %"


def table(cases, bands):
    head = ["Case", "World", "Truth", "Formula", "Source", "Default", "Error", "Cheapest setting within 1 %", "There", "Error", "Price"]
    rows = []
    for case in cases:
        band = bands[case.name]
        unit = f" {case.unit}" if case.unit else ""
        setting = band["setting"] if band["within"] else f"none; nearest: {band['setting']}"
        if case.tolerance != 0.01 and band["setting"] != "default":
            setting += f" ({share(case.tolerance)})"
        rows.append([f"`{case.name}`", case.about, number(case.truth) + unit, case.formula, case.source, number(band["default"]),
                     share(band["error"]), setting, number(band["value"]), share(band["setting_error"]), f"{band['price']:.2g}"])
    right = sum(band["error"] is not None and band["error"] <= case.tolerance for case, band in ((c, bands[c.name]) for c in cases))
    none = sum(not bands[case.name]["within"] for case in cases)
    lines = [f"{len(cases)} cases: {right} are right at default settings, {len(cases) - right - none} at the setting that is named, "
             f"{none} at none that was tried.", ""]
    reasons = [f"- `{case.name}`: {case.why}" for case in cases if case.why and not bands[case.name]["within"]]
    after = "\n" + "\n".join(reasons) + "\n" if reasons else ""
    return "\n".join(lines) + "\n" + marked_page.lines_of(head, rows) + after


def complaints(tool, case, band):
    """What is worse than noted."""
    error = try_setting(tool, case, "default")[1]
    allowed = math.inf if band["error"] is None else max(band["error"] * ROOM[0] + ROOM[1], case.tolerance)
    if error > allowed:
        yield f"{case.name}: an error of {error:.4g} at default settings, where {allowed:.4g} was noted"
    if band["within"] and band["setting"] != "default":
        there = try_setting(tool, case, band["setting"])[1]
        if there > case.tolerance:
            yield f"{case.name}: an error of {there:.4g} with {band['setting']}, where {case.tolerance:g} is promised"


def unwarned(tool, case):
    """Whether neither `explain` nor `simulate` says anything of a case that is wrong at default settings."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "case.json"
        file.write_text(json.dumps({"format": 1, "meta": {"name": case.name, "about": case.about}} | case.scene))
        told = json.loads(subprocess.run([tool, "explain", str(file), "--json", "-"], capture_output=True, text=True).stdout)
        ran = subprocess.run([tool, "simulate", str(file), "--steps", "1"], capture_output=True, text=True)
    lines = [line for line in ran.stderr.splitlines() if line.startswith(("boxstream: hard: ", "boxstream: coarse: "))]
    return not (told["hard_cases"] + told["coarse_steps"]) or not lines


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("tool", metavar="BOXSTREAM")
    parser.add_argument("--check", action="store_true", help="compare with what is noted; write nothing")
    parser.add_argument("--warnings", action="store_true",
                        help="check that explain and simulate warn of what is noted to be wrong at default settings")
    parser.add_argument("--covered", action="store_true", help="check that --only names every case; run nothing")
    parser.add_argument("--only", nargs="*", default=[], metavar="START", help="cases whose names start so")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    marked_page.require_marks(options.into, MARK)
    cases = all_cases(options.only)
    noted = json.loads(BANDS.read_text()) if BANDS.exists() else {}
    if options.covered:
        left_out = sorted({case.name for case in all_cases([])} - {case.name for case in cases})
        print("\n".join(f"{name}: no family has it" for name in left_out) or f"families have all of {len(cases)} cases")
        return 1 if left_out else 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        if options.warnings:
            wrong = [case for case in cases if (noted[case.name]["error"] is None or noted[case.name]["error"] > case.tolerance)]
            silent = [case.name for case, silent in zip(wrong, pool.map(lambda case: unwarned(options.tool, case), wrong)) if silent]
            print("\n".join(f"{name}: wrong at default settings, and nothing says so" for name in silent)
                  or f"{len(wrong)} cases are wrong at default settings; all of them are warned of")
            return 1 if silent else 0
        if options.check:
            missing = [f"{case.name}: nothing is noted" for case in cases if case.name not in noted]
            worse = pool.map(lambda case: list(complaints(options.tool, case, noted[case.name])),
                             [case for case in cases if case.name in noted])
            found = [*missing, *(line for lines in worse for line in lines)]
            print("\n".join(found) or f"{len(cases)} cases are as noted, or better")
            return 1 if found else 0
        bands = list(pool.map(lambda case: band_of(options.tool, case), cases))
    noted |= {case.name: band for case, band in zip(cases, bands)}
    everything = all_cases([])
    known = {case.name for case in everything}
    noted = {name: noted[name] for name in sorted(noted) if name in known}
    if options.into is not None:
        TRUTHS.write_text("{\n" + ",\n".join(f'"{name}": {json.dumps(truth_of(band))}' for name, band in noted.items()) + "\n}\n")
        BANDS.write_text("{\n" + ",\n".join(f'"{name}": {json.dumps(band)}' for name, band in noted.items()) + "\n}\n")
    marked_page.put_out(table([case for case in everything if case.name in noted], noted), options.into, MARK)
    return 0


if __name__ == "__main__":
    sys.exit(main())
