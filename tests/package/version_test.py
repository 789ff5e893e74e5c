#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The version is that of CMakeLists.txt's project(), and whatever cannot read it from there agrees: version_test.py ROOT"""
import json
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
text = {name: (root / name).read_text() for name in (
    "CMakeLists.txt", "include/boxstream/version.hpp", "CITATION.cff", "CHANGELOG.md", "docs/build.md", "docs/javascript.md",
    "debian/changelog", "cmake/packaging/vcpkg/boxstream/vcpkg.json")}
version = re.search(r"project\(boxstream VERSION ([\d.]+)", text["CMakeLists.txt"])[1]
release, date = re.search(r"^## \[([\d.]+)\] - (\d{4}-\d\d-\d\d)$", text["CHANGELOG.md"], re.M).groups()

assert release == version, f"CHANGELOG.md: the newest release is {release}"
assert ".".join(re.findall(r"VERSION_\w+ (\d+)", text["include/boxstream/version.hpp"])) == version, "version.hpp"
assert f"\nversion: {version}\ndate-released: {date}\n" in text["CITATION.cff"], "CITATION.cff"
assert text["debian/changelog"].startswith(f"boxstream ({version}-"), "debian/changelog"
assert json.loads(text["cmake/packaging/vcpkg/boxstream/vcpkg.json"])["version"] == version, "vcpkg.json"
for page in ("docs/build.md", "docs/javascript.md"):
    named = set(re.findall(r"boxstream-(\d+\.\d+\.\d+)\.t", text[page]))
    assert named == {version}, f"{page} names archives of {named}"
for project in ("consumer", "vendored"):
    wanted = re.search(r"find_package\(boxstream (\S+) REQUIRED", (root / "tests/package" / project / "CMakeLists.txt").read_text())[1]
    assert version.startswith(wanted + "."), f"tests/package/{project} asks for {wanted}"

# Symbols may be older than the release, and none may be newer.
number = lambda dotted: tuple(map(int, dotted.split(".")))
for symbols in root.glob("debian/*.symbols"):
    since = set(re.findall(r"@Base (\S+)$", symbols.read_text(), re.M))
    assert since and max(map(number, since)) <= number(version), symbols

# A place that is not real stands in one file, so that there is one line to change.
placeholders = [page for page in ("README.md", *(f"docs/{p.name}" for p in root.glob("docs/*.md")))
                if "example.org" in (root / page).read_text()]
assert len(placeholders) <= 1, placeholders
