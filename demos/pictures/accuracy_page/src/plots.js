// SPDX-License-Identifier: MIT
// What a plot shows, as ECharts' options: {title, kind, note, metrics, failed, legend, panels: [{panel, title, option, height, width}]}, or {title, missing}.
import { axisOf, base, cross, halo, hoverText, inLines, intervalOf, intervals, linesOf, namesAxis } from "./plot_parts.js";
import { inks, partColours, plainStyle, shades, shadesNote, tint } from "./colours.js";
import { isGood, unique, valueOf } from "./data.js";
import { effectName, effectWithKey } from "./plain_names.js";
import { front } from "./front.js";
import { capital, figure, measured } from "./words.js";
import { linesWords, workPrecision, workPrecisionNote } from "./work_precision.js";

const ends = { front: "against time", precision: "against time", lines: "over the setting", bars: "of each candidate", heat: "of each candidate on each scene", curves: "over time" };

/** Those of its file; without any a front of each metric. */
export const specsOf = (experiment) => (experiment.plots.length > 0 ? experiment.plots : (experiment.table?.metrics ?? []).map((y) => ({ kind: "front", y })));

export const metricsOf = (experiment, spec) => (spec.kind === "curves" ? [] : spec.y === undefined ? experiment.table.metrics : [spec.y].flat());

/** {axis, height}: names under each other from the top, each with room for as many lines as the longest of them takes. */
function rowsAxis(names, least) {
  const broken = (name) => inLines(name, 26);
  const lines = Math.max(1, ...names.map((name) => broken(name).split("\n").length));
  const axis = namesAxis(names, 200);
  return { axis: { ...axis, inverse: true, axisLabel: { ...axis.axisLabel, formatter: broken } }, height: Math.max(least, 12 * lines + 6) };
}

/** All, or those that the plot names. */
export const panelsOf = (experiment, spec) => experiment.table.panels.filter((panel) => [spec.panel ?? panel].flat().includes(panel));

/** Those where the metric applies, or where everything failed. */
function panelsWith(context, spec) {
  return panelsOf(context.experiment, spec).filter((panel) => context.points(panel).some((point) => valueOf(point, spec.y) !== null) || context.points(panel).every((point) => point.failure));
}

/** Error over cost: settings that no other beats are joined by steps, all others are pale. */
function frontPlot(context, spec) {
  const { experiment, names } = context;
  const metric = spec.y;
  const log = spec.log ?? "xy";
  const panels = panelsWith(context, spec);
  return panels.map((panel) => {
    const points = context.points(panel);
    const good = points.filter((point) => isGood(point, metric));
    const x = axisOf(points.flatMap((point) => [point.cost, point.cost_low, point.cost_high]), { log: log.includes("x"), name: names.cost(experiment) });
    const y = axisOf(good.map((point) => valueOf(point, metric)), { log: log.includes("y"), name: names.metricLabel(experiment, metric) });
    const best = new Set(front(points, metric, spec.better));
    const series = unique(points.map((point) => point.series)).flatMap((key) => {
      const style = context.style(key);
      const name = names.series(experiment, key);
      const own = good.filter((point) => point.series === key);
      const dot = (point) => ({
        value: [x.place(point.cost), y.place(valueOf(point, metric))],
        hover: hoverText(context, point, [metric]),
        itemStyle: { opacity: best.has(point) ? 1 : 0.35 },
        label: { show: best.has(point), formatter: names.shortSetting(experiment, point), position: "right", fontSize: 10, color: inks.text, ...halo },
      });
      return [
        { type: "scatter", name, data: own.map(dot), symbolSize: 9, symbol: style.symbol, itemStyle: { color: style.color }, labelLayout: { hideOverlap: true }, emphasis: { scale: 1.5 } },
        intervals(name, own.map((point) => [y.place(valueOf(point, metric)), x.place(point.cost_low), x.place(point.cost_high)]), "x", style),
      ];
    });
    series.push({ type: "line", name: "best for the time", step: "end", symbol: "none", silent: true, z: 0, lineStyle: { color: inks.line, width: 1.2 }, data: [...best].map((point) => [x.place(point.cost), y.place(valueOf(point, metric))]) });
    if (names.cost(experiment) === "ms per simulated second" && points.some((point) => point.cost > 300))
      series.push({ type: "line", name: "real time", symbol: "none", silent: true, data: [], markLine: { silent: true, symbol: "none", label: { formatter: "real time", fontSize: 10, color: inks.soft }, lineStyle: { color: inks.line, type: "dashed" }, data: [{ xAxis: x.place(1000) }] } });
    series.push(...failures(context, points, metric, (point) => (point.cost === null ? null : x.place(point.cost)), y, good.length > 0));
    const option = base(x.option, y.option, series);
    option.grid.right = 48;  // for the setting beside the last point
    return { panel, option };
  });
}

/** Crosses: at the numbers of a failed point if it has any, else at the upper border. */
function failures(context, points, metric, xOf, y) {
  const failed = points.filter((point) => point.failure && xOf(point) !== null);
  const at = (point) => {
    const value = valueOf(point, metric);
    if (value === null || (y.log && value <= 0)) return null;
    // What is far beyond all others stands at the border, or it would not be seen.
    const place = y.place(value);
    return y.log ? Math.min(Math.max(place, y.option.min), y.option.max) : place;
  };
  const top = Number.isFinite(y.option.max) ? y.option.max : Math.max(0, ...points.filter((point) => isGood(point, metric)).map((point) => valueOf(point, metric)));
  return unique(failed.map((point) => point.series)).map((key) => ({
    type: "scatter",
    name: context.names.series(context.experiment, key),
    symbol: cross,
    symbolSize: 11,
    itemStyle: { color: context.style(key).color },
    data: failed.filter((point) => point.series === key).map((point) => ({ value: [xOf(point), at(point) ?? top], hover: hoverText(context, point, [metric]), failed: true })),
  }));
}

/** The exponent of a power law through points, by least squares; null where there are fewer than three. */
export function slope(xs, ys) {
  const points = xs.map((x, i) => [Math.log(x), Math.log(ys[i])]).filter((pair) => pair.every(Number.isFinite));
  if (points.length < 3) return null;
  const mean = [0, 1].map((d) => points.reduce((sum, point) => sum + point[d], 0) / points.length);
  const [up, down] = points.reduce(([a, b], [x, y]) => [a + (x - mean[0]) * (y - mean[1]), b + (x - mean[0]) ** 2], [0, 0]);
  return down > 0 ? up / down : null;
}

/** Where the points of a panel are on the x axis: by their number, else one place for each setting. */
function knobAxis(context, points, log, name) {
  const numbers = points.every((point) => point.x !== null);
  const sizes = points.map((point) => Math.abs(point.x)).filter((size) => size > 0);
  const wide = sizes.length > 0 && Math.max(...sizes) > 1000 * Math.min(...sizes);
  const knob = context.names.knob(context.experiment, points[0].panel);
  if (numbers && (!wide || (log && points.every((point) => point.x >= 0)))) {
    const ticks = unique(points.map((point) => point.x)).sort((a, b) => a - b);
    const axis = axisOf(ticks, { log, name, ticks, integer: knob.integer });
    return { log: axis.log, option: axis.option, at: (point) => axis.place(point.x) };
  }
  const settings = unique((numbers ? [...points].sort((a, b) => a.x - b.x) : points).map((point) => point.setting));
  const shown = settings.map((setting) => context.names.shortSetting(context.experiment, { setting, panel: points[0].panel }));
  // Many short names stand upright, so that none covers its neighbour.
  const steep = shown.length > 7 ? 90 : 0;
  return { log: false, option: { ...namesAxis(shown, 50, steep), name, nameLocation: "middle", nameGap: steep ? 52 : 16 + 12 * linesOf(shown, 50) }, at: (point) => settings.indexOf(point.setting) };
}

/** A metric over the knob. */
function linesPlot(context, spec) {
  const { experiment, names } = context;
  const metric = spec.y;
  const panels = panelsWith(context, spec);
  return panels.map((panel) => {
    const points = context.points(panel);
    const good = points.filter((point) => isGood(point, metric));
    const x = knobAxis(context, points, (spec.log ?? "").includes("x"), spec.x_label ?? names.knob(experiment, panel).axis ?? "");
    const spread = good.map((point) => [point, ...intervalOf(point, metric)]).filter(([, low, high]) => low !== null && high !== null);
    const y = axisOf([...good.map((point) => valueOf(point, metric)), ...spread.flatMap(([, low, high]) => [low, high])], { log: (spec.log ?? "").includes("y"), name: names.metricLabel(experiment, metric) });
    const series = unique(points.map((point) => point.series)).flatMap((key) => {
      const style = context.style(key);
      const name = names.series(experiment, key);
      const own = good.filter((point) => point.series === key).sort((a, b) => x.at(a) - x.at(b));
      const power = x.log && y.log ? slope(own.map((point) => point.x), own.map((point) => valueOf(point, metric))) : null;
      const end = { show: true, formatter: power === null ? "" : `slope ${power.toFixed(2).replace(/^-0\.00$/, "0.00").replace("-", "\u2212")}`, position: "top", align: "right", padding: [2, 8], fontSize: 10, color: inks.text, ...halo };
      const line = {
        type: "line",
        name,
        symbol: style.symbol,
        symbolSize: 7,
        itemStyle: { color: style.color },
        lineStyle: { color: style.color, type: style.dash, width: 1.6 },
        labelLayout: { hideOverlap: true },
        data: own.map((point, i) => ({ value: [x.at(point), y.place(valueOf(point, metric))], hover: hoverText(context, point, [metric]), label: i === own.length - 1 && power !== null ? end : undefined })),
      };
      const bars = spread.filter(([point]) => point.series === key).map(([point, low, high]) => [x.at(point), y.place(low), y.place(high)]);
      return bars.length > 0 ? [line, intervals(name, bars, "y", style)] : [line];
    });
    series.push(...failures(context, points, metric, x.at, y));
    return { panel, option: base(x.option, y.option, series) };
  });
}

/** Metrics of a point on top of each other: what a whole is made of. */
function barsPlot(context, spec) {
  const { experiment, names } = context;
  const metrics = metricsOf(experiment, spec);
  return experiment.table.panels.map((panel) => {
    const points = context.points(panel);
    const label = (point) => names.candidate(experiment, point.series, point.setting, panel);
    const x = axisOf([], { name: unique(metrics.map((metric) => names.metric(experiment, metric).unit)).join(", ") });
    const series = metrics.map((metric, i) => ({
      type: "bar",
      name: names.metric(experiment, metric).name,
      stack: "all",
      barMaxWidth: 16,
      itemStyle: { color: partColours[i % partColours.length] },
      data: points.map((point) => ({ value: point.failure ? null : valueOf(point, metric), hover: hoverText(context, point, metrics) })),
    }));
    const failed = points.flatMap((point, i) => (point.failure ? [{ value: [0, i], hover: hoverText(context, point, metrics), failed: true }] : []));
    if (failed.length > 0) series.push({ type: "scatter", name: "failed", symbol: cross, symbolSize: 11, itemStyle: { color: plainStyle.color }, data: failed });
    const rows = rowsAxis(points.map(label), 34);
    const option = base({ ...x.option, scale: false }, rows.axis, series);
    return { panel, option: { ...option, dataZoom: [] }, height: 60 + rows.height * points.length };
  });
}

/** Matrices of candidates and scenes, or of candidates and settings for each scene. */
function matrices(context, spec) {
  const { experiment, names } = context;
  const { table } = experiment;
  if (spec.x === "x")
    return table.panels.map((panel) => {
      const points = context.points(panel);
      const cells = new Map(points.map((point) => [`${names.series(experiment, point.series)}\n${names.shortSetting(experiment, point)}`, point]));
      return { panel, rows: unique(points.map((point) => names.series(experiment, point.series))), columns: unique(points.map((point) => names.shortSetting(experiment, point))), cells };
    });
  const label = (point) => names.candidate(experiment, point.series, point.setting, point.panel);
  const plain = unique(table.points.map((point) => `${point.series}\n${point.setting}`)).length === unique(table.points.map((point) => point.series)).length;
  const row = (point) => (plain ? names.series(experiment, point.series) : label(point));
  const cells = new Map(table.points.map((point) => [`${row(point)}\n${names.panel(experiment, point.panel)}`, point]));
  return [{ panel: null, rows: unique(table.points.map(row)), columns: table.panels.map((panel) => names.panel(experiment, panel)), cells }];
}

function heatPlot(context, spec) {
  const { experiment, names } = context;
  const shade = shades(experiment, spec);
  return matrices(context, spec).map(({ panel, rows, columns, cells }) => {
    const data = rows.flatMap((row, r) =>
      columns.flatMap((column, c) => {
        const point = cells.get(`${row}\n${column}`);
        const value = point ? valueOf(point, spec.y) : null;
        if (!point || (!point.failure && value === null)) return [];
        const text = point.failure ? "\u00d7" : figure(value);
        return [{ value: [c, r], text, fill: point.failure ? inks.failed : shade(value), hover: `${panel === null ? `${context.escape(column)}<br>` : ""}${hoverText(context, point, [spec.y])}`, failed: Boolean(point.failure) }];
      }),
    );
    const series = {
      type: "custom",
      name: names.metric(experiment, spec.y).name,
      data,
      encode: { x: 0, y: 1 },
      renderItem: (params, api) => {
        const [x, y] = api.coord([api.value(0), api.value(1)]);
        const [w, h] = api.size([1, 1]).map((size) => size - 2);
        const { text, fill } = data[params.dataIndex];
        return { type: "rect", shape: { x: x - w / 2, y: y - h / 2, width: w, height: h }, style: { fill: tint(fill) }, textContent: { style: { text, fontSize: 11, fill: tint(inks.text) } }, textConfig: { position: "inside" } };
      },
    };
    const width = panel === null ? 74 : 58;
    const upright = rowsAxis(rows, 24);
    const option = base(namesAxis(columns, width - 4), upright.axis, [series]);
    return { panel, option: { ...option, dataZoom: [] }, height: upright.height * rows.length + 40 + 12 * linesOf(columns, width - 4), width: 210 + width * columns.length };
  });
}

/** Of "1e-7, 10 %" the setting and the share of runs that stay below the curve. */
function quantileOf(setting) {
  const [, of, share] = /^(.*), (\d+ %)$/.exec(setting) ?? [null, setting, null];
  return { of, share };
}

/** {scene, series, setting, share, at, values} of the curves that a plot shows. */
function curvesOf(experiment, spec) {
  const ending = `: ${spec.y}`;
  const named = experiment.curves.filter(([panel]) => panel.endsWith(ending));
  return (named.length > 0 ? named : experiment.curves).map(([panel, series, setting, at, values]) => {
    const { of, share } = quantileOf(setting);
    return { scene: panel.endsWith(ending) ? panel.slice(0, -ending.length) : panel, series, setting: of, share, at, values };
  });
}

/** {min, max} around values, at half a power of ten. */
function roundEnds(values) {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  if (most === least) return {};
  const step = 0.5 * 10 ** Math.floor(Math.log10(most - least));
  return { min: step * Math.floor(least / step), max: step * Math.ceil(most / step) };
}

/**
 * Values over time: how runs part. Colours and dashes are those of the series in all plots, so each setting has a panel
 * of its own where a series has several. Of quantiles the middle one is bold.
 */
function curvesPlot(context, spec) {
  const { experiment, names } = context;
  const curves = curvesOf(experiment, spec);
  const unit = spec.y ? names.metric(experiment, spec.y).unit : "";
  const ofScene = (scene) => curves.filter((curve) => curve.scene === scene);
  const split = (own) => unique(own.map(({ series }) => series)).some((key) => unique(own.filter(({ series }) => series === key).map(({ setting }) => setting)).length > 1);
  return unique(curves.map(({ scene }) => scene)).flatMap((scene) => {
    const all = ofScene(scene);
    const x = axisOf(all.flatMap(({ at }) => [at[0], at.at(-1)]), { log: (spec.log ?? "").includes("x"), name: spec.x_label ?? "simulated time, s" });
    const y = axisOf(all.flatMap(({ values }) => values), { log: (spec.log ?? "").includes("y"), name: spec.y_label ?? (spec.y ? names.metricLabel(experiment, spec.y) : "") });
    // All panels of a scene have the same axis; a logarithmic one has its ends already.
    const upright = { ...y.option, ...(y.log ? {} : roundEnds(all.flatMap(({ values }) => values))) };
    const panelOf = (own, title) => {
      const series = own.map((curve) => {
        const { color, dash } = context.style(curve.series);
        const width = curve.share === null || curve.share === "50 %" ? 1.8 : 0.7;
        return { type: "line", name: names.series(experiment, curve.series), showSymbol: false, symbol: "circle", symbolSize: 5, itemStyle: { color }, lineStyle: { color, type: dash, width }, data: curve.at.map((at, i) => [x.place(at), y.place(curve.values[i])]) };
      });
      const option = base(x.option, upright, series);
      const line = ({ seriesIndex, dataIndex }) => `<b>${context.escape(series[seriesIndex].name)}</b>${own[seriesIndex].share ? `, ${own[seriesIndex].share} of the runs` : ""}: ${measured(own[seriesIndex].values[dataIndex], unit)}`;
      const hover = (items) => [`at ${figure(own[items[0].seriesIndex].at[items[0].dataIndex])}`, ...items.slice(0, 12).map(line)].join("<br>");
      return { panel: scene, title, option: { ...option, tooltip: { ...option.tooltip, trigger: "axis", axisPointer: { type: "line" }, formatter: hover } } };
    };
    const plain = names.panel(experiment, scene);
    if (!split(all)) return [panelOf(all, plain)];
    return unique(all.map(({ setting }) => setting)).map((setting) => panelOf(all.filter((curve) => curve.setting === setting), `${plain}, ${names.setting(experiment, setting, scene)}`));
  });
}

const hasIntervals = (panels) => panels.some(({ option }) => option.series.some(({ type }) => type === "custom"));

/** What a reader has to know of each kind of plot. */
const notes = {
  front: () => "Settings that no other beats in both are joined by steps; all others are pale. Bars: 95 % intervals.",
  precision: workPrecisionNote,
  lines: (context, spec, panels) => (hasIntervals(panels) ? "Bars: 95 % intervals." : ""),
  bars: () => "",
  heat: shadesNote,
  curves: ({ experiment }, spec) => (curvesOf(experiment, spec).some(({ share }) => share) ? "Bold: half of the runs stay below this line; thin: 10 and 90 % of them." : ""),
};

/** Series that are no candidates. */
const unnamed = ["best for the time", "real time", "bound", "band", "take", "default", "at the bound"];

const kinds = { front: frontPlot, precision: workPrecision, lines: linesPlot, bars: barsPlot, heat: heatPlot, curves: curvesPlot };

/** `context`: {experiment, names, style(series), escape, points(panel)}. */
export function plotOf(context, spec) {
  const { experiment, names } = context;
  const metrics = metricsOf(experiment, spec);
  const title = spec.title ?? capital(`${metrics.map((metric) => names.metric(experiment, metric).name).join(", ")} ${ends[spec.kind]}`.trim());
  const absent = metrics.find((metric) => metric !== "cost" && !experiment.table.metrics.includes(metric));
  if (spec.kind === "curves" && experiment.curves.length === 0) return { title, missing: "no curves were recorded" };
  if (absent) return { title, missing: `the table has no ${absent}` };
  const panels = kinds[spec.kind](context, spec);
  const drawn = panels.flatMap((panel) => panel.option.series.filter((series) => !unnamed.includes(series.name)));
  const failed = drawn.some((series) => series.data.some((item) => item?.failed));
  const crosses = spec.kind === "precision" ? "\u00d7: failed, or not sound; the table below says why." : "\u00d7: a run that failed; the table below says why.";
  const note = [notes[spec.kind](context, spec, panels), failed ? crosses : ""].filter(Boolean).join(" ");
  const said = spec.kind === "precision" ? linesWords(context, spec) : new Map();
  return { title, kind: spec.kind, note, metrics, panels, failed, legend: spec.kind === "heat" ? [] : unique(drawn.map((series) => series.name)).map((name) => ({ name, said: said.get(name) ?? "", ...legendStyle(drawn, name) })) };
}

function legendStyle(drawn, name) {
  const series = drawn.find((one) => one.name === name && one.itemStyle);
  const kind = series?.type === "bar" ? "roundRect" : series?.symbol?.startsWith("path") ? "none" : series?.symbol;
  return { color: series?.itemStyle.color ?? inks.soft, dash: series?.lineStyle?.type ?? "solid", symbol: series?.showSymbol === false ? "none" : kind ?? "none", line: series?.type === "line" };
}

/** What each effect costs where a scene calls for it. */
export function pricesPlot(prices, escape) {
  const effects = Object.entries(prices.effects).sort((a, b) => b[1].ns_per_body_step - a[1].ns_per_body_step);
  const least = 1;
  const clip = (value) => Math.log10(Math.max(value, least));
  const axis = axisOf([least, ...effects.map(([, price]) => Math.max(least, price.interval_ns[1]))], { log: true, name: "ns per body and step" });
  const hover = ([name, price]) => `<b>${escape(effectWithKey(name))}</b><br>${figure(price.ns_per_body_step)} ns per body and step<br>rounds: ${figure(price.interval_ns[0])} to ${figure(price.interval_ns[1])} ns`;
  const series = [
    { type: "bar", name: "price", barMaxWidth: 14, itemStyle: { color: plainStyle.color }, data: effects.map((effect) => ({ value: clip(effect[1].ns_per_body_step), hover: hover(effect) })) },
    intervals("price", effects.map(([, price], i) => [i, clip(price.interval_ns[0]), clip(price.interval_ns[1])]), "x", { color: inks.text }),
  ];
  const rows = rowsAxis(effects.map(([name]) => effectName(name)), 20);
  const option = base({ ...axis.option, min: 0 }, rows.axis, series);
  return { title: "Effects by price; those below 1 ns stand at 1 ns", kind: "bars", metrics: [], legend: [], failed: false, panels: [{ panel: null, option: { ...option, dataZoom: [] }, height: 60 + rows.height * effects.length }] };
}
