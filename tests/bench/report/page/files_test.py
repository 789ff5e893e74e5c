# SPDX-License-Identifier: MIT
"""The keys of the experiment files that speak to the page."""
import json
import unittest

from tables import REPORT

import expectations
import plots

KEYS = {"title", "kind", "measure", "smoke", "question", "source", "plots", "advice", "expect", "knob"}
PLOT_KEYS = {"kind", "y", "x", "log", "title", "better", "x_label", "y_label", "good"}
ADVICE_KEYS = {"panel", "series", "metric", "good_enough", "better", "default", "for", "over"}
EXPECT_KEYS = {"text", "metric", "where", "op", "value"}


class Files(unittest.TestCase):
    def setUp(self):
        files = sorted((REPORT / "experiments").glob("*.json"))
        self.assertTrue(files)
        self.documents = {file.name: json.loads(file.read_text()) for file in files}

    def test_have_known_keys_only(self):
        for name, document in self.documents.items():
            with self.subTest(file=name):
                self.assertLessEqual(set(document), KEYS)
                for part, keys in (("plots", PLOT_KEYS), ("advice", ADVICE_KEYS), ("expect", EXPECT_KEYS)):
                    for entry in document.get(part, []):
                        self.assertLessEqual(set(entry), keys)

    def test_say_what_is_asked_and_where_it_comes_from(self):
        for name, document in self.documents.items():
            for key in ("title", "question", "source"):
                with self.subTest(file=name, key=key):
                    self.assertTrue(document.get(key))
                    self.assertNotIn("\n", document.get(key, ""))

    def test_have_plots_and_criteria_that_the_page_understands(self):
        for name, document in self.documents.items():
            with self.subTest(file=name):
                self.assertTrue(document.get("plots"))
                for spec in document.get("plots", []):
                    self.assertIn(spec["kind"], plots.KINDS)
                    self.assertLessEqual(set(spec.get("log", "")), set("xy"))
                for entry in document.get("expect", []):
                    self.assertIn(entry["op"], expectations.OPERATORS)
                    self.assertLessEqual(set(entry.get("where", {})), {"panel", "series", "setting"})
                for entry in document.get("advice", []):
                    self.assertIsInstance(entry["good_enough"], (int, float))
                    self.assertLessEqual(set(entry.get("default", {})), {"series", "setting"})


if __name__ == "__main__":
    unittest.main()
