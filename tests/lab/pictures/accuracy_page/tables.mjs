// SPDX-License-Identifier: MIT
// Small experiments for tests of the page.
import { experimentOf } from "../../../../demos/pictures/accuracy_page/src/data.js";

/** A row of a table; `cost` null: none. */
export function row(panel, series, setting, cost, values, { failure = "", spread = 0.001, instructions = null } = {}) {
  const numbers = cost === null ? [null, null, null, null] : [cost, cost * (1 - spread), cost * (1 + spread), cost];
  return [panel, series, String(setting), Number(setting), ...numbers, instructions, values, failure];
}

/** An experiment with a table of these rows. */
export function experiment(points, { metrics = ["error_m"], controls = [["", 0]], counts = [], ...keys } = {}) {
  return experimentOf({ id: "E1", title: "A title", ...keys, counts: { points: counts }, table: { facts: { cost: "ms per simulated second" }, controls, metrics, points } });
}
