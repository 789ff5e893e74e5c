# SPDX-License-Identifier: MIT
"""The page made of known tables: nothing is hidden, nothing comes from outside, the same data make the same page."""
import contextlib
import io
import pathlib
import re
import tempfile
import unittest
import urllib.parse
import xml.etree.ElementTree

import tables

import page as page_maker

GOOD = [tables.row("wall", "iterations", n, cost, [error], instructions=1000 * n) for n, cost, error in
        [(1, 100.0, 0.9), (2, 200.0, 0.5), (4, 400.0, 0.0)]]
FAILED = tables.row("wall", "iterations", 8, 800.0, [""], "a coordinate is not finite")
EVERY_PLOT = [{"kind": "front", "y": "error_m", "log": "xy"}, {"kind": "lines", "y": "error_m", "log": "xy"},
              {"kind": "bars", "y": ["error_m"]}, {"kind": "heat", "y": "error_m"},
              {"kind": "heat", "y": "error_m", "x": "x"}, {"kind": "curves", "log": "y"}]
ADVICE = [{"panel": "*", "metric": "error_m", "good_enough": 0.6, "for": "walls",
           "default": {"series": "iterations", "setting": 4}}]


class Page(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.directory = pathlib.Path(self.holder.name)
        self.addCleanup(self.holder.cleanup)

    def run_page(self):
        """Exit code, and what it says."""
        arguments = [f"--{name}={self.directory / name}" for name in ("experiments", "fresh", "stored")]
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code = page_maker.main([*arguments, f"--out={self.directory / 'page.html'}",
                                    f"--prices={self.directory / 'prices.json'}"])
        return code, said.getvalue()

    def has(self, page, *texts):
        """Says which text is missing, and not the whole page."""
        self.assertEqual([text for text in texts if text not in page], [])

    def has_not(self, page, *texts):
        self.assertEqual([text for text in texts if text in page], [])

    def make(self, rows=None, **keys):
        table_keys = {key: keys.pop(key) for key in ("date", "twins", "metrics") if key in keys}
        tables.write_experiment(self.directory, **{"plots": EVERY_PLOT[:1], "advice": ADVICE, **keys})
        (self.directory / "prices.json").write_text(
            '{"effects": {"wind": {"ns_per_body_step": 12.5, "interval_ns": [11.5, 14]}}, "machine": "Some CPU"}')
        if rows is not None:
            tables.write_table(self.directory / "fresh", rows, **table_keys)
            (self.directory / "fresh" / "E1.curves.csv").write_text(
                "# x: y\npanel,series,setting,at,value\nwall,iterations,1,0,1e-9\nwall,iterations,1,1,1\n")
        self.assertEqual(self.run_page(), (0, ""))
        return (self.directory / "page.html").read_text()

    def svgs(self, page):
        return dict(re.findall(r'<figure id="([^"]*)">.*?(<svg.*?</svg>)', page, re.S))

    def test_draws_every_kind_of_plot(self):
        svgs = self.svgs(self.make(GOOD, plots=EVERY_PLOT))
        kinds = ["1-front", "2-lines", "3-bars", "4-heat", "5-heat", "6-curves"]
        self.assertEqual(list(svgs), [f"E1-{kind}" for kind in kinds] + ["prices-plot"])
        for name, svg in svgs.items():
            self.assertGreater(len(xml.etree.ElementTree.fromstring(svg).findall(".//*")), 20, name)

    def test_a_failure_is_a_cross_in_every_plot_and_said(self):
        page = self.make([*GOOD, FAILED], plots=EVERY_PLOT)
        svgs = self.svgs(page)
        for name in ("E1-1-front", "E1-2-lines", "E1-3-bars", "E1-4-heat", "E1-5-heat"):
            self.has(svgs[name], f'id="{name}-failed"')
        self.has(page, "a coordinate is not finite")
        self.has(page, "4 points, 1 of them failed")
        for name, svg in self.svgs(self.make(GOOD, plots=EVERY_PLOT)).items():
            self.assertFalse('-failed"' in svg, name)

    def test_a_panel_where_all_failed_is_still_there(self):
        rows = [*GOOD, tables.row("hill", "iterations", 1, None, [""], "exploded")]
        svg = self.svgs(self.make(rows))["E1-1-front"]
        self.has(svg, ">hill<", '-failed"')

    def test_comes_from_nowhere_else(self):
        page = self.make(GOOD, plots=EVERY_PLOT)
        for address in re.findall(r'(?:href|src)="([^"]*)"', page):
            self.assertRegex(address, r"^(#|data:)")
        self.assertEqual(re.findall(r"<script|@import|url\((?!#|%23).{20}", page), [])

    def test_is_the_same_for_the_same_data(self):
        self.assertTrue(self.make(GOOD, plots=EVERY_PLOT) == self.make(GOOD, plots=EVERY_PLOT))

    def test_names_in_pictures_are_unique(self):
        ids = re.findall(r'\bid="([^"]*)"', self.make(GOOD, plots=EVERY_PLOT))
        drawn = [id for id in ids if re.search(r"-(front|lines|bars|heat|curves)-(m|p)[0-9a-f]{6,}", id)]
        self.assertTrue(drawn)
        self.assertEqual(len(drawn), len(set(drawn)))

    def test_gives_away_tables_and_pictures(self):
        page = self.make(GOOD)
        saved = dict(re.findall(r'download="([^"]*)" href="data:[^,]*,([^"]*)"', page))
        text = (self.directory / "fresh" / "E1.csv").read_text()
        self.assertEqual(urllib.parse.unquote(saved["E1.csv"]), text)
        self.assertIn("E1.curves.csv", saved)
        xml.etree.ElementTree.fromstring(urllib.parse.unquote(saved["E1-1-front.svg"].replace("&#x27;", "'")))

    def test_advice_is_computed(self):
        page = self.make(GOOD)
        self.has(page, ">iterations 2</b>")
        self.has(page, "0.500 × the default")
        other = [tables.row("wall", "iterations", n, cost, [error]) for n, cost, error in
                 [(1, 300.0, 0.55), (2, 400.0, 0.5), (4, 400.0, 0.0)]]
        page = self.make(other)
        self.has(page, ">iterations 1</b>")
        self.has(page, "0.750 × the default")

    def test_broken_criteria_are_shown(self):
        expect = [{"text": "small", "metric": "error_m", "op": "<=", "value": 0.1},
                  {"text": "below one", "metric": "error_m", "op": "<", "value": 1}]
        page = self.make(GOOD, expect=expect)
        self.assertTrue(re.search(r'class="bad">broken</td><td>small</td><td>wall iterations 1: 0.9', page))
        self.assertTrue(re.search(r'class="good">kept</td><td>below one', page))
        self.has(page, "criteria: 1 kept")
        self.has(page, "1 broken")

    def test_the_first_screen_has_the_first_advice_of_each(self):
        many = [{**ADVICE[0], "for": f"kind {i}"} for i in range(60)]
        tables.write_experiment(self.directory, "E2", advice=[{**ADVICE[0], "for": "the other"}])
        page = self.make(GOOD, advice=many)
        summary, _, rest = page.partition("</section>")
        self.has(summary, "kind 0<", "the other<")
        self.assertEqual(summary.count("<tr>") - 1, 36)
        self.has(rest, "kind 59<")

    def test_warns_of_noise(self):
        self.has_not(self.make(GOOD, twins=0.03), "Times are noisy")
        page = self.make(GOOD, twins=0.0312)
        self.has(page, "Times are noisy")
        self.has(page, "3.1 %")
        self.has(page, "≈ A/A controls differ by more than 3 % in E1")

    def test_says_what_was_not_measured(self):
        page = self.make()
        self.has(page, "Not measured here yet")
        self.has(page, "0 of 1 experiments measured")

    def test_stored_tables_stand_in_until_there_is_a_newer_one(self):
        tables.write_table(self.directory / "stored", GOOD, date="2026-05-01T00:00:00Z")
        page = self.make()
        self.has(page, "stored figures")
        self.has(page, "2026-05-01")
        page = self.make(GOOD[:2], date="2026-06-01T00:00:00Z")
        self.has_not(page, "stored figures")
        self.has(page, "Numbers: 2 points")
        self.has(self.make(GOOD[:2], date="2026-04-01T00:00:00Z"), "stored figures")

    def test_counts_of_small_sizes_are_said_to_be_those(self):
        counts = [tables.row("wall", "iterations", 2, 1.0, [0.5], instructions=123456)]
        tables.write_table(self.directory / "fresh" / "counts", counts)
        plain = [tables.row("wall", "iterations", 2, 200.0, [0.5])]
        page = self.make(plain)
        self.has(page, "instructions (small sizes)")
        self.has(page, "123\u202f456")
        self.has_not(self.make(GOOD), "small sizes")

    def test_a_smoke_run_is_no_ground_for_decisions(self):
        self.has_not(self.make(GOOD), "Smoke run")
        file = self.directory / "fresh" / "E1.csv"
        file.write_text(file.read_text().replace("./dev report E1", "./dev report E1 --smoke"))
        self.assertEqual(self.run_page(), (0, ""))
        self.has((self.directory / "page.html").read_text(), "Smoke run: ")

    def test_a_plot_that_cannot_be_drawn_is_said(self):
        self.has(self.make(GOOD, plots=[{"kind": "front", "y": "beauty"}]), "the table has no beauty")

    def test_several_series_get_a_hypervolume_and_ranks(self):
        rows = GOOD + [tables.row("wall", "other", 1, 150.0, [0.8])]
        page = self.make(rows)
        self.has(page, "Hypervolume")
        self.assertTrue(re.search(r"<td>iterations</td><td class=\"n\">[\d.]+ \(1\)", page))

    def test_text_of_files_stays_text(self):
        page = self.make([tables.row("<wall>", "a&b", 1, 1.0, [0.5])], title="<i>")
        self.has_not(page, "<wall>")
        self.has_not(page, "<i>")
        self.has(page, "&lt;wall&gt;")

    def test_bad_tables_are_refused_in_one_line(self):
        self.make(GOOD)
        before = (self.directory / "page.html").read_text()
        for text in ("no table\n", tables.table_text(["wall,a"]), tables.table_text([GOOD[0].replace("0.9", "x")])):
            (self.directory / "fresh" / "E1.csv").write_text(text)
            code, said = self.run_page()
            self.assertEqual(code, 2)
            self.assertRegex(said, r"^[^\n]*E1\.csv: [^\n]*\n$")
        self.assertTrue((self.directory / "page.html").read_text() == before)


if __name__ == "__main__":
    unittest.main()
