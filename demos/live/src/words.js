// SPDX-License-Identifier: MIT

export const count = (value) => value.toLocaleString("en");

/** Three figures at most: 0.42 ms, 8.31 ms, 12.4 ms, 1.35 s. */
export function duration(ms) {
  if (ms === undefined || ms === null) return "\u2013";
  if (ms >= 1000) return `${(ms / 1000).toPrecision(3)} s`;
  return `${ms >= 100 ? Math.round(ms) : ms >= 10 ? ms.toFixed(1) : ms.toFixed(2)} ms`;
}

/** Two figures or more, if it is above 0.1. */
export const figure = (value) => (value >= 10 ? count(Math.round(value)) : value.toFixed(value < 1 ? 2 : 1));

export function median(values) {
  const sorted = Float64Array.from(values).sort();
  return sorted.length > 0 ? sorted[sorted.length >> 1] : undefined;
}
