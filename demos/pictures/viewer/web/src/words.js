// SPDX-License-Identifier: MIT

// Numbers as people read them.

export const whole = (value) => Math.round(value).toLocaleString("en");

/** Three digits, and never an exponent. */
export function figure(value) {
  if (value === 0 || !Number.isFinite(value)) return String(value);
  const digits = Math.max(0, Math.min(8, 2 - Math.floor(Math.log10(Math.abs(value)))));
  return digits > 0 ? String(Number(value.toFixed(digits))) : whole(value);
}

/** Of `value`, the first scale that it reaches: [[1000, "s"], [1, "ms"]]. */
function scaled(value, scales) {
  const [size, unit] = scales.find(([least]) => Math.abs(value) >= least) ?? scales.at(-1);
  return `${figure(value / size)}\u00a0${unit}`;
}

export const duration = (ms) => (ms === 0 ? "0\u00a0ms" : scaled(ms, [[1000, "s"], [1, "ms"], [1e-3, "\u00b5s"]]));
export const distance = (metres) => (metres === 0 ? "0\u00a0m" : scaled(metres, [[1000, "km"], [1, "m"], [0.01, "cm"], [0.001, "mm"], [1e-6, "\u00b5m"]]));
export const vector = (values) => values.map((value) => value.toFixed(2)).join(", ");

/** What a picture of many bodies leaves out. */
export function leftOut({ overlays, selected, worlds }) {
  const isCrowded = (overlays.boxes || overlays.pairs || overlays.contacts) && !worlds[0].focus.isAll;
  if (!isCrowded) return "";
  return selected >= 0 ? "Of the selected body and its pairs." : "Of the nearest bodies only. Select one, or come nearer.";
}

/** How far two worlds have come apart. */
export function differences([a, b]) {
  const ways = a.movers.map((object) => a.apart[object]).filter((way) => Number.isFinite(way)).sort((x, y) => x - y);
  if (ways.length === 0) return "";
  const apart = `Apart: median ${distance(ways[ways.length >> 1])}, at most ${distance(ways.at(-1))}.`;
  return `${apart} Pairs only in ${a.run.label}: ${whole(a.pairsWithout(b))}, only in ${b.run.label}: ${whole(b.pairsWithout(a))}.`;
}
