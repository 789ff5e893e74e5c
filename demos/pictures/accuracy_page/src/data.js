// SPDX-License-Identifier: MIT
// Experiments and their tables, as the page's JSON has them.
import { complete } from "./ratios.js";

/** Numbers of a point that every table has, in the order of its row. */
const fixed = ["panel", "series", "setting", "x", "cost", "cost_low", "cost_high", "cost_min", "instructions"];

function pointOf(row, number, metrics) {
  const point = { number };
  fixed.forEach((name, i) => (point[name] = row[i]));
  const values = row[fixed.length];
  point.values = Object.fromEntries(metrics.map((metric, i) => [metric, values[i]]));
  point.failure = row[fixed.length + 1] ?? "";
  return point;
}

/** The value of a metric, "cost" among them; null where it does not apply. */
export const valueOf = (point, metric) => (metric === "cost" ? point.cost : point.values[metric] ?? null);

export const keyOf = (point) => JSON.stringify([point.panel, point.series, point.setting]);

export const unique = (values) => [...new Set(values)];

/** An experiment of the page's JSON with its points spread out; `table` is null where nothing was measured. */
export function experimentOf(raw) {
  const experiment = { plots: [], advice: [], findings: [], take: null, expect: [], constant: [], curves: [], title: "", question: "", source: "", knobs: {}, ...raw };
  if (!raw.table) return { ...experiment, table: null };
  const points = raw.table.points.map((row, i) => pointOf(row, i, raw.table.metrics));
  const metrics = complete(points, raw.table.metrics, raw);
  const counts = new Map((raw.counts?.points ?? []).map(([panel, series, setting, count]) => [keyOf({ panel, series, setting }), count]));
  return {
    ...experiment,
    counts,
    table: { ...raw.table, metrics, points, panels: unique(points.map((point) => point.panel)), costUnit: raw.table.facts.cost ?? "" },
  };
}

export const isGood = (point, metric) => !point.failure && valueOf(point, metric) !== null && point.cost !== null;

export const limitOfTwins = 0.03;

/** Points whose interval reaches further than that to either side of their time. */
export const wide = (points) => points.filter(({ cost, cost_low, cost_high }) => cost && (cost_high - cost_low) / (2 * cost) > limitOfTwins);

/** Largest difference of two series of the same candidate on these panels; 0 where there is none. */
export function noise(experiment, panels = null) {
  const known = (experiment.table?.controls ?? []).filter(([panel, spread]) => spread !== null && (!panels || panels.includes(panel) || !panel));
  return Math.max(0, ...known.map(([, spread]) => spread));
}
