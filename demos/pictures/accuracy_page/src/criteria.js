// SPDX-License-Identifier: MIT
import { valueOf } from "./data.js";

// Which points an entry of an experiment's file is about.

/** Of each key one name, a list, or "*" for all; without it all. */
export const matches = (point, where = {}) => Object.entries(where).every(([key, wanted]) => wanted === undefined || [wanted].flat().some((one) => String(one) === "*" || point[key] === String(one)));

export const matching = (points, where) => points.filter((point) => matches(point, where));

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
