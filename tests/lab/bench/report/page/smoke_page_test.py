# SPDX-License-Identifier: MIT
"""smoke_page_test.py TEMPLATE TABLES: the page of a smoke run of every experiment, TABLES/index.html, has all of them."""
import pathlib
import sys
import unittest

from tables import REPORT, data_of

import page as page_maker
from data import read_experiments

TEMPLATE, TABLES = map(pathlib.Path, sys.argv[1:3])


class SmokePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.experiments = read_experiments(REPORT / "experiments", [TABLES])
        prices = REPORT.parents[1] / "demos" / "simulation" / "effects" / "prices.json"
        cls.code = page_maker.main([f"--template={TEMPLATE}", f"--experiments={REPORT / 'experiments'}",
                                    f"--fresh={TABLES}", "--stored=", f"--prices={prices}", "--closed-forms=", "--witnesses=", f"--out={TABLES / 'index.html'}"])
        cls.data = data_of((TABLES / "index.html").read_text())

    def test_was_made_of_a_table_of_each(self):
        self.assertTrue(self.experiments)
        self.assertEqual([experiment.id for experiment in self.experiments if experiment.table is None], [])
        self.assertEqual(self.code, 0)
        self.assertEqual([made["id"] for made in self.data["experiments"]], [e.id for e in self.experiments])

    def test_metrics_that_files_name_are_measured(self):
        for experiment in self.experiments:
            document = experiment.document
            metrics = {"cost", *experiment.table.metrics, *(ratio["name"] for ratio in document.get("ratios", []))}
            named = [metric for spec in document.get("plots", []) if spec["kind"] != "curves"
                     for metric in ([spec["y"]] if isinstance(spec.get("y"), str) else spec.get("y", []))]
            named += [bound["metric"] for entry in document.get("advice", []) for bound in entry["bounds"]]
            named += [entry["metric"] for part in ("expect", "failed", "ratios") for entry in document.get(part, [])]
            for entry in document.get("constant", []):
                metrics_of_entry = entry.get("metric", [])  # one or a list; none where series are alike
                named += [metrics_of_entry] if isinstance(metrics_of_entry, str) else metrics_of_entry
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
