#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A function of an engine that is not replaced would run on objects that are empty: each that the engine's library
exports of a replaced class is exported by the preloaded library, too, or has its reason here."""
import argparse
import re
import subprocess
import sys

CLASSES = re.compile(
    r"_ZNK?(16btDbvtBroadphase|3fcl(31DynamicAABBTreeCollisionManager|37DynamicAABBTreeCollisionManager_Array"
    r"|28IntervalTreeCollisionManager|21NaiveCollisionManager|20SSaPCollisionManager|19SaPCollisionManager)IdE)"
    r"(?P<member>.*)")
REASONS = {
    r"9benchmarkE": "static, and takes any broad-phase",
    r"7getTreeEv": "the tree itself, which is empty",
    r"(7update_E|12updateVelist|11updateObj|17addToOverlapPairs|22removeFromOverlapPairs)": "called within the class only",
    r"(8collide_E|9distance_E|9checkColl|8checkDis|9checkDist|12setupHelper|16optimizedTraversal|17selectOptimalAxis)":
        "called within the class only",
    r"(8EndPoint|11SAPInterval|7SaPPair|7SaPAABB|14isUnregistered|6isEqual|14isNotValidPair|SortBy|8SortBy)": "a class within the class",
}


def exported(library, kinds):
    lines = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    return {line.split()[2].split("@")[0] for line in lines.splitlines() if line.split()[1] in kinds}


def needed(library):
    """The engine's library that a replacement was linked with."""
    lines = subprocess.run(["ldd", library], check=True, capture_output=True, text=True).stdout
    return next(line.split()[2] for line in lines.splitlines() if re.match(r"\s*lib(BulletCollision|fcl)\b", line))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--preloaded", required=True)
    parser.add_argument("--library", action="append", default=[])
    parser.add_argument("--program", action="append")
    arguments = parser.parse_args()
    replaced = exported(arguments.preloaded, "TW")
    failures, seen = [], 0
    for library in arguments.library:
        engine = needed(library)
        for name in sorted(exported(engine, "TW")):
            found = CLASSES.fullmatch(name)
            if not found:
                continue
            seen += 1
            if name not in replaced and not any(re.match(reason, found["member"]) for reason in REASONS):
                failures.append(f"{engine}: {name} is neither replaced nor has a reason")
    if seen < 20:
        failures.append("no names of the engines were found")
    print("\n".join(failures) or f"{seen} names")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
