#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs that know nothing of boxstream print the same on it, and boxstream-try says what it did and did not."""
import argparse
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = []
FOLDER = ""  # of what makes broad-phases that are not reached
TRY = ""


def run(*words, **more):
    return subprocess.run(words, capture_output=True, text=True, timeout=120, **more)


def tried(*words, **more):
    return run(TRY, *words, **more)


class Programs(unittest.TestCase):
    def test_print_the_same(self):
        for program in PROGRAMS:
            plain = run(program)
            self.assertEqual(plain.returncode, 0, program)
            for options in ([], ["--check"], ["--eager", "all", "--check"], ["--order=engine"]):
                with self.subTest(program=program, options=options):
                    done = tried(*options, "--", program)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(sorted(done.stdout.splitlines()), sorted(plain.stdout.splitlines()))
                    self.assertRegex(done.stderr, r"boxstream: lib\S+: [1-9]\d* (btDbvtBroadphase|manager)s replaced; ")
                    if "--check" in options:
                        compared = re.search(r"check: ([\d ]+) batch\w* and ([\d ]+) quer\w+ compared, [1-9]", done.stderr)
                        self.assertIsNotNone(compared, done.stderr)
                        self.assertGreater(int(compared[2].replace(" ", "")), 500)
                        self.assertIn("no difference", done.stderr)

    def test_a_wrong_pair_is_a_difference(self):
        for program in PROGRAMS:
            if "bullet" not in program:
                continue
            # Grown boxes that --check is not told of are pairs that do not touch.
            done = tried("--check", "--", program, env={**os.environ, "BOXSTREAM_TRY_UNTOLD_MARGIN": "0.25"})
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertRegex(done.stderr, r"differ; the first: batch \d+: boxstream has a pair that does not touch: proxy \d+ \[")

    def test_threads_that_ask_at_once(self):
        for program in PROGRAMS:
            if "bullet" not in program:
                continue
            for options in ([], ["--check"]):
                done = tried(*options, "--", program, "threads")
                self.assertEqual((done.returncode, done.stdout), (0, "on threads: the same\n"), done.stderr)
                self.assertNotIn("differ;", done.stderr)

    def test_times_of_both(self):
        done = tried("--compare", "--", PROGRAMS[0])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"the whole program +\d+\.\d+ s +\d+\.\d+ s +\d+\.\d\d\n")
        calls = re.search(r"calls of (?:Bullet|FCL)'s broad-phases and callbacks +(\d+\.\d+) s +(\d+\.\d+) s", done.stderr)
        self.assertIsNotNone(calls, done.stderr)
        self.assertGreater(min(float(calls[1]), float(calls[2])), 0)

    def test_children_are_replaced_too(self):
        done = tried("--", "sh", "-c", f"{PROGRAMS[0]} && {PROGRAMS[0]}")
        one = tried("--", PROGRAMS[0])
        made = [int(re.search(r": (\d+) \S+ replaced", text.stderr)[1]) for text in (one, done)]
        self.assertEqual(made[1], 2 * made[0])


class Limits(unittest.TestCase):
    def test_no_engine(self):
        done = tried("--", "true")
        self.assertEqual(done.returncode, 0)
        self.assertIn("no process of this program called a broad-phase of Bullet or FCL", done.stderr)
        self.assertNotIn("loaded", done.stderr)

    def test_the_code_of_the_program(self):
        self.assertEqual(tried("--", "sh", "-c", "exit 42").returncode, 42)
        self.assertEqual(tried("--", "sh", "-c", "kill -9 $$").returncode, 128 + 9)

    def test_wrong_arguments(self):
        for words, text in (
            ([], "no program is named"),
            (["--"], "no program is named"),
            (["--", "no-such-program-at-all"], "there is no program no-such-program-at-all"),
            (["--", tempfile.gettempdir()], "is a folder, not a program"),
            (["--", "/etc/passwd"], "/etc/passwd is a file that cannot be run: if it is a script, name what runs it"),
            (["--check=yes", "--", "true"], "--check takes no value: yes"),
            (["--margin", "-1", "--", "true"], "--margin takes a number, 0 or more: -1"),
            (["--margin", "wide", "--", "true"], "--margin takes a number"),
            (["--eager", "some", "--", "true"], "--eager takes ghosts, all or none: some"),
            (["--order", "mine", "--", "true"], "--order takes engine: mine"),
            (["--fast", "--", "true"], "no such option: --fast"),
            (["--check", "--compare", "--", "true"], "--compare goes without it"),
        ):
            done = tried(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(text, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_program_that_is_not_in_the_path(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "mine"), "w", encoding="ascii") as file:
                file.write("#!/bin/sh\n")
            os.chmod(file.name, 0o755)
            self.assertIn("no program mine in PATH: is it ./mine?", tried("--", "mine", cwd=folder).stderr)

    def test_no_place_for_its_files(self):
        done = tried("--", "true", env={**os.environ, "TMPDIR": "/no/such/folder"})
        self.assertEqual((done.returncode, done.stderr), (2, "boxstream: no folder for temporary files: /no/such/folder\n"))

    def test_nothing_to_compare_with(self):
        done = tried("--compare", "--", "sh", "-c", "exit 3")
        self.assertEqual(done.returncode, 3)
        self.assertIn("sh ended with status 3 on the engine's own: nothing is compared", done.stderr)

    def test_help(self):
        done = tried("--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("Usage: boxstream try", done.stdout)

    def test_a_static_program(self):
        with tempfile.TemporaryDirectory() as folder:
            source, program = os.path.join(folder, "a.c"), os.path.join(folder, "a")
            with open(source, "w", encoding="utf-8") as file:
                file.write("int main(void) { return 0; }\n")
            if run("cc", "-static", source, "-o", program).returncode != 0:
                self.skipTest("no static C library")
            done = tried("--", program)
            self.assertEqual(done.returncode, 2)
            self.assertIn("is linked statically", done.stderr)

    def test_a_program_with_rights(self):
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "a")
            shutil.copy(shutil.which("true"), program)
            os.chmod(program, 0o755 | stat.S_ISUID)  # with those of the caller, which are no others
            self.assertEqual(tried("--", program).returncode, 0)
            if os.geteuid() != 0:
                self.skipTest("only root gives files to others")
            os.chown(program, 65534, 65534)
            for mode in (stat.S_ISUID, stat.S_ISGID):
                os.chmod(program, 0o755 | mode)
                self.assertIn("runs with rights that you do not have", tried("--", program).stderr)

    def test_a_program_for_another_machine(self):
        with tempfile.TemporaryDirectory() as folder:
            program = os.path.join(folder, "a")
            with open(shutil.which("true"), "rb") as file:
                head = bytearray(file.read())
            head[4] ^= 3  # 32 bits for 64, and the other way round
            with open(program, "wb") as file:
                file.write(head)
            os.chmod(program, 0o755)
            done = tried("--", program)
            self.assertEqual(done.returncode, 2)
            self.assertIn("is for another processor, or of other word size", done.stderr)

    def test_an_engine_that_is_compiled_in(self):
        with tempfile.TemporaryDirectory() as folder:
            source, program = os.path.join(folder, "a.cpp"), os.path.join(folder, "a")
            with open(source, "w", encoding="utf-8") as file:
                file.write("#include <typeinfo>\n#include <cstdio>\nstruct btDbvtBroadphase { virtual ~btDbvtBroadphase() {} };\n"
                           "int main() { btDbvtBroadphase b; std::puts(typeid(b).name()); }\n")
            self.assertEqual(run("c++", source, "-o", program).returncode, 0)
            done = tried("--", program)
            self.assertIn("the program itself has btDbvtBroadphase compiled into it", done.stderr)


class Unreached(unittest.TestCase):
    """What of a program's engine is not replaced is named, whatever else of it is."""

    def built(self, name):
        if not os.path.exists(os.path.join(FOLDER, name)):
            self.skipTest("its engine is not installed")
        return os.path.join(FOLDER, name)

    def test_a_library_that_is_bound_deeply(self):
        library, host = self.built("libunreached_bullet.so"), self.built("unreached_host")
        done = tried("--check", "--", host, library)
        self.assertIn(": 1 btDbvtBroadphase replaced; ", done.stderr)
        self.assertNotIn("RTLD_DEEPBIND", done.stderr)
        done = tried("--check", "--", host, library, "deeply")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"boxstream: \S*libunreached_bullet.so binds its calls of \S*libBulletCollision\S* past "
                         r"what is preloaded, as RTLD_DEEPBIND has it: not replaced\n")
        self.assertNotIn("no process of this program called", done.stderr)

    def test_kinds_that_are_not_replaced(self):
        program = self.built("unreached_bullet")
        for kinds, found in ((["simple"], 0), (["simple", "tree"], 1)):
            done = tried("--", program, *kinds)
            self.assertRegex(done.stderr, r"the program itself can make btSimpleBroadphase of \S+, which is not replaced")
            self.assertEqual(done.stderr.count("1 btDbvtBroadphase replaced"), found)
        done = tried("--check", "--", program, "sweep")
        self.assertIn("1 btAxisSweep3 made and not replaced", done.stderr)
        self.assertIn("check: nothing was compared", done.stderr)
        self.assertNotIn("no difference", done.stderr)

    def test_managers_of_fcl(self):
        for name, line in (
            ("SaPCollisionManager", "the program itself has a sweep-and-prune manager of FCL compiled into it"),
            ("IntervalTreeCollisionManager", "the program itself has an interval tree of FCL compiled into it"),
            ("DynamicAABBTreeCollisionManager", "the program itself has a dynamic tree of FCL compiled into it"),
            ("hash", "the program itself can make fcl::SpatialHashingCollisionManager of "),
        ):
            self.assertIn(line, tried("--", self.built("unreached_" + name)).stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--try", dest="tried", required=True)
    parser.add_argument("--program", action="append", default=[])
    parser.add_argument("--library", action="append")
    parser.add_argument("--folder", required=True)
    given = parser.parse_args()
    FOLDER = given.folder
    TRY, PROGRAMS = os.path.abspath(given.tried), given.program
    unittest.main(argv=[sys.argv[0]], verbosity=2)
