# SPDX-License-Identifier: MIT
"""The keys of the experiment files that speak to the page."""
import json
import unittest

from tables import REPORT

KEYS = {"title", "kind", "measure", "smoke", "question", "source", "plots", "advice", "expect", "constant", "knob", "failed",
        "ratios"}
PLOT_KEYS = {"kind", "y", "x", "log", "title", "better", "x_label", "y_label", "panel", "neutral"}
ADVICE_KEYS = {"panel", "series", "settings", "bounds", "default", "for", "over", "price", "note"}
EXPECT_KEYS = {"text", "metric", "where", "op", "value", "means", "kept", "without", "limit"}
FAILED_KEYS = {"panel", "series", "setting", "metric", "above", "why"}
RATIO_KEYS = {"name", "metric", "panel", "beside"}
CONSTANT_KEYS = {"metric", "panel", "series", "alike", "why"}
PLOTS = {"front", "lines", "bars", "heat", "curves"}
OPERATORS = {"==", "!=", "<", "<=", ">", ">="}


class Files(unittest.TestCase):
    def setUp(self):
        files = sorted((REPORT / "experiments").glob("*.json"))
        self.assertTrue(files)
        self.documents = {file.name: json.loads(file.read_text()) for file in files}

    def test_have_known_keys_only(self):
        for name, document in self.documents.items():
            with self.subTest(file=name):
                self.assertLessEqual(set(document), KEYS)
                for part, keys in (("plots", PLOT_KEYS), ("advice", ADVICE_KEYS), ("expect", EXPECT_KEYS),
                                   ("constant", CONSTANT_KEYS), ("failed", FAILED_KEYS), ("ratios", RATIO_KEYS)):
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
                    self.assertIn(spec["kind"], PLOTS)
                    self.assertLessEqual(set(spec.get("log", "")), set("xy"))
                for entry in document.get("expect", []):
                    self.assertIn(entry["op"], OPERATORS)
                    self.assertLessEqual(set(entry.get("where", {})), {"panel", "series", "setting"})
                    for said in {"means", "kept", "without"} & {"means", *entry}:
                        self.assertRegex(entry[said], r"^[^\n]*[.]$")
                for entry in document.get("advice", []):
                    self.assertTrue(entry["bounds"])
                    for bound in entry["bounds"]:
                        self.assertIn(set(bound) - {"panel"}, [{"metric", "at_most"}, {"metric", "at_least"}])
                    self.assertLessEqual(set(entry.get("default", {})), {"series", "setting", "called"})
                    if entry.get("price"):  # of one candidate; else it would be a choice
                        self.assertIsInstance(entry.get("series"), str)


if __name__ == "__main__":
    unittest.main()
