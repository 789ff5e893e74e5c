// SPDX-License-Identifier: MIT
// What plots have in common: intervals, crosses, words beside the pointer, and how axes stand.
import { inks, tint } from "./colours.js";
import { valueOf } from "./data.js";
import { figure } from "./words.js";

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
