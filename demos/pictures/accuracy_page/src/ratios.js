// SPDX-License-Identifier: MIT
// What a table does not say by itself: runs that count as failed, and errors beside those of other settings for the same time.
import { matches, matching } from "./matching.js";

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
