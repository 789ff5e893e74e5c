#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs that know nothing of boxstream, plain, on it, and on it beside their own broad-phase: the same results? Those
that are not installed are named and left out. With --rounds and --into it measures, and writes the table of
docs/clients.md; --dart SOURCES adds DART's own test programs."""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

SKIPPED = 77
PYTHON = "/usr/bin/python3"  # Debian's: its packages are for this one
HERE = pathlib.Path(__file__).resolve().parent
ALONE = {**os.environ, "PYTHONWARNINGS": "ignore", "OPENBLAS_NUM_THREADS": "1"}  # threads that wait take time, too


class Client:
    """Plain and replaced results must be identical; where contacts come in another order, which a pile amplifies, the mean
    heights of bodies must be within `near`, and results identical when both have one order: of `manifolds` (see
    one_order.cpp), or that of FCL's `engine`."""

    def __init__(self, name, words, calls, *, package=None, module=None, near=None, order=None, shorter=None, longer=None):
        self.name, self.words, self.calls = name, [str(w) for w in words], calls
        self.package, self.module, self.near, self.order = package, module, near, order
        self.shorter, self.longer = shorter or [], longer or shorter or []

    def missing(self):
        if self.words[0] != PYTHON:
            return None if os.path.exists(self.words[0]) else f"not built (Debian: {self.package})"
        has = subprocess.run([PYTHON, "-c", f"import {self.module}"], capture_output=True, check=False).returncode == 0
        return None if has else f"not installed (Debian: {self.package})"


def programs_of(paths):
    return {pathlib.Path(p).name.removeprefix("boxstream_client_"): p for p in paths}


def clients(paths, ign_plugin):
    programs = programs_of(paths)
    scenes = HERE / "siconos_scenes.py"
    dart, siconos = {"package": "python3-dartpy", "module": "dartpy"}, {"package": "python3-siconos python3-h5py", "module": "siconos.io.mechanics_run"}
    found = [
        Client("dartpy, FCL", [PYTHON, HERE / "dart_pile.py", "fcl"], "40 boxes fall; a manager of FCL, `update`, `collide`",
               near=0.02, order="engine", longer=["2000"], **dart),
        Client("dartpy, Bullet", [PYTHON, HERE / "dart_pile.py", "bullet"], "the same; a `btCollisionWorld` per group",
               near=0.02, order="manifolds", longer=["2000"], **dart)]
    about = {"cubes": "eight boxes fall on each other", "hulls": "ten hulls of random points", "slope": "balls, cylinders and capsules roll down",
             "compounds": "eight bodies of two shapes", "births": "boxes come and go",
             "wide": "plates, cones and large balls"}
    for scene, what in about.items():
        found.append(Client(f"Siconos, {scene}", [PYTHON, scenes, scene], f"{what}; `performDiscreteCollisionDetection`, all manifolds",
                            near=0.05, order="manifolds", longer=[] if scene == "cubes" else ["6"], **siconos))  # its tower falls, or not
    found.append(Client("ign-physics", [programs.get("ign_boxes", "/none"), ign_plugin], "30 boxes fall; its Bullet plugin, a `btDiscreteDynamicsWorld`",
                        package="libignition-physics5-bullet-plugin5 and the other libignition packages of group clients",
                        near=0.2, order="manifolds", shorter=["1000"], longer=["3000"]))
    found += [
        Client("queries alone", [programs.get("queries_only", "/none"), "2000", "200", "20"],
               "`updateSingleAabb`, `rayTest`, `convexSweepTest`, `contactTest`; never pairs", package="libbullet-dev"),
        Client("Siconos's way", [programs.get("siconos_way", "/none"), "40", "400"], "`btCollisionWorld`, multipoint iterations, manifolds", package="libbullet-dev"),
        Client("DART's way", [programs.get("dart_way", "/none"), "200", "100"], "`update`, `collide` and `distance` of managers, one and two", package="libfcl-dev"),
    ]
    return found


class Run:
    def __init__(self, words, preload=None):
        environment = {**ALONE, "LD_PRELOAD": preload} if preload else ALONE
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            with subprocess.Popen(words, stdout=out, stderr=err, env=environment) as process:
                _, status, used = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
            self.code, self.seconds = process.returncode, used.ru_utime + used.ru_stime
            out.seek(0), err.seek(0)
            self.out = out.read().decode(errors="replace")
            lines = self.out.splitlines()
            self.err = err.read().decode(errors="replace")
        self.result = next((line for line in reversed(lines) if line.startswith("{")), "\n".join(lines))

    def heights(self):
        if self.result.startswith("{"):
            return json.loads(self.result)["heights"]
        return [float(line.split()[-1]) for line in self.result.splitlines()]


def difference(plain, other, near):
    """None, "identical", or how far apart: a text, and whether that is too far."""
    if plain.result == other.result:
        return "identical", False
    if near is None:
        return f"{plain.result} became {other.result}", True
    a, b = plain.heights(), other.heights()
    gap = abs(statistics.fmean(a) - statistics.fmean(b))
    said = f"mean height {gap:.1g} apart" if gap > 1e-9 else "all but the last digits"
    return said, len(a) != len(b) or not gap <= near * max(1, statistics.fmean(map(abs, a)))


def must(right, *words):
    if not right:
        print(*words, sep="\n", file=sys.stderr)
        sys.exit(1)


def in_one_order(client, words, tried, one_order, plain):
    """The plain and the replaced run, with contacts in the same order."""
    if client.order == "engine":
        return plain, Run([tried, "--order", "engine", "--", *words])
    return Run(words, one_order), Run([tried, "--", *words], one_order)


def check_client(client, tried, one_order, rounds, longer):
    words = client.words + (client.longer if longer else client.shorter)
    plain, replaced = Run(words), Run([tried, "--", *words])
    checked = Run([tried, "--check", "--", *words])
    for each in (plain, replaced, checked):
        must(each.code == 0 and each.result, f"{client.name}: exit {each.code}", each.err[-2000:])
    must("replaced" in replaced.err, f"{client.name}: nothing was replaced", replaced.err[-2000:])
    must("no difference" in checked.err, f"{client.name}: --check", checked.err[-2000:])
    said, is_wrong = difference(plain, replaced, client.near)
    must(not is_wrong, f"{client.name}: {said}")
    must(difference(replaced, checked, None)[1] is False, f"{client.name}: --check changes what the program does")
    if client.order and said != "identical":
        for each in (ordered := in_one_order(client, words, tried, one_order, plain)):
            must(each.code == 0 and each.result, f"{client.name}, in one order: exit {each.code}", each.err[-2000:])
        apart, is_wrong = difference(*ordered, None)
        must(not is_wrong, f"{client.name}, in one order: {apart}")
        said = f"identical in one order; else {said}"
    swapped = "0"
    if os.path.exists(client.words[0] + "_swapped"):
        other = Run([client.words[0] + "_swapped", *words[1:]])
        must(other.code == 0 and other.result == plain.result, f"{client.name}, lines changed: {other.result}, not {plain.result}", other.err)
        swapped = "0, or 2"
    times = [plain.seconds], [replaced.seconds]
    for _ in range(rounds - 1):
        times[0].append(Run(words).seconds)
        times[1].append(Run([tried, "--", *words]).seconds)
    compared = re.search(r"check: ([^:]*): no difference", checked.err)
    before, after = (statistics.median(t) for t in times)
    print(f"{client.name}: {said}; {compared.group(1)}; {before:.2f} s before, {after:.2f} s after")
    return f"| {client.name} | {client.calls} | {swapped} | {said} | {compared.group(1)} | {before:.2f} s | {after:.2f} s |"


def dart_tests(sources, tried):
    """Compiles each of DART's test programs that names a collision detector, and runs it plain and with --check. Returns
    how many tests pass, and what goes wrong on boxstream alone."""
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "dart"], capture_output=True, text=True, check=False)
    must(flags.returncode == 0, "DART's headers are not installed (Debian: libdart-all-dev)", flags.stderr)
    words = [word for word in flags.stdout.split() if not word.startswith("-std")]  # that of DART's file is too old for it
    passed, wrong = 0, []
    with tempfile.TemporaryDirectory() as folder:
        for source in sorted(pathlib.Path(sources).glob("unittests/**/test_*.cpp")):
            if "CollisionDetector" not in source.read_text(errors="replace"):
                continue
            program = f"{folder}/{source.stem}"
            built = subprocess.run(["g++", "-std=c++17", "-O1", "-w", f"-I{sources}/unittests", str(source), "-o", program,
                                    *words, "-ldart-collision-bullet", "-ldart-utils-urdf", "-ldart-utils",
                                    "-lgtest", "-lgtest_main", "-pthread"], capture_output=True, text=True, check=False)
            if built.returncode != 0:
                print(f"DART's {source.stem}: does not compile here:", built.stderr.splitlines()[0][:200] if built.stderr else "")
                continue
            plain, checked = Run([program]), Run([tried, "--check", "--", program])
            before, after = (set(re.findall(r"\[ +OK +\] (\S+)", run.out)) for run in (plain, checked))
            said = [line.removeprefix("boxstream: ") for line in checked.err.splitlines() if "check:" in line]
            print(f"DART's {source.stem}: {len(before)} pass before, {len(after)} after; {'; '.join(said)}")
            passed += len(after)
            if before - after or any("no difference" not in line and "nothing was compared" not in line for line in said):
                wrong.append(f"{source.stem}: {' '.join(sorted(before - after))} {checked.err[-600:]}")
    return passed, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--try", dest="tried", required=True)
    parser.add_argument("--program", action="append", default=[])
    parser.add_argument("--one-order", help="the library of one_order.cpp")
    parser.add_argument("--ign-plugin", default="")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--longer", action="store_true", help="simulate longer")
    parser.add_argument("--into", help="the page whose table is replaced")
    parser.add_argument("--dart", help="DART's sources")
    given = parser.parse_args()
    rows, seen = [], 0
    for client in clients(given.program, given.ign_plugin):
        if reason := client.missing():
            print(f"skipped: {client.name}: {reason}")
            continue
        rows.append(check_client(client, given.tried, given.one_order, given.rounds, given.longer))
        seen += 1
    if given.dart:
        passed, wrong = dart_tests(given.dart, given.tried)
        print(f"DART's tests: {passed} pass on boxstream")
        must(not wrong, *wrong)
    if given.into:
        page = pathlib.Path(given.into)
        head = "| program | what it calls | lines changed | same results? | compared by `--check` | before | after |\n|---|---|---|---|---|--:|--:|\n"
        text = page.read_text()
        begin, end = "<!-- table -->\n", "<!-- end of table -->"
        page.write_text(text[:text.index(begin) + len(begin)] + "\n" + head + "\n".join(rows) + "\n\n" + text[text.index(end):])
    return 0 if seen else SKIPPED


if __name__ == "__main__":
    sys.exit(main())
