#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""./dev VERB --help prints the usage of that verb and runs nothing, wherever --help stands; ./dev --version prints the
version of CMakeLists.txt: dev_help_test.py ROOT"""
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(sys.argv[1]).resolve()


def dev(*arguments):
    run = subprocess.run([root / "dev", *arguments], capture_output=True, text=True, timeout=20)
    assert run.returncode == 0 and run.stderr == "", (arguments, run)
    return run.stdout


version = re.search(r"project\(boxstream VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
assert dev("--version") == f"boxstream {version}\n"

verbs = re.findall(r"^  (\w+)  +", dev(), re.M)
assert {"build", "demo", "test", "bench", "clean"} <= set(verbs), verbs
for verb in verbs:
    text = dev(verb, "--help")
    assert text.startswith(f"usage: ./dev {verb}"), (verb, text)
    assert dev("help", verb) == text, verb
    if verb != "clean":  # which, if this were broken, would delete what runs the test
        assert dev(verb, "something", "--help") == dev(verb, "-h") == text, verb
