#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""manual_test.py TOOL: --help, the manual and completion say the same of every command; pages are proper man pages."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TOOL = str(pathlib.Path(sys.argv.pop(1)).resolve())


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


def man_entries(page, name):
    body = re.search(rf"^\.SH {name}\n((?:(?!\.SH).*\n)*)", page, re.M)
    return [re.sub(r"\\f[BIR]|\\(?=-)", "", term) for term in re.findall(r"^\.TP\n(.*)", body[1] if body else "", re.M)]


def completed(*words):
    return [line.split("\t")[0] for line in tool("complete", "--", *words).splitlines()[1:]]


class Descriptions(unittest.TestCase):
    def test_there_are_commands(self):
        self.assertTrue({("simulate",), ("mesh", "check"), ("man",)} <= set(all_commands()))

    def test_options_are_those_of_help(self):
        for command in all_commands():
            with self.subTest(command=command):
                wanted = options_of_help(*command)
                self.assertIn("--help", wanted)
                entries = man_entries(tool("man", *command), "OPTIONS")
                of_man = {word for entry in entries for word in entry.replace(",", "").split() if re.match("-+[a-z]", word)}
                self.assertEqual(of_man, wanted)
                self.assertEqual(set(completed(*command, "-")), wanted)

    def test_commands_are_those_of_help(self):
        for command in all_commands():
            with self.subTest(command=command):
                wanted = commands_of_help(*command)
                self.assertNotIn("complete", wanted)
                page = "-".join(("boxstream", *command))
                of_man = [entry.removesuffix("(1)") for entry in man_entries(tool("man", *command), "COMMANDS")]
                self.assertEqual(of_man, [f"{page}-{name}" for name in wanted])
                if wanted:
                    self.assertEqual(completed(*command, ""), wanted)

    def test_arguments_are_those_of_help(self):
        for command in all_commands():
            with self.subTest(command=command):
                wanted = first_words(section(tool(*command, "--help"), "Positionals"))
                self.assertEqual(man_entries(tool("man", *command), "ARGUMENTS"), wanted)

    def test_text_of_options_is_that_of_help(self):
        flat = " ".join(re.sub(r"\\\((?:aq|dq)", lambda m: {"\\(aq": "'", "\\(dq": '"'}[m[0]], tool("man", "simulate"))
                        .replace("\\-", "-").split())
        for line in section(tool("simulate", "--help"), "Options").splitlines():
            about = re.match(r"  -\S+(?: \S+)* {2,}(.*)", line)
            self.assertIn(" ".join(about[1].split()[:6]) if about else "", flat)

    def test_words_of_options(self):
        self.assertEqual(completed("simulate", "pile", "--broadphase", ""),
                         ["boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple"])
        self.assertEqual(completed("aabbs", "f", "--compare=w"), ["--compare=world"])
        self.assertEqual(completed("mesh", "make", ""), ["klein", "sphere", "torus"])
        self.assertEqual(completed("import", "f", "--up", ""), ["y", "z"])
        self.assertIn("substeps=", completed("accuracy", "wall", "--knob", "s"))
        self.assertIn("penetration", completed("accuracy", "wall", "--metric", ""))
        self.assertEqual(completed("paper", "hybrid", "--figure", "6,table"), ["6,table1", "6,table2", "6,table3"])
        self.assertEqual(completed("man", "mes"), ["mesh"])
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


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        tool("man", "--into", cls.folder.name)
        cls.pages = sorted(pathlib.Path(cls.folder.name).iterdir())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_one_for_each_command(self):
        self.assertEqual([page.name for page in self.pages],
                         sorted("-".join(("boxstream", *command)) + ".1" for command in all_commands()))
        self.assertEqual((self.pages[0].parent / "boxstream-mesh-check.1").read_text(), tool("man", "mesh", "check"))

    def says_nothing(self, *command):
        if shutil.which(command[0]) is None:
            self.skipTest(f"no {command[0]}")
        for page in self.pages:
            run = subprocess.run([*command, page], capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, run.stderr), (0, ""), page)

    def test_groff_has_no_warnings(self):
        self.says_nothing("groff", "-man", "-Tutf8", "-ww", "-rLL=80n", "-z")

    def test_mandoc_has_no_warnings(self):
        if shutil.which("mandoc") is None:
            self.skipTest("no mandoc")
        for page in self.pages:
            run = subprocess.run(["mandoc", "-Tlint", "-Wwarning", page], capture_output=True, text=True, check=False)
            # A date would make each build another page.
            self.assertEqual([line for line in run.stdout.splitlines() if "missing date" not in line], [], page)

    def test_eighty_columns_are_enough(self):
        if shutil.which("groff") is None:
            self.skipTest("no groff")
        for page in self.pages:
            text = subprocess.run(["groff", "-man", "-Tascii", "-P-c", "-P-b", "-P-o", "-P-u", "-rLL=80n", page],
                                  capture_output=True, text=True, check=True).stdout
            self.assertIn("NAME", text)
            # Examples stay as they are: a command that is broken could not be copied.
            wide = [line for line in text.splitlines() if len(line) > 80 and not re.match(r" +(boxstream|\{|\"|A B)", line)]
            self.assertEqual(wide, [], page)


class Refusals(unittest.TestCase):
    def test_what_is_not_known_is_named_with_the_nearest(self):
        for words, part in [(("man", "simulat"), "unknown command 'simulat'; did you mean 'simulate'?"),
                            (("man", "mesh", "chekc"), "unknown command 'chekc'; did you mean 'check'?"),
                            (("completion", "bsh"), "unknown shell 'bsh'; did you mean 'bash'?")]:
            run = subprocess.run([TOOL, *words], capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, run.stdout), (2, ""))
            self.assertIn(part, run.stderr)


if __name__ == "__main__":
    unittest.main()
