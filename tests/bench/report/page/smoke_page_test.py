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
                                    f"--prices={REPORT.parents[1] / 'demos' / 'simulation' / 'effects' / 'prices.json'}",
                                    f"--out={TABLES / 'index.html'}"])
        cls.page = (TABLES / "index.html").read_text()

    def test_was_made_of_a_table_of_each(self):
        self.assertTrue(self.experiments)
        self.assertEqual([experiment.id for experiment in self.experiments if experiment.table is None], [])
        self.assertEqual(self.code, 0)
        self.assertTrue("Smoke run" in self.page)
        self.assertEqual([address for address in re.findall(r'(?:href|src)="([^"]*)"', self.page)
                          if not re.match("#|data:", address)], [])

    def test_has_every_experiment_and_every_plot(self):
        for experiment in self.experiments:
            with self.subTest(experiment=experiment.id):
                section = self.page.partition(f'<section id="{experiment.id}"')[2].partition("</section>")[0]
                self.assertTrue(section)
                drawn = re.findall(r'<figure id="([^"]*)">.*?<svg', section, re.S)
                specs = plots.specs(experiment)
                self.assertEqual(drawn, [f"{experiment.id}-{i}-{spec['kind']}" for i, spec in enumerate(specs, 1)])
                self.assertTrue(f"./dev report {experiment.id}" in section)

    def test_metrics_that_files_name_are_measured(self):
        for experiment in self.experiments:
            metrics = {"cost", *experiment.table.metrics}
            named = [metric for spec in experiment.plots for metric in plots.metrics_in(spec) if spec["kind"] != "curves"]
            named += [entry["metric"] for entry in [*experiment.advice, *experiment.expect]]
            with self.subTest(experiment=experiment.id):
                self.assertLessEqual(set(named), metrics)

    def test_points_are_told_apart_and_have_a_cost_or_a_failure(self):
        for experiment in self.experiments:
            keys = [point.key for point in experiment.table.points]
            with self.subTest(experiment=experiment.id):
                self.assertTrue(keys)
                self.assertEqual(len(keys), len(set(keys)))
                self.assertEqual([p.key for p in experiment.table.points if not p.failure and not p.cost >= 0], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
