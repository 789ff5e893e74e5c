// SPDX-License-Identifier: MIT
import { inks, tint } from "./colours.js";
import { unique, valueOf } from "./data.js";
import { figure } from "./words.js";

// Axes with ticks where people look for them. A logarithmic axis also has a place for zero, below all else.

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

// Markers as legends show them: the shape that the plot draws, on a piece of its line.

const paths = {
  circle: '<circle cx="13" cy="6" r="4"/>',
  rect: '<rect x="9.5" y="2.5" width="7" height="7"/>',
  roundRect: '<rect x="9" y="2" width="8" height="8" rx="2.5"/>',
  triangle: '<path d="M13 1.5L17.5 10H8.5Z"/>',
  diamond: '<path d="M13 .5L18 6L13 11.5L8 6Z"/>',
  pin: '<path d="M13 12C9 7 9 1 13 1S17 7 13 12Z"/>',
  none: "",
};

const dashes = { solid: "", dashed: "5 3", dotted: "2 2" };

/** An <svg> of 26 x 12 pixels, in the colour `--mark` of the element around it. */
export function swatch({ symbol = "none", dash = "solid", line = true, hollow = false }) {
  const holder = document.createElement("span");
  holder.className = "swatch";
  const stroke = line ? `<path d="M0 6H26" fill="none" stroke="currentColor" stroke-width="1.6" stroke-dasharray="${dashes[dash] ?? ""}"/>` : "";
  holder.innerHTML = `<svg width="26" height="12" viewBox="0 0 26 12" aria-hidden="true"><g fill="${hollow ? "none" : "currentColor"}" stroke="${hollow ? "currentColor" : "none"}" stroke-width="1.8">${stroke}${paths[symbol] ?? paths.circle}</g></svg>`;
  return holder;
}

// What plots have in common: intervals, crosses, words beside the pointer, and how axes stand.

/** [low, high] of a metric; nulls where it has no interval. */
export const intervalOf = (point, metric) => (metric === "cost" ? [point.cost_low, point.cost_high] : ["low", "high"].map((end) => valueOf(point, `${metric}.${end}`)));

/** Numbers of a point, a line each, for the box beside the pointer. */
export function hoverText(context, point, metrics) {
  const { experiment, names } = context;
  const lines = [`<b>${context.escape(names.candidate(experiment, point.series, point.setting, point.panel))}</b>`];
  if (point.failure) lines.push(context.escape(point.failure.startsWith("not sound") ? point.failure : `failed: ${point.failure}`));
  if (point.cost !== null) lines.push(`${figure(point.cost)} ${names.cost(experiment)} (95 %: ${figure(point.cost_low)} to ${figure(point.cost_high)})`);
  for (const metric of metrics)
    if (metric !== "cost" && valueOf(point, metric) !== null) {
      const [low, high] = intervalOf(point, metric);
      const interval = low !== null && high !== null ? ` (95 %: ${figure(low)} to ${figure(high)})` : "";
      lines.push(context.escape(`${names.metric(experiment, metric).name}: ${names.value(experiment, metric, valueOf(point, metric))}${interval}`));
    }
  return lines.join("<br>");
}

/** Around words, so that they can be read on lines and markers. */
export const halo = { textBorderColor: inks.paper, textBorderWidth: 3 };

export const cross = "path://M0 0L2 0L5 3.5L8 0L10 0L6 5L10 10L8 10L5 6.5L2 10L0 10L4 5Z";

/** Lines from `low` to `high` of each [at, low, high], along x or y. */
export function intervals(name, rows, along, style) {
  return {
    type: "custom",
    name,
    silent: true,
    z: 1,
    data: rows,
    encode: along === "x" ? { x: [1, 2], y: 0 } : { x: 0, y: [1, 2] },
    renderItem: (_, api) => {
      const ends = [1, 2].map((i) => api.coord(along === "x" ? [api.value(i), api.value(0)] : [api.value(0), api.value(i)]));
      return { type: "line", shape: { x1: ends[0][0], y1: ends[0][1], x2: ends[1][0], y2: ends[1][1] }, style: { stroke: tint(style.color), lineWidth: 1.2, opacity: 0.6 } };
    },
  };
}

/** Text in lines of at most so many letters; numbers keep their units. */
export const inLines = (text, letters = 40) => text.split(/(?<!\d) | (?=\S{4})/).reduce((lines, word) => (lines.length > 0 && `${lines.at(-1)} ${word}`.length <= letters ? [...lines.slice(0, -1), `${lines.at(-1)} ${word}`] : [...lines, word]), []).join("\n");

/** The name of the upright axis stands above it, from the left. */
const upright = (axis) => ({ ...axis, name: inLines(axis.name ?? ""), nameLocation: "end", nameGap: 8, nameTextStyle: { align: "left", lineHeight: 13, padding: 0 } });

export const base = (x, y, series) => ({
  animation: false,
  grid: { left: 4, right: 16, top: 13 * inLines(y.name ?? "").split("\n").length + 13, bottom: x.name ? 24 : 4, outerBoundsMode: "same", outerBoundsContain: "axisLabel" },
  tooltip: { trigger: "item", confine: true, formatter: (item) => item.data?.hover ?? "" },
  legend: { show: false },
  dataZoom: [
    { type: "inside", xAxisIndex: 0, zoomOnMouseWheel: "shift", moveOnMouseWheel: false, filterMode: "none" },
    { type: "inside", yAxisIndex: 0, zoomOnMouseWheel: "shift", moveOnMouseWheel: false, filterMode: "none" },
  ],
  xAxis: x,
  yAxis: upright(y),
  series,
});
