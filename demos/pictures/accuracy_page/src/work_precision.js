// SPDX-License-Identifier: MIT
// Work against precision of a scene: a line for each candidate, the reference's band, the bound, and what to take.
import { axisOf, base, cross, halo, hoverText, intervals } from "./plot_parts.js";
import { inks, tint } from "./colours.js";
import { unique } from "./data.js";
import { lineAt, mark } from "./precision.js";
import { figure, measured } from "./words.js";

/** What the tool says of each point: [error, low, high]. */
const errorsOf = (spec, point) => spec.errors[point.number] ?? [null, null, null];

/** The name of the upright axis. */
function axisName({ experiment, names }, spec) {
  const { name, unit } = names.metric(experiment, spec.y);
  return spec.off ? `how far off: ${name}${unit ? `, ${unit}` : ""}` : names.metricLabel(experiment, spec.y);
}

/** All below it is the same to the reference. */
const bandSeries = (x, y, band) => ({
  type: "custom",
  name: "band",
  silent: true,
  z: 0,
  data: [[x, y.place(band)]],
  renderItem: ({ coordSys }, api) => {
    const top = Math.max(coordSys.y, api.coord([api.value(0), api.value(1)])[1]);
    return { type: "rect", shape: { x: coordSys.x, y: top, width: coordSys.width, height: Math.max(0, coordSys.y + coordSys.height - top) }, style: { fill: tint(inks.right), opacity: 0.7 } };
  },
});

/** Where an error is on the upright axis: at its border, if it is beyond. */
function heightOf(y, error) {
  if (!y.log) return y.place(error);
  const at = error > 0 ? y.place(error) : y.option.min;
  return Math.min(Math.max(at, y.option.min), y.option.max);
}

const nameOf = ({ experiment, names }, key, panel) => names.series(experiment, key) || names.knob(experiment, panel).axis || key;

/** What is known of a whole line, by its name in the legend: how fast it comes nearer, and what it takes to keep the bound. */
export function linesWords(context, spec) {
  const { experiment, names } = context;
  const said = ({ order, cost_at_bound: cost }) => [order && `order ${figure(order, 2)}`, cost && `${figure(cost.median)} ms at the bound`].filter(Boolean).join(", ");
  return new Map((spec.lines ?? []).map((line) => [nameOf(context, line.name, experiment.table.points[0].panel), said(line)]));
}

/** Points of a candidate from cheap to dear, joined where they are sound. */
function candidateSeries(context, spec, key, x, y, own) {
  const { experiment, names } = context;
  const { color, symbol, dash } = context.style(key);
  const name = nameOf(context, key, own[0].panel);
  const hover = (point) => {
    const [error, low, high] = errorsOf(spec, point);
    const { unit } = names.metric(experiment, spec.y);
    const off = error === null || !spec.off ? "" : `<br>off by ${measured(error, unit)}${high > error ? ` (${measured(low, unit)} to ${measured(high, unit)})` : ""}`;
    return hoverText(context, point, [spec.y]) + off;
  };
  const known = own.filter((point) => point.cost !== null && errorsOf(spec, point)[0] !== null);
  const good = known.filter((point) => !point.failure).sort((a, b) => a.cost - b.cost);
  const at = (point) => [x.place(point.cost), heightOf(y, errorsOf(spec, point)[0])];
  const label = (point) => ({ show: true, formatter: names.shortSetting(experiment, point), position: "top", fontSize: 10, color: inks.text, ...halo });
  const failed = own.filter((point) => point.failure && point.cost !== null);
  const top = y.option.max ?? Math.max(0, ...good.map((point) => errorsOf(spec, point)[0]));
  const upright = good.map((point) => [x.place(point.cost), ...errorsOf(spec, point).slice(1).map((end) => heightOf(y, end))]).filter(([, low, high]) => high > low);
  return [
    { type: "line", name, symbol, symbolSize: 8, itemStyle: { color }, lineStyle: { color, type: dash, width: 1.6 }, labelLayout: { hideOverlap: true }, data: good.map((point) => ({ value: at(point), hover: hover(point), label: label(point) })) },
    intervals(name, good.map((point) => [at(point)[1], x.place(point.cost_low), x.place(point.cost_high)]), "x", { color }),
    ...(upright.length > 0 ? [intervals(name, upright, "y", { color })] : []),
    ...(failed.length > 0 ? [{ type: "scatter", name, symbol: cross, symbolSize: 10, itemStyle: { color, opacity: 0.75 }, data: failed.map((point) => ({ value: errorsOf(spec, point)[0] === null ? [x.place(point.cost), top] : at(point), hover: hover(point), failed: true })) }] : []),
  ];
}

/** What the bound costs on each line, where that lies between two settings. */
function boundCosts(context, spec, x, y) {
  const { experiment, names } = context;
  const unit = names.cost(experiment);
  return spec.lines
    .filter((line) => line.cost_at_bound)
    .map((line) => {
      const { median, low, high } = line.cost_at_bound;
      const name = names.series(experiment, line.name);
      const hover = `<b>${context.escape(name)}</b><br>${figure(median)} ${unit} at the bound (${figure(low)} to ${figure(high)})`;
      return { type: "scatter", name: "at the bound", symbol: "diamond", symbolSize: 9, z: 4, itemStyle: { color: context.style(line.name).color, borderColor: inks.text, borderWidth: 1 }, data: [{ value: [x.place(median), y.place(spec.bound)], hover }] };
    });
}

/** One panel: the scene. */
export function workPrecision(context, spec) {
  const { experiment, names } = context;
  const { points } = experiment.table;
  const timed = points.filter((point) => point.cost !== null);
  const good = timed.filter((point) => !point.failure && errorsOf(spec, point)[0] !== null);
  const shown = good.length > 0 ? good : timed.filter((point) => errorsOf(spec, point)[0] !== null);
  const bound = spec.bound ?? null;
  const band = spec.better !== "high" && spec.band > 0 ? spec.band : null;
  const x = axisOf(timed.flatMap((point) => [point.cost, point.cost_low, point.cost_high]), { log: true, name: names.cost(experiment) });
  // What is not sound is in sight where it is not far beyond the others.
  const sizes = shown.map((point) => errorsOf(spec, point)[0]).filter((value) => value > 0);
  const near = timed.filter((point) => errorsOf(spec, point)[0] > Math.min(...sizes) / 30 && errorsOf(spec, point)[0] < 30 * Math.max(...sizes));
  const heights = [...shown, ...near].flatMap((point) => errorsOf(spec, point)).filter((value) => value > 0 || shown.some((point) => errorsOf(spec, point)[0] === value));
  const y = axisOf([...heights, bound, band], { log: true, name: axisName(context, spec) });
  const series = unique(points.map((point) => point.series)).flatMap((key) => candidateSeries(context, spec, key, x, y, points.filter((point) => point.series === key)));
  if (band !== null) series.push(bandSeries(x.place(timed[0].cost), y, band));
  if (bound !== null) series.push(lineAt("bound", y.place(bound), `at most ${measured(bound, names.metric(experiment, spec.y).unit)}`, "insideEndTop"), ...boundCosts(context, spec, x, y));
  const place = (point) => [x.place(point.cost), heightOf(y, errorsOf(spec, point)[0])];
  const taken = good.find((point) => point.number === experiment.take);
  const isOwn = (point) => point.series === experiment.default.series && point.setting === experiment.default.setting;
  const standard = experiment.default?.own && timed.find((point) => errorsOf(spec, point)[0] !== null && isOwn(point));
  if (taken) series.push(mark("take", "circle", place(taken), taken === standard ? "take: as it is" : "take", "bottom"));
  if (standard && standard !== taken) series.push(mark("default", "rect", place(standard), "as it is", "bottom"));
  const option = base(x.option, y.option, series);
  option.grid.right = 40;
  return [{ panel: points[0].panel, option, height: 340 }];
}

/** What a reader has to know of it. */
export function workPrecisionNote({ experiment }, spec) {
  if (experiment.plots.indexOf(spec) > 0) return "";
  const says = ["A line for each candidate; numbers: its last knob. Order n: twice as fine is 2\u207f times as near. Bars: 95 % of the time, and how far off it may be as far as the reference is known."];
  if (spec.better !== "high" && spec.band > 0) says.push("Shaded: what the reference cannot tell apart; all in it is equal.");
  if (spec.bound !== null && spec.bound !== undefined) says.push("Dashed: the bound; \u25c6: what it costs on a line.");
  says.push("\u25cb: the cheapest sound setting within the bound; \u25a1: the scene as it is.");
  return says.join(" ");
}
