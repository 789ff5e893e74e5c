#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a line for each seeded fault that does not go together with the sources; exit code 1 if there is one."""
import re
import sys

sys.dont_write_bytecode = True
import mutants  # noqa: E402
import shadow  # noqa: E402


def check(fault, found_in):
    """Adds a fault whose text is found to those of its file."""
    path = shadow.ROOT / fault["file"]
    if not path.is_file():
        raise shadow.StaleFault(f"fault {fault['name']}: no file {fault['file']}")
    shadow.place_of(path.read_text(), fault)
    is_whole = re.search(r";$|^(if|for|while|switch|do|try|{).*}$", fault["text"], re.DOTALL) is not None
    if is_whole != (fault.get("as") == "statement"):
        raise shadow.StaleFault(f"fault {fault['name']}: said to be a statement or not: {fault['text']!r}")
    found_in.setdefault(path, []).append(fault)
    for part in fault["text"], fault["faulty"]:
        if any(part.count(begin) != part.count(end) for begin, end in ("()", "[]", "{}")):
            raise shadow.StaleFault(f"fault {fault['name']}: no whole expression or statement: {part!r}")
    for test in fault["caught_by"]:
        mutants.split(test)


def main():
    complaints, found_in = [], {}
    try:
        for fault in shadow.load():
            try:
                check(fault, found_in)
            except shadow.StaleFault as stale:
                complaints.append(stale)
        for path, faults in found_in.items():
            shadow.with_faults(path.read_text(), faults)
    except shadow.StaleFault as stale:
        complaints.append(stale)
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
