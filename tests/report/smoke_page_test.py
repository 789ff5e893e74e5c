# SPDX-License-Identifier: MIT
"""smoke_page_test.py TABLES: the page of a smoke run of every experiment, TABLES/index.html, has all of them."""
import pathlib
import re
import sys
import unittest

from tables import REPORT

import page as page_maker
import plots
from data import read_experiments

TABLES = pathlib.Path(sys.argv[1])


class SmokePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.experiments = read_experiments(REPORT / "experiments", [TABLES])
        cls.code = page_maker.main([f"--experiments={REPORT / 'experiments'}", f"--fresh={TABLES}", "--stored=",
                                    f"--prices={REPORT.parent / 'demos' / 'effects' / 'prices.json'}",
                                    f"--out={TABLES / 'index.html'}"])
        cls.page = (TABLES / "index.html").read_text()

    def each(self):
        self.assertTrue(self.experiments)
        for experiment in self.experiments:
            with self.subTest(experiment=experiment.id):
                self.assertIsNotNone(experiment.table)
                yield experiment

    def test_was_made(self):
        self.assertEqual(self.code, 0)
        self.assertTrue("Smoke run" in self.page)
        self.assertEqual([address for address in re.findall(r'(?:href|src)="([^"]*)"', self.page)
                          if not re.match("#|data:", address)], [])

    def test_has_every_experiment_and_every_plot(self):
        for experiment in self.each():
            section = self.page.partition(f'<section id="{experiment.id}"')[2].partition("</section>")[0]
            self.assertTrue(section)
            drawn = re.findall(r'<figure id="([^"]*)">.*?<svg', section, re.S)
            wishes = plots.wishes(experiment)
            self.assertEqual(drawn, [f"{experiment.id}-{i}-{wish['kind']}" for i, wish in enumerate(wishes, 1)])
            self.assertTrue(f"./dev report {experiment.id}" in section)

    def test_entries_of_files_speak_of_what_is_measured(self):
        for experiment in self.each():
            table = experiment.table
            series, metrics = {p.series for p in table.points}, {"cost", *table.metrics}
            for wish in experiment.plots:
                self.assertLessEqual(set(plots.metrics_in(wish)), metrics)
            for entry in [*experiment.advice, *experiment.expect]:
                self.assertIn(entry["metric"], metrics)
                for named in (entry.get("where", entry).get("series"), entry.get("default", {}).get("series")):
                    self.assertIn(named, {None, "*", *series})

    def test_points_are_told_apart(self):
        for experiment in self.each():
            keys = [point.key for point in experiment.table.points]
            self.assertEqual(len(keys), len(set(keys)))

    def test_values_are_finite_or_said_to_fail(self):
        for experiment in self.each():
            for point in experiment.table.points:
                self.assertTrue(point.failure or point.cost >= 0, point.key)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
