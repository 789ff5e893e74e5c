#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the tests of core and adapters and says which lines and branches of these they never reach.

A line that is never reached needs a reason in reasons.json;
one without a reason, a reason for a line that is reached or gone, and less than 95 % of all branches are failures
(exit code 1). All that is not reached goes to BUILD/uncovered.txt.

With --fuzz it plays the corpora of tests/fuzz alone, with the thresholds of products and with small ones, and says what
these reach of the rooms that searches are made of: each should have 95 % of its lines.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import marked_page  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
REASONS = pathlib.Path(__file__).resolve().parent / "reasons.json"
TESTS = ["core", "objects", "box_index", "out_of_core", "world", "bullet", "fcl", "ccd"]
COVERED = re.compile(r"^(include|src|adapters)/")
LEAST_BRANCHES = 95.0
FUZZED_ROOMS = ("batch", "box_index", "bvh", "nearest", "world")
FUZZED = re.compile(rf"^src/({'|'.join(FUZZED_ROOMS)})/")
LEAST_FUZZED_LINES = 95.0
# Conditions that a template argument or a type decides, which clang lists with no outcome at all.
CONSTANT = re.compile(r"!?\(?(is_self|is_run|true|sizeof\()")


def tool(name):
    for candidate in (f"{name}-14", name):
        if shutil.which(candidate):
            return candidate
    sys.exit(f"coverage: no {name}; ./dev setup installs it")


def programs(build, pattern):
    found = []
    for directory in TESTS:
        for path in sorted((build / "tests" / "library" / directory).iterdir()):
            if path.is_file() and os.access(path, os.X_OK) and re.search(r"_tests?$", path.name):
                found.append(path)
    return [path for path in found if re.search(pattern, path.name)]


def replays(build):
    """Those of fuzz targets that search, by the names of their corpora."""
    found = {}
    for path in sorted((build / "tests" / "fuzz").glob("boxstream_fuzz_*")):
        corpus = ROOT / "tests" / "fuzz" / "corpus" / (path.name.split("_")[2] + ".tar")
        if path.is_file() and os.access(path, os.X_OK) and re.search(r"_(bullet|core|fcl|index|rules|world)(_small)?$", path.name):
            found[path] = corpus
    return found


def run(tests, raw, arguments=lambda path: ["--gtest_brief=1"]):
    shutil.rmtree(raw, ignore_errors=True)

    def play(path):
        # Programs that die on purpose count too, for counters live in the file (%c).
        environment = dict(os.environ, LLVM_PROFILE_FILE=f"{raw}/{path.name}-%p%c.profraw")
        return path, subprocess.run([path, *arguments(path)], env=environment, stdout=subprocess.PIPE,
                                    stderr=subprocess.STDOUT, text=True, errors="replace")

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as cores:
        for number, (path, result) in enumerate(cores.map(play, tests), 1):
            print(f"{number}/{len(tests)} {path.name}", file=sys.stderr, flush=True)
            if result.returncode != 0:
                cores.shutdown(cancel_futures=True)
                sys.exit(f"{result.stdout}\ncoverage: {path.name} failed")


def export(tests, build):
    raw, profile = build / "raw", build / "coverage.profdata"
    files = [str(path) for path in sorted(raw.glob("*.profraw"))]
    listed = build / "profiles.txt"
    listed.write_text("\n".join(files))
    subprocess.run([tool("llvm-profdata"), "merge", "-sparse", f"--input-files={listed}", "-o", profile], check=True)
    objects = [word for path in tests[1:] for word in ("-object", path)]
    told = subprocess.run([tool("llvm-cov"), "export", "-format=text", f"-instr-profile={profile}",
                           tests[0], *objects], check=True, capture_output=True, text=True)
    return json.loads(told.stdout)["data"][0]


class File:
    """What was reached of one file: every template instance, SIMD target and precision of Bullet counts."""

    def __init__(self):
        self.lines = {}     # number: how often
        self.branches = collections.defaultdict(lambda: [0, 0])  # place: how often true, how often false

    def add_lines(self, segments):
        """As llvm-cov does: a line has the count of what covers its beginning, or the largest of those that begin in
        it."""
        by_line = collections.defaultdict(list)
        for segment in segments:
            by_line[segment[0]].append(segment)
        wrapped = None
        for line in range(min(by_line, default=1), max(by_line, default=0) + 1):
            here = by_line.get(line, [])
            begun = [s for s in here if s[3] and s[4] and not s[5]]
            counts = [s[2] for s in begun]
            if wrapped is not None and wrapped[3]:
                counts.append(wrapped[2])
            skipped = bool(here) and not here[0][3] and here[0][4]
            if counts and not skipped:
                self.lines[line] = max([self.lines.get(line, 0), *counts])
            if here:
                wrapped = here[-1]


def read(data, build, covered=COVERED):
    """A file may be there several times, by different paths: Highway includes sources once more for each target."""
    files = collections.defaultdict(File)
    for entry in data["files"]:
        name = os.path.relpath(os.path.join(build, entry["filename"]), ROOT)
        if not covered.match(name):
            continue
        files[name].add_lines(entry["segments"])
        for line, column, _, end, true, false, *_ in entry["branches"]:
            place = files[name].branches[line, column, end]
            place[0] += true
            place[1] += false
    for name, file in files.items():
        text = (ROOT / name).read_text().split("\n")
        for place in [place for place, both in file.branches.items() if not any(both)]:
            line = text[place[0] - 1]
            if "constexpr" in line or CONSTANT.match(line[place[1] - 1:]):
                del file.branches[place]
    return dict(sorted(files.items()))


def share(part, whole):
    return 100.0 * part / whole if whole else 100.0


def reached(file):
    outcomes = [count > 0 for both in file.branches.values() for count in both]
    return sum(count > 0 for count in file.lines.values()), len(file.lines), sum(outcomes), len(outcomes)


def table(files):
    rows = []
    total = [0, 0, 0, 0]
    for name, file in files.items():
        got = reached(file)
        total = [a + b for a, b in zip(total, got)]
        rows.append(row(f"`{name}`", got))
    rows.append(row("**all**", total))
    head = ["File", "Lines", "of", "%", "Branches", "of", "%"]
    return marked_page.lines_of(head, rows, ["---"] + 6 * ["---:"]), share(total[2], total[3])


def row(name, got):
    lines, of_lines, branches, of_branches = got
    percent = f"{share(branches, of_branches):.1f}" if of_branches else "-"
    return [name, str(lines), str(of_lines), f"{share(lines, of_lines):.1f}", str(branches), str(of_branches), percent]


def not_reached(files):
    """Lines as (file, text), in order, and all that is to be read about lines and branches."""
    lines, report = [], []
    for name, file in files.items():
        text = (ROOT / name).read_text().split("\n")
        places = [(number, 0, "line never reached") for number, count in file.lines.items() if count == 0]
        for (number, column, _), both in file.branches.items():
            if file.lines.get(number) == 0 or all(both):
                continue
            what = "neither true nor false" if not any(both) else "never true" if both[0] == 0 else "never false"
            places.append((number, column, what))
        for number, column, what in sorted(places):
            source = text[number - 1].strip()
            if column == 0:
                lines.append((name, source))
            report.append(f"{name}:{number}{f':{column}' if column else ''}: {what}: {source}")
    return lines, report


def check_reasons(lines):
    """What is wrong with reasons.json, in the order of the lines."""
    wrong = []
    reasons = json.loads(REASONS.read_text())
    known = {(entry["file"], entry["line"]): entry["reason"].strip() for entry in reasons}
    for place in dict.fromkeys(lines):
        if not known.get(place):
            wrong.append(f"{place[0]}: no test reaches this line, and it has no reason: {place[1]}")
    for place in known.keys() - set(lines):
        wrong.append(f"{place[0]}: a reason for a line that is reached, or gone: {place[1]}")
    return wrong


def by_fuzzing(options, build):
    corpora = replays(build)
    if not corpora:
        sys.exit(f"coverage: no replays in {build}: build the targets boxstream_fuzz_*")
    if not options.no_run:
        run(list(corpora), build / "raw", lambda path: [corpora[path]])
    files = read(export(list(corpora), build), build, FUZZED)
    text, _ = table(files)
    print(text)
    (build / "unfuzzed.txt").write_text("".join(f"{each}\n" for each in not_reached(files)[1]))
    if options.into:
        marked_page.put_out("\n" + text + "\n", options.into, "fuzz coverage")
    wrong = 0
    for room in FUZZED_ROOMS:
        got = [reached(file) for name, file in files.items() if name.startswith(f"src/{room}/")]
        percent = share(sum(each[0] for each in got), sum(each[1] for each in got))
        print(f"src/{room}: {percent:.1f} % of the lines")
        wrong |= percent < LEAST_FUZZED_LINES
    return int(wrong)


def main():
    parser = marked_page.parser(__doc__)
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD", help="build directory of preset coverage, built")
    parser.add_argument("--programs", default="", metavar="REGEX",
                        help="run only the test programs that match, to see what these reach")
    parser.add_argument("--no-run", action="store_true", help="look at the last run again")
    parser.add_argument("--fuzz", action="store_true", help="by the corpora of the fuzzers alone")
    options = parser.parse_args()
    marked_page.require_marks(options.into, "fuzz coverage" if options.fuzz else "coverage")
    build = options.build.resolve()
    if options.fuzz:
        return by_fuzzing(options, build)
    tests = programs(build, options.programs)
    if not tests:
        sys.exit(f"coverage: no test programs in {build}")
    if not options.no_run:
        run(tests, build / "raw")
    files = read(export(tests, build), build)
    text, percent = table(files)
    print(text)
    lines, report = not_reached(files)
    (build / "uncovered.txt").write_text("".join(f"{each}\n" for each in report))
    print(f"{len(report)} lines and branches are not reached: {build / 'uncovered.txt'}")
    if options.into:
        marked_page.put_out("\n" + text + "\n", options.into, "coverage")
    wrong = check_reasons(lines)
    if percent < LEAST_BRANCHES:
        wrong.append(f"{percent:.1f} % of the branches are reached, less than {LEAST_BRANCHES} %")
    for each in wrong:
        print(f"coverage: {each}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
