# SPDX-License-Identifier: MIT
"""instructions_test.py VALGRIND BOXSTREAM_REPORT: instructions are counted for each point, and are its own."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from tables import REPORT

from data import Folder, read_table

VALGRIND, PROGRAM = sys.argv[1:3]
EXPERIMENT = """{"title": "T", "kind": "scene", "measure": {"scenes": ["demos/scenes/effects/gravity.json"],
  "steps": 20, "knobs": {"substeps": [1, 2, 4]}, "metrics": ["penetration"]}}"""


class Instructions(unittest.TestCase):
    def counts(self, directory):
        file, dump = directory / "E1.json", directory / "dump"
        file.write_text(EXPERIMENT)
        subprocess.run(
            [VALGRIND, "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={dump}", PROGRAM, str(file),
             "--repeats", "1", "--into", str(directory)],
            check=True, cwd=REPORT.parents[1], env={**os.environ, "BOXSTREAM_CALLGRIND": str(dump)}, capture_output=True)
        self.assertEqual([path.name for path in directory.glob("dump.*")], [])
        return [point.instructions for point in read_table(Folder(directory), "E1.csv").points]

    def test_grow_with_the_work(self):
        with tempfile.TemporaryDirectory() as directory:
            one, two, four = self.counts(pathlib.Path(directory))
        # Substeps are most of the work here, and each is like the other.
        self.assertGreater(one, 10_000)
        self.assertGreater(two, 1.2 * one)
        self.assertAlmostEqual((four - two) / (two - one), 2, delta=0.3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
