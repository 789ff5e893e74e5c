#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The schema of scenes against the loader.

  schema_test.py shipped VERDICTS      every scene and mesh file in demos/scenes is valid
  schema_test.py table VERDICTS        bad_scenes.json: the schema refuses what is not semantic, at the same place
  schema_test.py differences VERDICTS  every_*.json with each value changed in turn: both take it or both refuse it

VERDICTS is the program scene_verdicts, which says what the loader has against scenes.
"""
import copy
import json
import math
import pathlib
import re
import subprocess
import sys

import jsonschema

HERE = pathlib.Path(__file__).resolve().parent
DEMOS = HERE.parents[2] / "demos"
SCHEMA = json.loads((DEMOS / "formats" / "scene_json" / "scene.schema.json").read_text())
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

# Scenes that have everything between them.
EVERYTHING = sorted(HERE.glob("every_*.json"))

# Reasons of the loader that no schema can see: names, files, and what one key asks of another.
SEMANTIC = re.compile(
    r"no (shape|shape before this one|material|body) called|a second (shape|body|vehicle)|no such (file|folder): "
    r"|must be greater than \"min\"|must be in ascending order|a direction must not be zero|all points lie in one plane"
    r"|a triangle without area|parts of a compound are convex|this kind of shape is for static bodies"
    r"|a (brick|unit) is a box|more than the top row has|paddles that reach beyond|this kind of shape has one size"
    r"|more than 1000000 bodies|a joint to a static body|a body joined to itself|a body apart from itself"
    r"|no body has these products|these two are named twice|\".*\" is named twice|a chassis is a dynamic body|the run ends after step")
# Limits of the loader that depend on another key.
DEPENDENT = re.compile(
    r"/generators/\d+/(rows|gap): must be at most|/shapes/\d+/triangles/\d+/\d+: must be at most"
    r"|/shapes/\d+/(heightfield/)?heights: must have|/shapes/\d+/margin: must be at most")


def pointer_of(path):
    return "".join("/" + str(key).replace("~", "~0").replace("/", "~1") for key in path)


def path_of(pointer):
    return [key.replace("~1", "/").replace("~0", "~") for key in pointer.split("/")[1:]]


def parent_of(pointer):
    return pointer.rpartition("/")[0]


def step(value, key):
    return value[int(key)] if isinstance(value, list) else value[key]


def at(document, path):
    for key in path:
        document = step(document, key)
    return document


def put(document, path, value):
    parent = at(document, path[:-1])
    if not isinstance(parent, list):
        parent[path[-1]] = value
    elif path[-1] == "-":
        parent.append(value)
    else:
        parent[int(path[-1])] = value


def drop(document, path):
    parent = at(document, path[:-1])
    del parent[int(path[-1]) if isinstance(parent, list) else path[-1]]


def schema_errors(scene, path=()):
    """All errors, or for a scene that was right before a change at `path` those in the part around that: a block, or
    one thing of a block that is a list."""
    block = path[0] if path else None
    if block not in scene or block not in SCHEMA["properties"]:
        return list(VALIDATOR.iter_errors(scene))
    schema = SCHEMA["properties"][block]
    if len(path) < 3 or not isinstance(scene[block], list):
        return list(VALIDATOR.descend(scene[block], schema, path=block))
    errors = list(VALIDATOR.descend(scene[block][path[1]], schema["items"], path=path[1]))
    for error in errors:
        error.path.appendleft(block)
    return errors


def places(errors):
    return {pointer_of(error.absolute_path) for error in errors}


def loader_errors(program, scenes):
    """For each scene (pointer, reason) of what the loader says, or None."""
    text = "".join(json.dumps(scene) + "\n" for scene in scenes)
    run = subprocess.run([program, str(HERE)], input=text, capture_output=True, text=True, check=True)
    lines = run.stdout.split("\n")[:-1]
    assert run.stderr == "", run.stderr
    assert len(lines) == len(scenes), f"{len(scenes)} scenes, {len(lines)} verdicts"
    verdicts = []
    for line in lines:
        pointer, _, reason = line.partition(": ")
        verdicts.append(None if line == "" else ("" if pointer == "/" else pointer, reason))
    return verdicts


def same_place(pointer, errors):
    """The schema sees keys that are missing, unknown or exclude each other in the object around them."""
    found = places(errors)
    return pointer in found or parent_of(pointer) in found


def shipped(_):
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    failures = []
    # Scenes of queries have a format of their own.
    folders = ("", "effects/", "hard/")
    files = sorted(file for folder in folders for file in DEMOS.glob(f"scenes/{folder}*.json"))
    scenes = [file for file in files if not file.name.startswith("query_")]
    assert len(scenes) >= 15, scenes
    for file in [*scenes, *EVERYTHING]:
        for error in VALIDATOR.iter_errors(json.loads(file.read_text())):
            failures.append(f"{file}: {pointer_of(error.absolute_path)}: {error.message}")
    meshes = sorted(DEMOS.glob("scenes/meshes/*.json"))
    assert meshes
    for file in meshes:
        for error in VALIDATOR.descend(json.loads(file.read_text()), SCHEMA["$defs"]["mesh_file"]):
            failures.append(f"{file}: {pointer_of(error.absolute_path)}: {error.message}")
    return failures


def table(program):
    scene = json.loads((HERE / "every_kind.json").read_text())
    cases = json.loads((HERE / "bad_scenes.json").read_text())
    assert len(cases) == len({case["name"] for case in cases}), "a name is given twice"
    failures, spoilt = [], []
    for case in cases:
        bad = copy.deepcopy(scene)
        if "put" in case:
            put(bad, path_of(case["put"]), case["value"])
        else:
            drop(bad, path_of(case["drop"]))
        spoilt.append(bad)
    for case, bad, verdict in zip(cases, spoilt, loader_errors(program, spoilt)):
        block = path_of(case.get("put") or case["drop"])[:1]
        pointer = case.get("at", case.get("put"))
        pointer = "" if pointer == "/" else pointer
        errors = schema_errors(bad, block)
        if verdict is None or verdict[0] != pointer:
            failures.append(f"{case['name']}: expected {pointer}, the loader says {verdict}")
        if case.get("semantic"):
            if errors:
                failures.append(f"{case['name']}: marked as semantic, but the schema says {errors[0].message}")
        elif not same_place(pointer, errors):
            failures.append(f"{case['name']}: nothing wrong at {pointer} for the schema, but {sorted(places(errors))}")
    return failures


def walk(value, path=()):
    yield path, value
    if isinstance(value, dict):
        for key in value:
            yield from walk(value[key], (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from walk(item, (*path, index))


class Mutations:
    """Scenes that differ from a good one in one place, and what the schema says of each."""

    def __init__(self, scene):
        self.scene = scene
        self.found = []  # (what was done, scene, errors of the schema)
        self.lengths = []  # (pointer of a list, scene with another length of it, is that too short or too long?)

    def change(self, what, path, value):
        self._add(f"{what} {json.dumps(value)[:60]} at {pointer_of(path)}", path, lambda scene: put(scene, path, value))
        return self.found[-1][2]

    def drop(self, path):
        self._add(f"drop {pointer_of(path)}", path, lambda scene: drop(scene, path))

    def stretch(self, path, value, count, bad):
        self.lengths.append((pointer_of(path), self._changed(path, lambda scene: put(
            scene, path, (value * (count // len(value) + 1))[:count])), bad))

    def _add(self, what, path, edit):
        changed = self._changed(path, edit)
        self.found.append((what, changed, schema_errors(changed, path)))

    def _changed(self, path, edit):
        # Only the part that changes is copied: there are thousands of these.
        changed = dict(self.scene)
        if len(path) > 2 and isinstance(changed[path[0]], list):
            changed[path[0]] = list(changed[path[0]])
            changed[path[0]][path[1]] = copy.deepcopy(changed[path[0]][path[1]])
        elif path[0] in changed:
            changed[path[0]] = copy.deepcopy(changed[path[0]])
        edit(changed)
        return changed


def next_number(bound, whole, upwards):
    if whole:
        return bound + (1 if upwards else -1)
    return math.nextafter(bound, math.inf if upwards else -math.inf)


def mutate_number(mutations, path):
    """At each end of its range, and just beyond."""
    for far, keywords in ((-1e300, ("minimum", "exclusiveMinimum")), (1e300, ("maximum",))):
        for error in mutations.change("put", path, far):
            if list(error.absolute_path) == list(path) and error.validator in keywords:
                whole = error.schema.get("type") != "number"
                for value in (error.validator_value, next_number(error.validator_value, whole, True),
                              next_number(error.validator_value, whole, False)):
                    mutations.change("put", path, value)


def mutate_list(mutations, path, value):
    """At the least and the greatest length, and just beyond; greater ones than of any point or path go untested, and
    so do thousands of files."""
    errors = mutations.change("put", path, None) + mutations.change("put", path, [])
    schema = next(error.schema for error in errors
                  if list(error.absolute_path) == list(path) and "maxItems" in error.schema)
    least, most = schema.get("minItems", 0), schema["maxItems"]
    for count, bad in ((least - 1, True), (least, False), (most, False), (most + 1, True)):
        if 0 <= count <= 10001 and not (count > 100 and '"file"' in json.dumps(value)):
            mutations.stretch(path, value, count, bad)


def closed_definitions(schema):
    """Every part of the schema that says which keys an object may have, as text."""
    if isinstance(schema, dict):
        if schema.get("additionalProperties") is False:
            yield json.dumps(schema)
        for part in schema.values():
            yield from closed_definitions(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from closed_definitions(part)


def is_like_the_one_before(scene, path):
    """The other coordinates of a point are no different from its first."""
    index = path[-1]
    if not isinstance(index, int) or index == 0:
        return False
    return all(isinstance(item, (int, float)) for item in at(scene, path[:-1])[index - 1:index + 1])


def mutate(mutations, used, blocks):
    """Fills `used`: for each closed definition the keys that the scene has."""
    scene = mutations.scene
    for path, value in walk(scene):
        if not path or path[0] not in blocks or is_like_the_one_before(scene, path):
            continue
        mutations.drop(path)
        for other in (None, True, False, "word", "", 7, 0.5, [], {}):
            for error in mutations.change("put", path, other):
                if other == "word" and error.validator == "enum" and list(error.absolute_path) == list(path):
                    for word in error.validator_value:
                        mutations.change("put", path, word)
        if isinstance(value, dict):
            for error in mutations.change("add", (*path, "zzz"), 1):
                if error.validator == "additionalProperties":
                    used.setdefault(json.dumps(error.schema), set()).update(value)
        elif isinstance(value, list):
            mutations.drop((*path, 0))
            mutate_list(mutations, path, value)
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            mutate_number(mutations, path)


def unused(used):
    """What the scene would leave untested."""
    root = {key: part for key, part in SCHEMA.items() if key not in ("additionalProperties", "$defs")}
    parts = {name: part for name, part in SCHEMA["$defs"].items() if name != "mesh_file"}  # of another file
    somewhere = set().union(*used.values())
    for definition in sorted({*closed_definitions(root), *closed_definitions(parts)}):
        keys = json.loads(definition)["properties"]
        # Keys that all kinds of a thing share are "true" in each, and need only be somewhere.
        missing = [key for key in keys if key not in (somewhere if keys[key] is True else used.get(definition, ()))]
        if missing:
            yield f"{[file.name for file in EVERYTHING]} never have {missing} among {list(keys)}"


def known_words(reason):
    return re.fullmatch(r".*\(known: (.*)\)", reason)[1].split(", ")


def difference(errors, verdict):
    """Why the schema and the loader do not agree on a scene, if so."""
    if verdict is None:
        return f"the loader takes it, the schema says {errors[0].message[:200]}" if errors else None
    pointer, reason = verdict
    means = SEMANTIC.match(reason) or DEPENDENT.match(f"{pointer}: {reason}")
    if means:
        return None
    if not errors:
        return f"the schema takes it, the loader says {pointer}: {reason}"
    if not same_place(pointer, errors):
        return f"the loader says {pointer}: {reason}; the schema finds {sorted(places(errors))}"
    for error in errors:
        here = pointer_of(error.absolute_path)
        if here == pointer and error.validator == "enum" and "(known: " in reason:
            # What is no word, such as true for a name that stands for it, the loader does not list.
            if known_words(reason) != [value for value in error.validator_value if isinstance(value, str)]:
                return f"the loader knows {known_words(reason)}, the schema {error.validator_value}"
        if here == parent_of(pointer) and error.validator == "additionalProperties" and pointer.endswith("/zzz"):
            if extra := set(known_words(reason)) - set(error.schema["properties"]):
                return f"the loader knows {sorted(extra)}, the schema does not"
    return None


def differences(program):
    used, found, lengths = {}, [], []
    for file in EVERYTHING:
        scene = json.loads(file.read_text())
        mutations = Mutations(scene)
        mutate(mutations, used, scene)
        # Gravity is a vector or a script.
        mutations.scene = {**scene, "world": {**scene["world"], "gravity": [0, -9.81, 0]}}
        mutate(mutations, used, ["world"])
        found += mutations.found
        lengths += mutations.lengths
    failures = list(unused(used))

    verdicts = loader_errors(program, [changed for _, changed, _ in found])
    for (what, _, errors), verdict in zip(found, verdicts):
        if reason := difference(errors, verdict):
            failures.append(f"{what}: {reason}")
    taken = sum(verdict is None for verdict in verdicts)
    both = sum(verdict is not None and bool(errors) for (_, _, errors), verdict in zip(found, verdicts))
    alone = len(verdicts) - taken - both
    print(f"{len(verdicts)} scenes: {taken} taken, {both} refused by both, {alone} by the loader alone")

    verdicts = loader_errors(program, [changed for _, changed, _ in lengths])
    for (pointer, changed, bad), verdict in zip(lengths, verdicts):
        refused = verdict is not None and verdict[0] == pointer and verdict[1].startswith("must have")
        if refused != bad:
            length = len(at(changed, path_of(pointer)))
            does = "refuses" if bad else "takes"
            failures.append(f"{pointer}: the schema {does} a length of {length}, the loader says {verdict}")
    print(f"{len(verdicts)} lengths of lists")
    return failures


def main():
    checks = {"shipped": shipped, "table": table, "differences": differences}
    if len(sys.argv) != 3 or sys.argv[1] not in checks:
        sys.exit(__doc__)
    failures = checks[sys.argv[1]](sys.argv[2])
    for failure in failures:
        print(failure)
    sys.exit(f"{len(failures)} failures" if failures else 0)


main()
