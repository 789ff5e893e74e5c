#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Switches on the seeded faults of faults.json one by one: each must be caught by the tests that it names.

usage: mutants.py [--handful] [--search] [--list] [--jobs N] [NAME...]

Builds a copy of the sources that has all faults in it, in build/mutants. With none switched on the named tests must
pass; with one, those that it names must fail. Exit code 1 if a fault survives, 2 if faults and sources do not go
together.
  NAME       only these faults
  --handful  a few faults, others for each commit, and only the test programs that these need
  --search   says for each fault which tests of all programs notice it: for adding one
  --list     prints the faults and does nothing
"""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import time

sys.dont_write_bytecode = True
import shadow  # noqa: E402

BUILD = shadow.ROOT / "build" / "mutants"
# What caught_by calls them, and what they are called below the build directory.
PROGRAMS = {
    "core": "tests/library/core/boxstream_core_test",
    "core_small": "tests/library/core/boxstream_core_small_test",
    "world_small": "tests/library/world/boxstream_world_small_test",
    "core_memory": "tests/library/core/boxstream_core_memory_test",
    "near": "tests/library/core/boxstream_core_near_test",
    "world": "tests/library/world/boxstream_world_test",
    "box_index": "tests/library/box_index/boxstream_box_index_test",
    "objects": "tests/library/objects/boxstream_objects_test",
    "out_of_core": "tests/library/out_of_core/boxstream_out_of_core_test",
    "out_of_core_memory": "tests/library/out_of_core/boxstream_out_of_core_memory_test",
    "world_memory": "tests/library/world/boxstream_world_memory_test",
    "bullet": "tests/library/bullet/bullet_tests",
    "bullet_memory": "tests/library/bullet/bullet_memory_tests",
    "bullet_threads": "tests/library/bullet/bullet_threads_tests",
    "bullet_ids": "tests/library/bullet/bullet_ids_tests",
    "fcl": "tests/library/fcl/fcl_tests",
    "fcl_memory": "tests/library/fcl/fcl_memory_tests",
    "ccd": "tests/library/ccd/boxstream_ccd_tests",
    "coal": "tests/library/coal/boxstream_coal_tests",
    "effects": "tests/lab/simulation/effects/boxstream_effects_test",
    "solids": "tests/lab/simulation/solids/boxstream_solids_test",
    "c": "tests/library/c/boxstream_c_tests",
    "record": "tests/lab/formats/record/boxstream_record_test",
    "import": "tests/lab/formats/import/boxstream_import_test",
    "core_threads": "tests/library/core/boxstream_core_threads_test",
    "python": "adapters/python/boxstream_python",  # a module, whose tests are named as pytest names them
}
PYTHON = "/usr/bin/python3"  # Debian's, which has the module's packages
ROOMS = sorted({path.removeprefix("tests/").rpartition("/")[0] for path in PROGRAMS.values() if path.startswith("tests/")})
HANDFUL = 6
# A handful is taken from one of these groups, an equal number for each program, so that it builds fast. Effects, record
# and import are in none of them, because they need the demos.
GROUPS = [["core", "core_memory", "world", "world_memory"], ["core", "near", "out_of_core", "out_of_core_memory"],
          ["world", "bullet", "bullet_memory", "bullet_ids"], ["core", "fcl", "fcl_memory", "objects"],
          ["core", "ccd", "box_index"],
          ["world", "bullet_threads"]]
TIMEOUT = 60  # seconds; named tests take a few of them at most
SEARCH_TIMEOUT = 300


def build(programs):
    """Configures and builds; the output is shown only when that fails."""
    switch = BUILD / "source" / "tests" / "mutants" / "fault_switch.hpp"  # of the copy: caches know it in any clone
    configure = ["cmake", "-S", BUILD / "source", "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 "-DBOXSTREAM_BENCH=OFF", "-DBOXSTREAM_INSTALL=OFF",
                 f"-DBOXSTREAM_TESTS_OF={';'.join(ROOMS)}", "-DBOXSTREAM_PYTHON_PACKAGE=AUTO",
                 "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS=-include {switch}"]
    compile_all = ["cmake", "--build", BUILD, "--target", *(pathlib.Path(PROGRAMS[p]).name for p in programs)]
    for command in configure, compile_all:
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if run.returncode != 0:
            sys.exit(f"{run.stdout}\nmutants: the shadow tree in {BUILD} does not build")


def command_of(program, tests):
    """What runs some tests of a program, and the folder for it."""
    if program != "python":
        return [BUILD / PROGRAMS[program], f"--gtest_filter={tests}"], None
    names = [] if tests == "*" else [tests]
    return [PYTHON, "-B", "-m", "pytest", "-rA", "-p", "no:cacheprovider", *names], BUILD / "source" / "tests" / "library" / "python"


class Outcome:
    """What became of some tests of one program."""

    def __init__(self, program, tests, fault=0, timeout=TIMEOUT):
        environment = dict(os.environ, BOXSTREAM_FAULT=str(fault), GTEST_COLOR="no",
                           PYTHONPATH=str(BUILD / "adapters" / "python"))
        start = time.monotonic()
        self.hung = False
        command, folder = command_of(program, tests)
        try:
            run = subprocess.run(command, cwd=folder, env=environment, timeout=timeout,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
            text, self.code = run.stdout, run.returncode
        except subprocess.TimeoutExpired as expired:
            text, self.code, self.hung = (expired.stdout or b"").decode(errors="replace"), 1, True
        self.seconds = time.monotonic() - start
        self.passed = re.findall(r"^(?:\[       OK \]|PASSED) ([^\s,]+)", text, re.M)
        self.failed = sorted(set(re.findall(r"^(?:\[  FAILED  \]|FAILED) ([^\s,]+\.[^\s,]+)", text, re.M)))
        begun = re.findall(r"^\[ RUN      \] (\S+)", text, re.M)
        if (self.code < 0 or self.hung) and begun and begun[-1] not in self.passed:
            self.failed.append(begun[-1])
        self.text = text

    def how(self):
        return "hangs" if self.hung else f"dies of signal {-self.code}" if self.code < 0 else "fails"


def split(caught_by):
    """A name in caught_by as program and filter."""
    program, _, tests = caught_by.partition(" ")
    if program not in PROGRAMS or not tests:
        raise shadow.StaleFault(f"caught_by is not \"PROGRAM TESTS\" with one of {', '.join(PROGRAMS)}: {caught_by!r}")
    return program, tests


def check_right_code(names):
    """With no fault switched on, the tests of the shadow tree must pass."""
    good = True
    for name in names:
        outcome = Outcome(*split(name))
        if outcome.code != 0 or not outcome.passed:
            print(outcome.text)
            print(f"mutants: {name} does not pass with no fault switched on, or is no test", file=sys.stderr)
            good = False
    return good


def judge(fault):
    """One line about a fault, and whether it was caught."""
    told = []
    for name in fault["caught_by"]:
        outcome = Outcome(*split(name), fault["number"])
        caught = outcome.code != 0 and (not outcome.hung or fault.get("hangs", False))
        told.append((caught, f"{name} {outcome.how() if outcome.code != 0 else 'passes'} ({outcome.seconds:.1f} s)"))
    caught = bool(told) and all(each for each, _ in told)
    why = "; ".join(text for each, text in told if each == caught) or "no test is named"
    return f"{'caught' if caught else 'SURVIVED':8}  {fault['name']:28} {why}", caught


def search(fault):
    found = []
    for program in PROGRAMS:
        outcome = Outcome(program, "*", fault["number"], SEARCH_TIMEOUT)
        found += [f"{program} {name}" for name in outcome.failed]
        if outcome.hung or outcome.code < 0:
            found.append(f"({program} {outcome.how()})")
    return f"{fault['name']}: {len(found)}" + "".join(f"\n    {name}" for name in found), bool(found)


def handful(faults):
    commit = subprocess.run(["git", "-C", shadow.ROOT, "rev-parse", "HEAD"], capture_output=True, text=True).stdout.strip()

    def rank(name):
        return hashlib.sha256((commit + name).encode()).hexdigest()

    chosen = []
    group = min(GROUPS, key=lambda programs: rank(" ".join(programs)))
    for program in group:
        of_program = [fault for fault in faults if {split(name)[0] for name in fault["caught_by"]} == {program}]
        chosen += sorted(of_program, key=lambda fault: rank(fault["name"]))[:HANDFUL // len(group)]
    print(f"{len(chosen)} of {len(faults)} faults, chosen by commit {commit[:12] or '(none)'}")
    return chosen


def arguments():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0], description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--handful", action="store_true", help=f"{HANDFUL} faults, others for each commit")
    parser.add_argument("--search", action="store_true", help="say which tests of all programs notice each fault")
    parser.add_argument("--list", action="store_true", help="print the faults and do nothing")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="test programs run at once (%(default)s)")
    return parser.parse_args()


def main():
    options = arguments()
    all_faults = shadow.load()
    faults = [fault for fault in all_faults if not options.names or fault["name"] in options.names]
    unknown = set(options.names) - {fault["name"] for fault in faults}
    if unknown:
        raise shadow.StaleFault(f"no fault {', '.join(sorted(unknown))}; --list prints them")
    if options.list:
        for fault in faults:
            print(f"{fault['name']:28} {fault['file']}: {fault['breaks']}")
        return 0
    if options.handful:
        faults = handful(faults)
    named = sorted({name for fault in faults for name in fault["caught_by"]})
    programs = sorted(PROGRAMS if options.search else {split(name)[0] for name in named})
    shadow.write(all_faults, BUILD / "source")
    print(f"building {', '.join(programs)} with {len(all_faults)} faults in them", flush=True)
    start = time.monotonic()
    build(programs)
    print(f"built in {time.monotonic() - start:.0f} s", flush=True)
    if not options.search and not check_right_code(named):
        return 1
    survived = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for fault, (line, caught) in zip(faults, pool.map(search if options.search else judge, faults)):
            print(line, flush=True)
            survived += [] if caught else [fault["name"]]
    print(f"{len(faults) - len(survived)} of {len(faults)} faults caught")
    return 1 if survived else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except shadow.StaleFault as stale:
        print(f"mutants: {stale}", file=sys.stderr)
        sys.exit(2)
