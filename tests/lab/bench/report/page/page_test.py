# SPDX-License-Identifier: MIT
"""The page made of known tables: nothing is hidden, nothing comes from outside, the same data make the same page."""
import contextlib
import io
import json
import pathlib
import re
import tempfile
import unittest
import zipfile

import tables

from data import Folder

import page as page_maker

GOOD = [tables.row("wall", "iterations", n, cost, [error], instructions=1000 * n) for n, cost, error in
        [(1, 100.0, 0.9), (2, 200.0, 0.5), (4, 400.0, 0.0)]]
FAILED = tables.row("wall", "iterations", 8, 800.0, [""], "a coordinate is not finite")
TEMPLATE = '<script type="application/json" id="data">/*data*/</script>'


class Page(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.directory = pathlib.Path(self.holder.name)
        self.addCleanup(self.holder.cleanup)
        (self.directory / "template").write_text(TEMPLATE)

    def run_page(self):
        """Exit code, and what it says."""
        arguments = [f"--{name}={self.directory / name}" for name in ("template", "experiments", "fresh", "stored")]
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code = page_maker.main([*arguments, f"--out={self.directory / 'page.html'}", "--prices=", "--closed-forms=", "--witnesses="])
        return code, said.getvalue()

    def text(self):
        return (self.directory / "page.html").read_text()

    def make(self, rows=(), date="2026-01-02T03:04:05Z", twins=0.01, **keys):
        """The experiment on the page, of a fresh table of these rows, if there are any."""
        tables.write_experiment(self.directory, **keys)
        if rows:
            tables.write_table(self.directory / "fresh", rows, date=date, twins=twins)
            (self.directory / "fresh" / "E1.curves.csv").write_text(
                "# x: y\npanel,series,setting,at,value\nwall,iterations,1,0,1e-9\nwall,iterations,1,1,nan\n")
        self.assertEqual(self.run_page(), (0, ""))
        return tables.data_of(self.text())["experiments"][0]

    def test_has_all_of_a_table(self):
        made = self.make([*GOOD, FAILED])
        self.assertEqual(made["table"]["metrics"], ["error_m"])
        self.assertEqual(made["table"]["points"][1],
                         ["wall", "iterations", "2", 2, 200, 200 * (1 - 0.1), 200 * (1 + 0.1), 200, 2000, [0.5], ""])
        self.assertEqual(made["table"]["points"][3][9:], [[None], "a coordinate is not finite"])
        self.assertEqual(made["table"]["controls"], [["wall", 0.01]])
        self.assertEqual(made["table"]["facts"]["commit"], "abc123")
        self.assertEqual(made["curves"], [["wall", "iterations", "1", [0, 1], [1e-9, None]]])

    def test_has_what_the_experiment_says(self):
        advice = [{"panel": "*", "bounds": [{"metric": "error_m", "at_most": 0.6}], "for": "walls"}]
        made = self.make(GOOD, advice=advice, measure={"knob": "iterations"})
        self.assertEqual((made["title"], made["advice"]), ("A title", advice))
        self.assertEqual(made["knobs"], {"": "iterations", "wall": "iterations"})

    def test_knows_the_knob_of_a_panel(self):
        panels = [{"scenes": ["scenes/wall.json"], "knobs": {"speed": [1]}}, {"name": "room", "knobs": [{"name": "dt"}]}]
        made = self.make(GOOD, measure={"panels": panels})
        self.assertEqual(made["knobs"], {"": "", "wall": "speed"})

    def test_comes_from_nowhere_else_and_is_the_same_for_the_same_data(self):
        self.make(GOOD)
        first = self.text()
        self.assertEqual(re.findall(r"https?:", first.replace("application/json", "")), [])
        self.make(GOOD)
        self.assertTrue(self.text() == first)

    def test_text_of_files_cannot_end_the_data(self):
        made = self.make([tables.row("</script><wall>", "a&b", 1, 1.0, [0.5])])
        self.assertEqual(self.text().count("</script>"), 1)
        self.assertEqual(made["table"]["points"][0][0], "</script><wall>")

    def test_says_what_was_not_measured(self):
        self.assertNotIn("table", self.make())

    def test_stored_tables_stand_in_until_there_is_a_newer_one(self):
        tables.write_table(self.directory / "stored", GOOD, date="2026-05-01T00:00:00Z")
        self.assertFalse(self.make()["fresh"])
        made = self.make(GOOD[:2], date="2026-06-01T00:00:00Z")
        self.assertTrue(made["fresh"])
        self.assertEqual(len(made["table"]["points"]), 2)
        self.assertFalse(self.make(GOOD[:2], date="2026-04-01T00:00:00Z")["fresh"])

    def test_tables_of_a_file_are_those_of_a_directory(self):
        tables.write_table(self.directory / "kept", GOOD, date="2026-05-01T00:00:00Z")
        tables.write_table(self.directory / "kept" / "counts", GOOD[:1])
        tables.write_table(self.directory / "newer", GOOD[:2], date="2026-06-01T00:00:00Z")
        for directory in ("kept", "newer"):
            Folder(self.directory / "stored").pack(self.directory / directory)
        made = self.make()
        self.assertEqual(len(made["table"]["points"]), 2)
        self.assertEqual(made["counts"]["points"], [["wall", "iterations", "1", 1000]])

    def test_counts_of_small_sizes_are_apart(self):
        counts = [tables.row("wall", "iterations", 2, 1.0, [0.5], instructions=123456)]
        tables.write_table(self.directory / "fresh" / "counts", counts)
        made = self.make([tables.row("wall", "iterations", 2, 200.0, [0.5])])
        self.assertEqual(made["counts"]["points"], [["wall", "iterations", "2", 123456]])
        self.assertIsNone(made["table"]["points"][0][8])

    def test_bad_tables_are_refused_in_one_line(self):
        self.make(GOOD)
        before = self.text()
        for text in ("no table\n", tables.table_text(["wall,a"]), tables.table_text([GOOD[0].replace("0.9", "x")])):
            (self.directory / "fresh" / "E1.csv").write_text(text)
            code, said = self.run_page()
            self.assertEqual(code, 2)
            self.assertRegex(said, r"^[^\n]*E1\.csv: [^\n]*\n$")
        self.assertTrue(self.text() == before)

    def test_thumbnails_are_small(self):
        with zipfile.ZipFile(tables.REPORT / "page" / "thumbnails.zip") as archive:
            pictures = archive.infolist()
        self.assertTrue(pictures)
        self.assertEqual([picture.filename for picture in pictures if picture.file_size > 15_000], [])


if __name__ == "__main__":
    unittest.main()
