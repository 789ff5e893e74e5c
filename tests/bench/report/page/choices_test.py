# SPDX-License-Identifier: MIT
"""Fronts, hypervolumes, advice and verdicts of known data."""
import math
import pathlib
import tempfile
import unittest

import tables

import advice
import expectations
import front
from data import Experiment, read_table
from summary import cost_text, gain_text


def experiment(rows, **keys):
    """With a table of these rows."""
    with tempfile.TemporaryDirectory() as directory:
        table = read_table(tables.write_table(directory, rows, metrics=keys.pop("metrics", ("error_m",))))
    return Experiment(pathlib.Path("E1.json"), "E1", {"title": "A title", **keys}, table)


KNOB = [tables.row("wall", "iterations", n, cost, [error]) for n, cost, error in
        [(1, 1.0, 0.9), (2, 2.0, 0.5), (4, 3.0, 0.6), (8, 4.0, 0.1), (16, 8.0, 0.1)]]
DEFAULT = {"series": "iterations", "setting": 8}


class Front(unittest.TestCase):
    def settings(self, rows, better="low"):
        return [point.setting for point in front.front(experiment(rows).table.points, "error_m", better)]

    def test_has_what_no_other_beats(self):
        self.assertEqual(self.settings(KNOB), ["1", "2", "8"])

    def test_turns_round_where_more_is_better(self):
        self.assertEqual(self.settings(KNOB, "high"), ["1"])

    def test_has_no_failures_and_nothing_without_a_value(self):
        rows = [tables.row("wall", "s", 1, 0.1, [0.0], "exploded"), tables.row("wall", "s", 2, 0.2, [""]), *KNOB]
        self.assertEqual(self.settings(rows), ["1", "2", "8"])


class Hypervolume(unittest.TestCase):
    def volumes(self, rows):
        return front.hypervolumes(experiment(rows).table.points, "error_m")

    def test_is_the_part_of_the_plane_that_is_reached(self):
        # On scales of logarithms: a at (0, 1/2) and (1/2, 0), b at (1, 1) and (1/2, 1/2).
        rows = [tables.row("wall", "a", 1, 1, [10]), tables.row("wall", "a", 2, 10, [1]),
                tables.row("wall", "b", 1, 100, [100]), tables.row("wall", "b", 2, 10, [10])]
        found = self.volumes(rows)
        self.assertAlmostEqual(found["a"], 0.5 * 0.5 + 0.5 * 1)
        self.assertAlmostEqual(found["b"], 0.5 * 0.5)

    def test_of_what_failed_is_nothing(self):
        rows = [tables.row("wall", "a", 1, 1, [10]), tables.row("wall", "a", 2, 2, [5]),
                tables.row("wall", "b", 1, 1, [1], "exploded")]
        self.assertEqual(self.volumes(rows)["b"], 0)

    def test_ranks_share(self):
        self.assertEqual(front.ranks({"a": 0.5, "b": 0.9, "c": 0.5}), {"a": 2.5, "b": 1, "c": 2.5})

    def test_critical_difference(self):
        # Demsar 2006, section 3.2.2: four classifiers, fourteen data sets: 1.25.
        self.assertAlmostEqual(front.critical_difference(4, 14), 1.25, places=2)
        self.assertIsNone(front.critical_difference(4, 1))
        self.assertIsNone(front.critical_difference(11, 5))


class Advice(unittest.TestCase):
    def advise(self, rows, **entry):
        entry = {"panel": "*", "metric": "error_m", "good_enough": 0.55, "default": DEFAULT, "for": "walls", **entry}
        return advice.advise(experiment(rows, advice=[entry]), entry)

    def test_is_the_cheapest_within_the_limit(self):
        found = self.advise(KNOB)
        self.assertEqual((found.series, found.setting), ("iterations", "2"))
        self.assertAlmostEqual(found.ratio, 0.5)
        self.assertEqual((found.value, found.default_value), (0.5, 0.1))
        self.assertEqual(cost_text(found), "0.500 × the default")
        self.assertEqual(gain_text(found), "error 0.500 m (≤ 0.55 m asked; default 0.100 m)")

    def test_may_be_the_default(self):
        found = self.advise(KNOB, good_enough=0.1)
        self.assertTrue(found.is_default)
        self.assertIn("default", cost_text(found))

    def test_may_cost_more_than_the_default(self):
        found = self.advise(KNOB, default={"series": "iterations", "setting": 1})
        self.assertEqual(cost_text(found), "2 × the default")

    def test_says_when_times_are_not_told_apart(self):
        rows = [tables.row("wall", "iterations", n, cost, [error], spread=0.3) for n, cost, error in
                [(4, 3.0, 0.5), (8, 4.0, 0.1)]]
        self.assertIn("not significant", cost_text(self.advise(rows)))

    def test_says_when_nothing_is_good_enough_and_what_comes_nearest(self):
        found = self.advise(KNOB, good_enough=0.01)
        self.assertEqual(found.series, "")
        self.assertEqual(found.nearest, "iterations 8")
        self.assertEqual(found.nearest_value, 0.1)

    def test_takes_no_failure(self):
        rows = [tables.row("wall", "iterations", 1, 0.5, [0.01], "exploded"), *KNOB[1:]]
        self.assertEqual(self.advise(rows).setting, "2")

    def test_says_that_the_default_fails(self):
        rows = [*KNOB[:3], tables.row("wall", "iterations", 8, None, [""], "exploded")]
        found = self.advise(rows)
        self.assertEqual(found.default_fails, "exploded")
        self.assertIn("exploded", gain_text(found))
        self.assertTrue(math.isnan(found.ratio))

    def test_holds_on_all_scenes_together(self):
        rows = KNOB + [tables.row("pile", "iterations", n, cost, [error]) for n, cost, error in
                       [(2, 5.0, 0.7), (8, 20.0, 0.2), (16, 30.0, 0.1)]]
        found = self.advise(rows)
        self.assertEqual((found.setting, found.panels, found.value), ("8", 2, 0.2))
        self.assertEqual(self.advise(rows, panel="wall").setting, "2")

    def test_holds_for_all_settings_where_these_are_questions(self):
        rows = [tables.row("wall", series, n, cost, [error]) for series, n, cost, error in
                [("tree", 10, 1.0, 0), ("tree", 100, 4.0, 0), ("fast", 10, 0.1, 0), ("fast", 100, 0.2, 3),
                 ("good", 10, 0.5, 0), ("good", 100, 2.0, 0), ("partly", 10, 0.1, 0)]]
        found = self.advise(rows, over="setting", good_enough=0, default={"series": "tree"})
        self.assertEqual((found.choice, found.default), ("good", "tree"))
        self.assertAlmostEqual(found.ratio, 0.5)

    def test_skips_scenes_where_the_metric_does_not_apply(self):
        rows = KNOB + [tables.row("hill", "iterations", n, 1.0, [""]) for n in (1, 2, 8)]
        found = self.advise(rows)
        self.assertEqual((found.setting, found.panels), ("2", 1))

    def test_where_more_is_better(self):
        found = self.advise(KNOB, better="high", good_enough=0.55)
        self.assertEqual(found.setting, "1")
        self.assertIn("≥ 0.55 m asked", gain_text(found))

    def test_misses_nothing_silently(self):
        self.assertIn("no nix", self.advise(KNOB, metric="nix").missing)
        self.assertIn("no hill", self.advise(KNOB, panel="hill").missing)
        entry = {"metric": "error_m", "good_enough": 1}
        self.assertEqual(advice.advise(Experiment(pathlib.Path("E.json"), "E", {}), entry).missing, "not measured")


class Labels(unittest.TestCase):
    def label(self, series, setting, panel=None, **keys):
        return Experiment(pathlib.Path("E.json"), "E", keys).label(series, setting, panel)

    def test_say_what_a_number_is(self):
        self.assertEqual(self.label("FCL", "1e-6", measure={"knob": "tolerance"}), "FCL, tolerance 1e-6")
        knobs = {"gyro": ["on"], "substeps": [1, 2]}
        self.assertEqual(self.label("gyro=on", "2", measure={"knobs": knobs}), "gyro=on, substeps 2")
        self.assertEqual(self.label("gyro=on", "2", measure={"knobs": [{"name": "gyro"}, {"name": "dt"}]}), "gyro=on, dt 2")
        self.assertEqual(self.label("substeps", "2", measure={"knobs": {"substeps": [2]}}), "substeps 2")
        self.assertEqual(self.label("a", "2", knob="size"), "a, size 2")

    def test_know_the_knob_of_a_panel(self):
        panels = [{"scenes": ["scenes/balls.json"], "knobs": {"speed": [1]}}, {"name": "room", "knobs": {"dt": [1]}}]
        self.assertEqual(self.label("on", "1", "balls", measure={"panels": panels}), "on, speed 1")
        self.assertEqual(self.label("on", "1", "room", measure={"panels": panels}), "on, dt 1")
        self.assertEqual(self.label("on", "1", measure={"panels": panels}), "on 1")

    def test_leave_alone_what_says_it_itself(self):
        self.assertEqual(self.label("AVX2", "2 threads", knob="threads"), "AVX2, 2 threads")
        self.assertEqual(self.label("sphere", "sphere", knob="kind"), "sphere")
        self.assertEqual(self.label("sphere", "", knob="kind"), "sphere")


class Verdicts(unittest.TestCase):
    def judge(self, rows=KNOB, **entry):
        entry = {"text": "t", "metric": "error_m", "op": "<=", "value": 0.9, **entry}
        return expectations.judge(experiment(rows), entry)

    def test_kept(self):
        verdict = self.judge()
        self.assertEqual((verdict.state, verdict.points), ("kept", 5))

    def test_broken_says_by_what(self):
        verdict = self.judge(value=0.55)
        self.assertEqual(verdict.state, "broken")
        self.assertEqual(verdict.against, "wall iterations 1: 0.9 (and 1 more)")

    def test_looks_only_where_it_is_told(self):
        self.assertEqual(self.judge(value=0.1, where={"setting": 8}).state, "kept")
        self.assertEqual(self.judge(value=0.1, where={"series": "iterations", "setting": "2"}).state, "broken")

    def test_a_failure_breaks_it(self):
        verdict = self.judge([*KNOB, tables.row("wall", "iterations", 32, None, [0.0], "exploded")])
        self.assertEqual((verdict.state, verdict.against), ("broken", "wall iterations 32: exploded"))

    def test_what_was_not_measured_is_not_kept(self):
        self.assertEqual(self.judge(where={"series": "nobody"}).state, "not measured")
        self.assertEqual(self.judge([tables.row("wall", "a", 1, 1, [""])]).state, "not measured")


if __name__ == "__main__":
    unittest.main()
