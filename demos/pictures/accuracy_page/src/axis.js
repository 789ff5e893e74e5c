// SPDX-License-Identifier: MIT
// Axes with ticks where people look for them. A logarithmic axis also has a place for zero, below all else.
import { unique } from "./data.js";
import { figure } from "./words.js";

const powers = (low, high) => Array.from({ length: Math.max(0, high - low + 1) }, (_, i) => low + i);

/** Ticks of a logarithmic axis: digits between where there are few powers of ten, else some of these. A place for zero takes room. */
function logTicks(least, most, hasZero) {
  const [low, high] = [Math.floor(Math.log10(least)), Math.ceil(Math.log10(most))];
  const step = Math.ceil((high - low) / 6);
  const digits = most < 5 * least && !hasZero ? [1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9] : [1, 2, 5];
  return high - low <= 2 ? powers(low, high).flatMap((n) => digits.map((d) => d * 10 ** n)) : powers(low, high).filter((n) => (n - low) % step === 0).map((n) => 10 ** n);
}

/**
 * `values` are all that it is to show; `ticks`: only these, such as the values of a knob. {place, label, option}: where a
 * value is on ECharts' axis, and that axis.
 */
export function axisOf(values, { name = "", log = false, ticks = null, integer = false } = {}) {
  const known = values.filter((value) => value !== null && Number.isFinite(value));
  const positive = known.filter((value) => value > 0);
  const isLog = log && positive.length > 0 && known.every((value) => value >= 0);
  const base = { type: "value", name, nameLocation: "middle", nameGap: 26, scale: true, axisLabel: { hideOverlap: true }, axisLine: { show: true, onZero: false }, minInterval: integer ? 1 : undefined };
  if (!isLog) {
    const custom = ticks && ticks.length <= 8 ? { customValues: ticks } : {};
    return {
      log: false,
      place: (value) => value,
      option: { ...base, axisTick: custom, splitLine: custom, axisLabel: { ...base.axisLabel, ...custom, formatter: (value) => figure(value) } },
    };
  }
  const [least, most] = [Math.min(...positive), Math.max(...positive)];
  const zero = positive.length < known.length ? Math.floor(Math.log10(least)) - 1 : null;
  const shown = (ticks && ticks.length <= 10 ? ticks : logTicks(least, most, zero !== null)).filter((value) => value > 0).map(Math.log10);
  const margin = Math.max(0.05, 0.05 * Math.log10(most / least));
  const [min, max] = [zero ?? Math.log10(least) - margin, Math.log10(most) + margin];
  const inside = shown.filter((at) => at >= min && at <= max);
  // One tick tells no scale: where values are so near each other, the ends stand for it.
  const enough = inside.length + (zero === null ? 0 : 1) > 1 ? inside : unique([least, most].map((value) => Math.log10(Number(value.toPrecision(3)))));
  const places = [...(zero === null ? [] : [zero]), ...enough];
  const custom = { customValues: places };
  const label = (at) => (zero !== null && at <= zero + 1e-9 ? "0" : figure(Number((10 ** at).toPrecision(6))));
  return {
    log: true,
    place: (value) => (value === null ? null : value === 0 ? zero : Math.log10(value)),
    option: { ...base, min, max, axisTick: custom, splitLine: custom, axisLabel: { ...base.axisLabel, ...custom, formatter: label } },
  };
}

/** An axis of names, which break into lines where they are long. */
export function namesAxis(names, width, rotate = 0) {
  return { type: "category", data: names, axisTick: { show: false }, axisLine: { show: true, onZero: false }, splitLine: { show: false }, axisLabel: { interval: 0, width, overflow: "break", lineHeight: 12, rotate } };
}

/** How many lines the longest of the names takes at a width in pixels. */
export const linesOf = (names, width) => Math.max(1, ...names.map((name) => Math.ceil((1.25 * 6 * name.length) / width)));
