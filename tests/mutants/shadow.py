# SPDX-License-Identifier: MIT
"""The faults of faults.json, and a copy of the sources in which each of them can be switched on at run time.

A fault replaces one text by another. The text must occur once in its file; where it does not, `in` is a longer text
around it that does, and holds it once. As an expression (the default) it becomes (is_on(7) ? (faulty) : (text)), as a
statement if (is_on(7)) { faulty } else { text }.
"""
import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
COPIED = ["CMakeLists.txt", "cmake", "include", "src", "adapters", "demos", "tests"]
FIELDS = {"name", "file", "text", "faulty", "breaks", "caught_by"}
OPTIONAL = {"in", "as", "hangs"}


class StaleFault(Exception):
    """faults.json and the sources do not go together."""


def load():
    """The faults in their order, numbered from 1."""
    faults = json.loads((HERE / "faults.json").read_text())
    names = set()
    for number, fault in enumerate(faults, 1):
        name = fault.get("name", f"number {number}")
        wrong = (FIELDS - fault.keys()) | (fault.keys() - FIELDS - OPTIONAL)
        if wrong:
            raise StaleFault(f"fault {name}: missing or unknown: {', '.join(sorted(wrong))}")
        if name in names:
            raise StaleFault(f"fault {name} is there twice")
        if fault.get("as", "expression") not in ("expression", "statement"):
            raise StaleFault(f"fault {name}: \"as\" is neither \"expression\" nor \"statement\"")
        names.add(name)
        fault["number"] = number
    return faults


def find_once(text, part, fault, where):
    count = text.count(part)
    if count != 1:
        raise StaleFault(f"fault {fault['name']}: {where} occurs {count} times in {fault['file']}, not once: {part!r}")
    return text.index(part)


def switched(fault):
    on = f"::boxstream::mutants::is_on({fault['number']})"
    if fault.get("as") == "statement":
        return f"if ({on}) {{ {fault['faulty']} }} else {{ {fault['text']} }}"
    return f"({on} ? ({fault['faulty']}) : ({fault['text']}))"


def place_of(text, fault):
    """Where the fault's text begins and ends in that of its file."""
    around = fault.get("in", fault["text"])
    begin = find_once(text, around, fault, "\"in\"" if "in" in fault else "the text")
    begin += find_once(around, fault["text"], fault, "the text within \"in\"") if "in" in fault else 0
    return begin, begin + len(fault["text"])


def with_faults(text, faults):
    """The text of one file with all its faults built in. Lines keep their numbers as far as they can."""
    places = sorted(((*place_of(text, fault), fault) for fault in faults), key=lambda place: place[:2])
    for (_, end, first), (begin, _, second) in zip(places, places[1:]):
        if begin < end:
            raise StaleFault(f"faults {first['name']} and {second['name']} overlap")
    for begin, end, fault in reversed(places):
        text = text[:begin] + switched(fault) + text[end:]
    return text


def put(target, content):
    """Writes only what differs, so that a build after that is short."""
    if target.is_file() and target.read_bytes() == content:
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(content)


def adapted(name, content):
    """What building the shadow tree takes beside the faults."""
    if name == "src/CMakeLists.txt":
        return content + b"""
foreach(library IN ITEMS boxstream boxstream_small_thresholds)
  target_sources(${library} PRIVATE ${PROJECT_SOURCE_DIR}/tests/mutants/fault_switch.cpp)
endforeach()
"""
    return content


def write(faults, directory):
    """Makes or updates the shadow tree below `directory`."""
    by_file = {}
    for fault in faults:
        by_file.setdefault(fault["file"], []).append(fault)
    for name in by_file:
        if not (ROOT / name).is_file():
            raise StaleFault(f"fault {by_file[name][0]['name']}: no file {name}")
    wanted = set()
    for top in COPIED:
        path = ROOT / top
        for source in [path] if path.is_file() else sorted(path.rglob("*")):
            if not source.is_file() or "node_modules" in source.parts or "__pycache__" in source.parts:
                continue
            name = str(source.relative_to(ROOT))
            content = source.read_bytes()
            if name in by_file:
                content = with_faults(content.decode(), by_file[name]).encode()
            wanted.add(directory / name)
            put(directory / name, adapted(name, content))
    for old in directory.rglob("*"):
        if old.is_file() and old not in wanted:
            old.unlink()
