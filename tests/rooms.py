#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads every #include and fails where an arrow between rooms points upwards. docs/internals/architecture.md draws the rooms."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# What each root may include, and its rooms (folders, with those below them) from the bottom to the top.
KNOWS = {
    "include": ["include"],
    "src": ["include", "src"],
    "adapters": ["include", "adapters"],
    "demos": ["include", "adapters", "demos"],
    "bench": ["include", "adapters", "demos", "bench", "src"],
    "tests/library": ["include", "adapters", "src", "tests/library", "tests/support",
                      "demos/inputs", "demos/formats/record/forwarding_broadphase.hpp"],
}
ROOMS = {
    "src": "base bvh batch/parallel batch/records batch/leaf batch/hybrid batch/cuts batch/front batch nearest box_index world/state world/fat_boxes world objects out_of_core",
    "demos": "measure base inputs formats/scene_model formats/geometry formats/import formats/scene_json formats/record formats/aabbs "
             "pictures/solids pictures/drawing mesh papers/structures papers/volumes papers/hybrid papers/thick "
             "papers/experiments simulation/engine simulation/effects simulation/run simulation/query simulation/python pictures/viewer "
             "accuracy boxstream/shared boxstream/advice boxstream/simulate boxstream examples",
    "bench": "witnesses inputs peers tables suites commands users engine report/format report/references report/boxes "
             "cliffs mpi report/narrow_phase report/pair_orders report/experiment_kinds report .",
}
# Where quoted includes are looked for, besides the folder of the file itself.
PATHS = ["src", "demos", "bench", "include", "tests/library", "tests/support", "tests/lab"] + [
    str(path.relative_to(ROOT)) for kind in ("include", "src") for path in sorted(ROOT.glob(f"adapters/*/{kind}"))]
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<(boxstream/[^>]+)>)', re.M)


def target_of(file, name):
    for folder in [file.parent, *file.parent.parents]:
        if folder == ROOT.parent:
            break
        if (folder / name).is_file():
            return (folder / name).resolve().relative_to(ROOT)
    for path in PATHS:
        if (ROOT / path / name).is_file():
            return pathlib.Path(path) / name
    return None


def edges():
    for root in KNOWS:
        for file in sorted((ROOT / root).rglob("*")):
            if file.suffix not in (".cpp", ".hpp") or "node_modules" in file.parts:
                continue
            for match in INCLUDE.finditer(file.read_text(encoding="utf-8")):
                target = target_of(file, match[1] or match[2])
                if target is not None:
                    yield root, file.relative_to(ROOT), target


def level(path):
    """The place of a file's room in its root, and the room."""
    names = ROOMS[path.parts[0]].split()
    folder = "/".join(path.parts[1:-1])
    for place, name in enumerate(names):
        inside = [other for other in names if other.startswith(name + "/")]
        if folder == name or (folder + "/").startswith(name + "/") and not any(
                (folder + "/").startswith(other + "/") for other in inside):
            return place, name
    return (names.index("."), ".") if folder == "" and "." in names else (None, folder)


def main():
    complaints, count = [], 0
    for root, file, target in edges():
        count += 1
        if not any(target.is_relative_to(known) for known in KNOWS[root]):
            complaints.append(f"{file} includes {target}: {root} must not know {target.parts[0]}")
        if root != target.parts[0] or root not in ROOMS:
            continue
        (here, room), (there, other) = level(file), level(target)
        if None in (here, there):
            complaints.append(f"{file}: {room if here is None else other} has no place among the rooms of {root}")
        elif here < there:
            complaints.append(f"{file} includes {target}: {room} is below {other}")
    print("\n".join(complaints) or f"{count} includes, all arrows point downwards")
    return 1 if complaints or count < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
