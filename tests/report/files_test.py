# SPDX-License-Identifier: MIT
"""The keys of the experiment files that speak to the page."""
import json
import unittest

from tables import REPORT

import expectations
import plots
from markup import escape

KEYS = {"title", "kind", "measure", "smoke", "question", "source", "plots", "advice", "expect", "knob"}
PLOT_KEYS = {"kind", "y", "x", "log", "title", "better", "x_label", "y_label", "good"}
ADVICE_KEYS = {"panel", "series", "metric", "good_enough", "better", "default", "for", "over"}
EXPECT_KEYS = {"text", "metric", "where", "op", "value"}


class Files(unittest.TestCase):
    def each(self):
        files = sorted((REPORT / "experiments").glob("*.json"))
        self.assertTrue(files)
        for file in files:
            with self.subTest(file=file.name):
                yield json.loads(file.read_text())

    def test_have_known_keys_only(self):
        for document in self.each():
            self.assertLessEqual(set(document), KEYS)
            for name, keys in (("plots", PLOT_KEYS), ("advice", ADVICE_KEYS), ("expect", EXPECT_KEYS)):
                for entry in document.get(name, []):
                    self.assertLessEqual(set(entry), keys)

    def test_say_what_is_asked_and_where_it_comes_from(self):
        for document in self.each():
            for key in ("title", "question", "source"):
                self.assertTrue(document.get(key), key)
                self.assertEqual(escape(document[key]).count("\n"), 0)

    def test_have_plots_and_something_to_decide(self):
        for document in self.each():
            self.assertTrue(document.get("plots"))
            self.assertTrue(document.get("advice") or document.get("expect"))
            for wish in document["plots"]:
                self.assertIn(wish["kind"], plots.KINDS)
                self.assertLessEqual(set(wish.get("log", "")), set("xy"))
            for entry in document.get("expect", []):
                self.assertIn(entry["op"], expectations.OPERATORS)
                self.assertLessEqual(set(entry.get("where", {})), {"panel", "series", "setting"})
            for entry in document.get("advice", []):
                self.assertIsInstance(entry["good_enough"], (int, float))


if __name__ == "__main__":
    unittest.main()
