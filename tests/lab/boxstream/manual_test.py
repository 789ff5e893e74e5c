#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""manual_test.py TOOL [PAGES]: --help and completion say the same of every command; the manual has a proper page of each."""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

TOOL = str(pathlib.Path(sys.argv.pop(1)).resolve())
PAGES = sorted(pathlib.Path(sys.argv.pop(1)).glob("*.1")) if len(sys.argv) > 1 else []


def tool(*words):
    return subprocess.run([TOOL, *words], check=True, capture_output=True, text=True).stdout


def section(text, name):
    found = re.search(rf"^{name}:\n((?:  .*\n|\n)*)", text, re.M)
    return found[1] if found else ""


def first_words(text):
    return re.findall(r"^  ([A-Za-z]\S*)", text, re.M)


def options_of_help(*command):
    entries = re.findall(r"^  (-\S+)", section(tool(*command, "--help"), "Options"), re.M)
    return {name for entry in entries for name in entry.split(",")}


def commands_of_help(*command):
    return first_words(section(tool(*command, "--help"), "Subcommands"))


def all_commands(above=()):
    yield above
    for name in commands_of_help(*above):
        yield from all_commands((*above, name))


def completed(*words):
    return [line.split("\t")[0] for line in tool("complete", "--", *words).splitlines()[1:]]


class Descriptions(unittest.TestCase):
    def test_there_are_commands(self):
        self.assertTrue({("simulate",), ("mesh", "check")} <= set(all_commands()))

    def test_options_are_those_of_help(self):
        for command in all_commands():
            with self.subTest(command=command):
                wanted = options_of_help(*command)
                self.assertIn("--help", wanted)
                self.assertEqual(set(completed(*command, "-")), wanted)

    def test_commands_are_those_of_help(self):
        for command in all_commands():
            with self.subTest(command=command):
                wanted = commands_of_help(*command)
                self.assertNotIn("complete", wanted)
                if wanted:
                    self.assertEqual(completed(*command, ""), wanted)

    def test_words_of_options(self):
        self.assertEqual(completed("simulate", "pile", "--broadphase", ""),
                         ["boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple"])
        self.assertEqual(completed("aabbs", "f", "--compare=w"), ["--compare=world"])
        self.assertEqual(completed("mesh", "make", ""), ["klein", "sphere", "torus"])
        self.assertEqual(completed("import", "f", "--up", ""), ["y", "z"])
        self.assertIn("substeps=", completed("accuracy", "wall", "--knob", "s"))
        self.assertIn("penetration", completed("accuracy", "wall", "--metric", ""))
        self.assertEqual(completed("paper", "hybrid", "--figure", "6,table"), ["6,table1", "6,table2", "6,table3"])
        self.assertEqual(completed("completion", ""), ["bash", "zsh", "fish"])

    def test_scenes(self):
        listed = [line.split()[0] for line in tool("list").splitlines()]
        offered = completed("simulate", "")
        self.assertEqual([name for name in offered if name[-1] != "/"],
                         [name for name in listed if not name.startswith("query_")])
        self.assertEqual([name for name in offered if name[-1] == "/"], ["effects/", "hard/"])
        self.assertIn("effects/wind", completed("simulate", "effects/w"))
        self.assertEqual(completed("query", "query_"), [name for name in listed if name.startswith("query_")])

    def test_places(self):
        def beside(*words):
            return tool("complete", "--", *words).splitlines()[0]
        self.assertEqual(beside("simulate", ""), "files")
        self.assertEqual(beside("simulate", "pile", "--json", ""), "files")
        self.assertEqual(beside("paper", "hybrid", "--csv", ""), "directories")
        self.assertEqual(beside("simulate", "pile", "--steps", ""), "nothing")
        self.assertEqual(completed("simulate", "--json", "simulate", "pil"), ["pile"])
        self.assertEqual(completed("simulate", "pile", ""), [], "there is one argument")
        self.assertNotIn("--steps", completed("simulate", "pile", "--steps", "3", "--st"))
        self.assertIn("--knob", completed("accuracy", "wall", "--knob", "erp=1", "--kn"))
        self.assertEqual(completed("pairs", "--", "-"), [])
        self.assertEqual(completed("nonesuch", ""), commands_of_help())


@unittest.skipUnless(PAGES, "the manual was not made")
class Pages(unittest.TestCase):
    def test_one_for_each_command(self):
        self.assertEqual([page.name for page in PAGES],
                         sorted("-".join(("boxstream", *command)) + ".1" for command in all_commands()))
        for page in PAGES:
            self.assertRegex(page.read_text(), rf"(?m)^\.SH NAME\n{page.stem} \\- .")

    def test_options_are_those_of_help(self):
        page = next(page for page in PAGES if page.name == "boxstream-simulate.1").read_text().replace("\\", "")
        for option in options_of_help("simulate"):
            self.assertRegex(page, rf"(?m)^\.TP\n.*{option}")

    def test_groff_has_no_warnings(self):
        if shutil.which("groff") is None:
            self.skipTest("no groff")
        for page in PAGES:
            run = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-rLL=80n", "-z", page], capture_output=True, text=True,
                                 check=False)
            self.assertEqual((run.returncode, run.stderr), (0, ""), page)

    def test_mandoc_has_no_warnings(self):
        if shutil.which("mandoc") is None:
            self.skipTest("no mandoc")
        for page in PAGES:
            run = subprocess.run(["mandoc", "-Tlint", "-Wwarning", page], capture_output=True, text=True, check=False)
            # A date would make each build another page.
            self.assertEqual([line for line in run.stdout.splitlines() if "missing date" not in line], [], page)


class Refusals(unittest.TestCase):
    def test_what_is_not_known_is_named_with_the_nearest(self):
        for words, part in [(("simulat",), "unknown command 'simulat'; did you mean 'simulate'?"),
                            (("mesh", "chekc"), "unknown command 'chekc'; did you mean 'check'?"),
                            (("completion", "bsh"), "unknown shell 'bsh'; did you mean 'bash'?")]:
            run = subprocess.run([TOOL, *words], capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, run.stdout), (2, ""))
            self.assertIn(part, run.stderr)


if __name__ == "__main__":
    unittest.main()
