#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What is promised of hard boxes, and which tests assert it: tests/hard_boxes.json against a build.

`check` fails if a test that the table names is not in the build. `run` runs all of them and prints the table with what
became of each. Exit code 1 if a test is missing or failed.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "support"))
import marked_page  # noqa: E402

TABLE = pathlib.Path(__file__).resolve().with_name("hard_boxes.json")
COLUMNS = {"core": "Detector", "world": "World", "bullet": "Bullet adapter", "fcl": "FCL adapter"}


def read_table():
    rows = json.loads(TABLE.read_text())["rows"]
    for row in rows:
        missing = {"row", "case", "promise", *COLUMNS} - row.keys()
        assert not missing, f"row {row.get('row')}: no {', '.join(sorted(missing))}"
        for column in COLUMNS:
            cell = row[column]
            assert isinstance(cell, str) or cell, f"row {row['row']}, {column}: neither tests nor a reason"
    numbers = [row["row"] for row in rows]
    assert numbers == list(range(1, 33)), f"rows are not 1 to 32: {numbers}"
    return rows


def without(build):
    """The marks behind names of tests that this build does not have."""
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text()
    marks = []
    if "CMAKE_BUILD_TYPE:STRING=Release" in cache:
        marks.append(" (asserts)")
    if re.search("BOXSTREAM_SANITIZE:.*=.", cache):
        marks.append(" (no sanitizer)")
    return marks


def bare(name):
    return name.split(" (")[0]


def named_tests(rows, marks):
    """All names in the table but those with one of these marks."""
    for row in rows:
        for column in COLUMNS:
            for name in row[column] if isinstance(row[column], list) else []:
                if not name.endswith(tuple(marks)):
                    yield row["row"], column, bare(name)


def pattern(name):
    """Of the test in each instance: "suite.Group.Name" is "suite.Group.Name<float>", "suite.All/Group.Name/3" as well,
    and the Bullet adapter has each of its tests in two precisions."""
    suite, group, test = name.split(".")
    suite += "(_float64)?" if suite == "bullet" else ""
    return rf"{suite}\.([^.]+/)?{re.escape(group)}\.{re.escape(test)}([/<].*)?"


def tests_of(build):
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True,
                            check=True)
    names = []
    for test in json.loads(listed.stdout)["tests"]:
        program = pathlib.Path(test.get("command", [""])[0]).name
        quarter = f"{program}.0"
        if program and test["name"].endswith(quarter):
            names += [test["name"].removesuffix(quarter) + name for name in tests_in(test["command"][0])]
        else:
            names.append(test["name"])
    return names


def tests_in(program):
    """Sanitized builds give ctest a program's tests in quarters (cmake/gtests.cmake), so the program is asked."""
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True)
    group = ""
    for line in listed.stdout.splitlines():
        name = line.split("#")[0].strip()
        if line.startswith("  "):
            yield group + name
        elif name.endswith("."):
            group = re.sub(r"/[0-9]+\.$", ".", name)


def check(build):
    tests = tests_of(build)
    missing = [f"row {row}, {column}: no test {name} in {build}"
               for row, column, name in named_tests(read_table(), without(build))
               if not any(re.fullmatch(pattern(name), test) for test in tests)]
    print("\n".join(missing) or "every test of the table is there")
    return int(bool(missing))


def run_tests(build, names):
    """What became of each test, by its name in ctest: "run" if it passed."""
    with tempfile.TemporaryDirectory() as directory:
        report = pathlib.Path(directory) / "report.xml"
        regex = re.compile("|".join({pattern(name) for name in names}))
        numbers = [str(i) for i, test in enumerate(tests_of(build), 1) if regex.fullmatch(test)]
        if not numbers:
            return {}
        subprocess.run(["ctest", "--test-dir", build, "--output-junit", report, "-j", "2",
                        "-I", ",".join([numbers[0], numbers[0], "1", *numbers])], stdout=sys.stderr, check=False)
        return {case.get("name"): case.get("status") for case in xml.parse(report).getroot().iter("testcase")}


def outcome(name, statuses):
    found = [status for test, status in statuses.items() if re.fullmatch(pattern(name), test)]
    if not found:
        return "missing"
    return "passed" if all(status == "run" for status in found) else "failed"


def cell(row, column, outcomes):
    given = row[column]
    if isinstance(given, str):
        return f"does not apply: {given}", None
    lines = []
    for name in given:
        mark = name.removeprefix(bare(name)).strip(" ()")
        told = outcomes.get(bare(name), {"asserts": "in builds with asserts"}.get(mark, f"with {mark}"))
        lines.append(f"`{bare(name).split('.', 1)[1]}` {told}")
    return "<br>".join(lines), all("failed" not in line and "missing" not in line for line in lines)


def run(build):
    rows = read_table()
    names = [name for _, _, name in named_tests(rows, without(build))]
    statuses = run_tests(build, names)
    outcomes = {name: outcome(name, statuses) for name in names}
    lines, asserted, inapplicable, failed = [], 0, 0, 0
    for row in rows:
        lines.append([str(row["row"]), f"**{row['case']}**", row["promise"]])
        for column, title in COLUMNS.items():
            text, passed = cell(row, column, outcomes)
            lines.append(["", title, text])
            asserted += passed is not None
            inapplicable += passed is None
            failed += passed is False
    head = [f"{len(rows)} cases for {len(COLUMNS)} parts: {asserted} asserted by {len(outcomes)} tests in "
            f"{len(statuses)} instances, {inapplicable} that do not apply. "
            f"{f'{failed} failed' if failed else 'All passed'}.", "", ""]
    return "\n".join(head) + marked_page.lines_of(["", "Case, and parts", "Promise, and tests"], lines), failed


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("verb", choices=["check", "run"])
    parser.add_argument("build", help="build directory with tests")
    options = parser.parse_args()
    if not (pathlib.Path(options.build) / "CTestTestfile.cmake").is_file():
        print(f"{options.build}: not a build with tests", file=sys.stderr)
        return 2
    if options.verb == "check":
        return check(options.build)
    marked_page.require_marks(options.into, "hard boxes")
    text, failed = run(options.build)
    marked_page.put_out(text, options.into, "hard boxes")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
