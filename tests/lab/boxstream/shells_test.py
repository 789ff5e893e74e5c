#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""shells_test.py TOOL: types the beginnings of words and a tab into shells, and reads what became of them."""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

TOOL = pathlib.Path(sys.argv.pop(1)).resolve()

# What is typed, and the command line that it becomes.
LINES = [
    ("boxstream simul\tpil\t--broad\tdbvt-\t", "boxstream simulate pile --broadphase dbvt-deferred"),
    ("boxstream simulate eff\tbuoy\t", "boxstream simulate effects/buoyancy"),
    ("boxstream accuracy wall --kn\tsubs\t1,2 --metric tunn\t", "boxstream accuracy wall --knob substeps=1,2 --metric tunnelled"),
    ("boxstream paper hybrid --figure 6,or\t--qui\t", "boxstream paper hybrid --figure 6,order --quick"),
    ("boxstream pairs --solver=mp\tbox-fi\t", "boxstream pairs --solver=mpr box-file.txt"),
    ("boxstream simulate pile --json=box-fi\t", "boxstream simulate pile --json=box-file.txt"),
    ("boxstream paper hybrid --csv box-\t --qui\t", "boxstream paper hybrid --csv box-folder/ --quick"),
    ("boxstream mesh che\tbox-fi\t--li\t", "boxstream mesh check box-file.txt --list"),
]
PREPARED = {
    "bash": (["--norc", "--noprofile", "-i"], ["bind 'set enable-bracketed-paste off'", "source <(boxstream completion bash)"]),
    "zsh": (["-f", "-i"], ["unsetopt prompt_cr prompt_sp zle_bracketed_paste 2>/dev/null; bindkey -e", "autoload -U compinit && compinit -u -D", "source <(boxstream completion zsh)"]),
}


class Shell:
    """An interactive shell on a terminal of its own."""

    def __init__(self, name, folder):
        arguments, lines = PREPARED[name]
        environment = {"PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "HOME": str(folder), "TERM": "xterm",
                       "PS1": "$ ", "LC_ALL": "C.UTF-8"}
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.chdir(folder)
            os.execvpe(name, [name, *arguments], environment)
        for line in lines:
            self.type(line + "\r")
        self.enter("echo @ready", "@ready")

    def type(self, keys):
        os.write(self.terminal, keys.encode())

    def enter(self, line, answer, seconds=60):
        """Types the line and reads until a line of the answer begins as `answer` does, which is returned."""
        self.type(line + "\r")
        text, end = "", time.monotonic() + seconds
        while time.monotonic() < end:
            if select.select([self.terminal], [], [], 0.2)[0]:
                text += os.read(self.terminal, 65536).decode(errors="replace")
            found = re.search(rf"^(?:\x1b\S*?)?({re.escape(answer)}[^\r\n]*)\r?\n", text, re.M)
            if found:
                return found[1]
        raise AssertionError(f"no line {answer!r} in {text!r}")

    def completed(self, keys):
        for word in re.findall(r"[^\t]*\t|[^\t]+$", keys):
            self.type(word)
            time.sleep(0.05)
        return self.enter("\x01echo @", "@boxstream").removeprefix("@").rstrip()

    def close(self):
        os.close(self.terminal)
        os.waitpid(self.process, 0)


class Completion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "boxstream").symlink_to(TOOL)
        (self.folder / "box-file.txt").touch()
        (self.folder / "box-folder").mkdir()

    def drive(self, name):
        if shutil.which(name) is None:
            self.skipTest(f"no {name}")
        shell = Shell(name, self.folder)
        self.addCleanup(shell.close)
        for typed, wanted in LINES:
            with self.subTest(typed=typed):
                # A slash at the end of a word goes in zsh when a blank follows.
                self.assertEqual(shell.completed(typed).replace("/ ", " "), wanted.replace("/ ", " "))

    def test_bash(self):
        self.drive("bash")

    def test_zsh(self):
        self.drive("zsh")

    def test_fish(self):
        """Asks the completion of fish itself, which has a command for that."""
        if shutil.which("fish") is None:
            self.skipTest("no fish")
        for typed, wanted in LINES:
            before, begun = typed.split("\t")[0], wanted.split()
            with self.subTest(typed=before):
                script = f"boxstream completion fish | source; complete -C '{before}'"
                run = subprocess.run(["fish", "--no-config", "-c", script], cwd=self.folder, capture_output=True, text=True,
                                     check=False, env={**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"})
                place = len(before.split()) - 1
                offered = [line.split("\t")[0] for line in run.stdout.splitlines()]
                self.assertTrue(any(begun[place].startswith(word) for word in offered), offered)


class Colours(unittest.TestCase):
    """Of help and errors: on a terminal, and there only if its user does not mind."""

    def on_terminal(self, *words, **environment):
        process, terminal = pty.fork()
        if process == 0:
            os.execve(TOOL, [TOOL, *words], {"TERM": "xterm", **environment})
        text = b""
        try:
            while part := os.read(terminal, 65536):
                text += part
        except OSError:  # the end
            pass
        os.close(terminal)
        os.waitpid(process, 0)
        return text.decode()

    def test_headings_and_errors(self):
        self.assertIn("\x1b[1mOptions:\x1b[0m", self.on_terminal("simulate", "--help"))
        self.assertIn("\x1b[1;31mboxstream:\x1b[0m unknown command", self.on_terminal("simulat"))

    def test_none_where_they_are_unwanted(self):
        for environment in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            for words in (("simulate", "--help"), ("simulat",), ("list",)):
                self.assertNotIn("\x1b", self.on_terminal(*words, **environment))


if __name__ == "__main__":
    unittest.main()
