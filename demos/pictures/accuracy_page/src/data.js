// SPDX-License-Identifier: MIT
// Which points an entry of an experiment's file is about.

/** Of each key one name, a list, or "*" for all; without it all. */
export const matches = (point, where = {}) => Object.entries(where).every(([key, wanted]) => wanted === undefined || [wanted].flat().some((one) => String(one) === "*" || point[key] === String(one)));

export const matching = (points, where) => points.filter((point) => matches(point, where));

// What a table does not say by itself: runs that count as failed, and errors beside those of other settings for the same time.

/** The error of points at a cost, by a power law between the two next to it; null where none was measured on either side. */
export function errorAtCost(points, metric, cost) {
  const usable = points.filter((point) => !point.failure && point.cost > 0 && point.values[metric] > 0).sort((a, b) => a.cost - b.cost);
  const after = usable.find((point) => point.cost >= cost);
  const before = usable.filter((point) => point.cost <= cost).at(-1);
  if (!before || !after) return null;
  const share = after.cost > before.cost ? Math.log(cost / before.cost) / Math.log(after.cost / before.cost) : 0;
  return before.values[metric] * (after.values[metric] / before.values[metric]) ** share;
}

/** Marks runs as failed whose value shows that they are, though nothing exploded. */
function markFailed(points, { metric, above, why, ...where }) {
  for (const point of points) if (!point.failure && matches(point, where) && point.values[metric] > above) point.failure = why;
}

/** Gives points a metric more; `point.beyond` names those that have nothing to be compared with. */
function addRatio(points, { name, metric, panel, beside }) {
  for (const point of matching(points, { panel })) {
    const others = matching(points, { ...beside, panel: point.panel });
    const other = others.includes(point) ? null : errorAtCost(others, metric, point.cost);
    const value = point.values[metric] ?? null;
    point.values[name] = other === null || value === null ? null : value / other;
    if (other === null) point.beyond = [...(point.beyond ?? []), name];
  }
}

/** Completes the points of an experiment, and returns the names of metrics that these then have. */
export function complete(points, metrics, { failed = [], ratios = [] }) {
  for (const entry of failed) markFailed(points, entry);
  for (const entry of ratios) addRatio(points, entry);
  return [...new Set([...metrics, ...ratios.map(({ name }) => name)])];
}

// Experiments and their tables, as the page's JSON has them.

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

// Whether what an experiment expects came out.

const operators = {
  "==": (a, b) => a === b,
  "!=": (a, b) => a !== b,
  "<=": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
};

/**
 * {text, means, limit, without, state: "kept" | "broken" | "not comparable" | "not measured", points, broken: [point]}. A failed
 * point breaks a criterion; one whose metric does not apply, or that has nothing to be compared with, does not count.
 */
export function judge(experiment, entry) {
  const asked = matching(experiment.table?.points ?? [], entry.where);
  const isBeyond = (point) => point.beyond?.includes(entry.metric) ?? false;
  const points = asked.filter((point) => !isBeyond(point) && (point.failure || valueOf(point, entry.metric) !== null));
  const broken = points.filter((point) => point.failure || !operators[entry.op](valueOf(point, entry.metric), entry.value));
  const state = points.length === 0 ? (asked.some(isBeyond) ? "not comparable" : "not measured") : broken.length > 0 ? "broken" : "kept";
  return { ...entry, text: entry.text ?? `${entry.metric} ${entry.op} ${entry.value}`, means: entry.means ?? "", limit: entry.limit ?? "", without: entry.without ?? "", state, points: points.length, broken };
}

export const verdicts = (experiment) => experiment.expect.map((entry) => judge(experiment, entry));
