# SPDX-License-Identifier: MIT
"""`./dev report --page-only` makes the page of the kept tables, and neither configures, compiles nor installs anything."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from tables import REPORT, data_of

SOURCE = REPORT.parents[1]


class PageOnly(unittest.TestCase):
    def test_makes_the_page_without_building(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("cmake", "ninja", "make", "apt-get", "g++", "clang++"):
                tool = pathlib.Path(folder) / name
                tool.write_text(f"#!/bin/sh\necho {name} was called >&2\nexit 1\n")
                tool.chmod(0o755)
            run = subprocess.run([SOURCE / "dev", "report", "--page-only"], cwd=SOURCE, capture_output=True, text=True,
                                 env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("was called", run.stderr)
        page = (SOURCE / "out" / "report" / "index.html").read_text()
        self.assertGreater(len(data_of(page)["experiments"]), 25)


if __name__ == "__main__":
    unittest.main()
