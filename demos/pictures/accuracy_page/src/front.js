// SPDX-License-Identifier: MIT
// Pareto-optimal settings, and the hypervolume of a series.
import { isGood, unique, valueOf } from "./data.js";

const errors = { low: (value) => value, high: (value) => -value, zero: Math.abs };

/** Smaller is better, whether that is "low", "high" or near "zero". */
export const errorOf = (point, metric, better = "low") => errors[better](valueOf(point, metric));

/** The Pareto-optimal points, by increasing cost. */
export function front(points, metric, better = "low") {
  const error = (point) => errorOf(point, metric, better);
  let least = Infinity;
  return points
    .filter((point) => isGood(point, metric))
    .sort((a, b) => a.cost - b.cost || error(a) - error(b))
    .filter((point) => error(point) < least && ((least = error(point)), true));
}

/** Maps values to 0..1: by their logarithms, where zero is a tenth of the least that is not. Null if all are equal. */
function scaleOf(values) {
  const positive = values.filter((value) => value > 0);
  const linear = positive.length === 0 || values.some((value) => value < 0);
  const floor = positive.length < values.length ? Math.min(...positive) / 10 : Math.min(...positive);
  const place = linear ? (value) => value : (value) => Math.log10(Math.max(value, floor));
  const low = place(Math.min(...values));
  const high = place(Math.max(...values));
  return high === low ? null : (value) => (place(value) - low) / (high - low);
}

/**
 * Series -> the part of the plane of cost and error, both scaled to what was measured, that it reaches; 1 is all. A
 * series that failed everywhere reaches nothing.
 */
export function hypervolumes(points, metric, better = "low") {
  const volumes = new Map(unique(points.map((point) => point.series)).map((name) => [name, 0]));
  const usable = points.filter((point) => isGood(point, metric));
  if (usable.length === 0) return volumes;
  const x = scaleOf(usable.map((point) => point.cost)) ?? (() => 0.5);
  const y = scaleOf(usable.map((point) => errorOf(point, metric, better))) ?? (() => 0.5);
  for (const name of volumes.keys()) {
    const best = front(usable.filter((point) => point.series === name), metric, better);
    const places = best.map((point) => [x(point.cost), y(errorOf(point, metric, better))]);
    volumes.set(name, places.reduce((sum, [at, error], i) => sum + ((places[i + 1]?.[0] ?? 1) - at) * (1 - error), 0));
  }
  return volumes;
}

/** Name -> rank, 1 is the largest; equal ones share the mean. */
export function ranks(volumes) {
  const order = [...volumes.values()].sort((a, b) => b - a);
  return new Map([...volumes].map(([name, value]) => [name, order.indexOf(value) + (order.filter((one) => one === value).length + 1) / 2]));
}

// Studentised range divided by the square root of two, for 5 %: Demsar, "Statistical comparisons of classifiers", 2006.
const nemenyi = { 2: 1.96, 3: 2.343, 4: 2.569, 5: 2.728, 6: 2.85, 7: 2.949, 8: 3.031, 9: 3.102, 10: 3.164 };

/** Mean ranks that differ by less are not significantly different. Null where the table of that test ends. */
export function criticalDifference(series, panels) {
  return nemenyi[series] && panels > 1 ? nemenyi[series] * Math.sqrt((series * (series + 1)) / (6 * panels)) : null;
}
