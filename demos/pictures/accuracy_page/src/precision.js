// SPDX-License-Identifier: MIT
import { tried } from "./advice.js";
import { inks } from "./colours.js";
import { unique } from "./data.js";
import { axisOf, intervals } from "./plot_parts.js";
import { figure, measured } from "./words.js";

// Worlds of which it is known by a closed form what must come of them.

/** How many worlds with a closed form are right at which price: the default's is 1. */
export function rightAt(closedForms) {
  const cases = Object.values(closedForms);
  const isRight = ({ error, tolerance }) => error !== null && error <= tolerance;
  const prices = cases.filter((one) => isRight(one) || one.within).map((one) => (isRight(one) ? 1 : Math.max(1, one.price))).sort((a, b) => a - b);
  const steps = [...new Set(prices)].map((price) => [price, prices.filter((other) => other <= price).length]);
  return { all: cases.length, steps, byDefault: cases.filter(isRight).length, never: cases.length - prices.length, most: prices.at(-1) ?? 1 };
}

// Work against precision: what each candidate of an advice takes and how far off it is, its bound and the chosen point.

/** The bound that a plot is about: the one on this metric, else the first. */
export const boundOf = (entry, metric) => entry.bounds.find((bound) => bound.metric === metric) ?? entry.bounds[0];

const limitOf = (bound) => bound.at_most ?? bound.at_least;

// What a plot in a card measures, about: to place words where nothing else is.
const size = { width: 290, height: 112, letter: 6.4, line: 15 };

/** What obstacles inside a box weigh, all in pixels of such a plot. */
const crowd = (box, obstacles) => obstacles.filter(([x, y]) => x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height).reduce((sum, [, , weight = 1]) => sum + weight, 0);

/** Points along lines, so that words avoid these too. */
const along = (points) => points.flatMap(([x, y], i) => (i === 0 ? [[x, y]] : Array.from({ length: 12 }, (_, n) => [points[i - 1][0] + ((x - points[i - 1][0]) * (n + 1)) / 12, points[i - 1][1] + ((y - points[i - 1][1]) * (n + 1)) / 12])));

/** The least crowded of some boxes that are inside the plot. */
function freest(boxes, obstacles) {
  const outside = ({ x, y, width, height }) => Math.max(0, -x) + Math.max(0, x + width - size.width) + Math.max(0, -y - 6) + Math.max(0, y + height - size.height);
  const cost = (box) => crowd(box, obstacles) + outside(box);
  return boxes.reduce((best, box) => (cost(box) < cost(best) ? box : best));
}

/** Words must not cover words: that weighs more than a line behind them. */
const filled = (box) => Array.from({ length: 24 }, (_, i) => [box.x + (box.width * ((i % 8) + 0.5)) / 8, box.y + (box.height * (Math.floor(i / 8) + 0.5)) / 3, 8]);

const halo = { textBorderColor: inks.card, textBorderWidth: 3 };

/** Where words beside a point go. */
function besidePoint([x, y], text) {
  const [width, height, gap] = [size.letter * 1.08 * text.length, size.line, 13];
  return [
    { position: "right", x: x + gap, y: y - height / 2, width, height },
    { position: "left", x: x - gap - width, y: y - height / 2, width, height },
    { position: "top", x: x - width / 2, y: y - gap - height, width, height },
    { position: "bottom", x: x - width / 2, y: y + gap, width, height },
  ];
}

/** Where the words of a line across the plot go. */
function onLine(y, text) {
  const [width, height] = [size.letter * text.length, size.line];
  return [["insideStartBottom", 2, 2], ["insideEndTop", size.width - width - 2, -height - 2], ["insideEndBottom", size.width - width - 2, 2], ["insideStartTop", 2, -height - 2], ["insideMiddleTop", (size.width - width) / 2, -height - 2], ["insideMiddleBottom", (size.width - width) / 2, 2]].map(([position, x, up]) => ({ position, x, y: y + up, width, height }));
}

/** A line across the plot at a value of the upright axis. */
export const lineAt = (name, at, text, position) => ({
  type: "line",
  name,
  symbol: "none",
  silent: true,
  data: [],
  markLine: { silent: true, symbol: "none", label: { formatter: text, position, fontSize: 11, color: inks.text, ...halo }, lineStyle: { color: inks.text, type: "dashed", width: 1.2 }, data: [{ yAxis: at }] },
});

/** A ring or a square around a point, with words beside it. */
export const mark = (name, symbol, place, text, position) => ({
  type: "scatter",
  name,
  silent: true,
  symbol,
  symbolSize: 17,
  z: 5,
  itemStyle: { color: "transparent", borderColor: inks.text, borderWidth: 2 },
  data: [{ value: place, label: { show: true, formatter: text, position, fontSize: 11, fontWeight: "bold", color: inks.text, ...halo } }],
});

/** What plots in cards have in common. */
export const smallPlot = (x, y, series) => ({
  animation: false,
  grid: { left: 4, right: 14, top: 24, bottom: 22, outerBoundsMode: "same", outerBoundsContain: "axisLabel" },
  tooltip: { trigger: "item", confine: true, formatter: (item) => item.data?.hover ?? "" },
  legend: { show: false },
  dataZoom: [],
  xAxis: { ...x, nameGap: 24 },
  yAxis: { ...y, nameLocation: "end", nameGap: 9, nameTextStyle: { align: "left", padding: 0 } },
  series,
});

/** Series that a small plot names: that of the chosen point, of the default, and of those that no other beats; three at most. */
function namedSeries(good, advice) {
  const least = (one) => good.some((other) => other !== one && other.cost <= one.cost && other.value <= one.value && (other.cost < one.cost || other.value < one.value));
  const ends = [advice.choice?.series, advice.default?.series];
  return unique([...ends, ...good.filter((one) => !least(one)).map(({ series }) => series), ...good.map(({ series }) => series)].filter((key) => good.some(({ series }) => series === key))).slice(0, 3);
}

/**
 * {option, legend: [{name, color, dash, symbol}]} of the entry's metric; null where no candidate has it. `advice` is what
 * `advise` made of the entry.
 */
export function precisionPlot({ experiment, names, style, escape }, entry, metric, advice) {
  const bound = boundOf(entry, metric);
  const all = tried(experiment, entry, bound.metric).filter(({ cost }) => cost !== null);
  const good = all.filter(({ value, failure }) => !failure && value !== null);
  if (good.length === 0) return null;
  const limit = limitOf(bound);
  const { unit, name } = names.metric(experiment, bound.metric);
  const x = axisOf(good.flatMap(({ cost, low, high }) => [cost, low, high]), { log: true, name: names.cost(experiment) });
  // What is a thousand times better than it has to be stands at the foot, so that the rest has room.
  const foot = limit > 0 && bound.at_least === undefined ? limit / 1000 : -Infinity;
  const shown = (value) => (value > 0 && value < foot ? foot : value);
  const y = axisOf([...good.flatMap(({ value, value_low, value_high }) => [value, value_low, value_high].map(shown)), limit], { log: true, name: names.metricLabel(experiment, bound.metric) });
  const panel = advice.panels[0];
  const hover = (one) => [`<b>${escape(names.candidate(experiment, one.series, one.setting, panel))}</b>`, one.failure ? `failed: ${escape(one.failure)}` : `${escape(name)}: ${measured(one.value, unit)}`, `${figure(one.cost)} ${names.cost(experiment)} (95 %: ${figure(one.low)} to ${figure(one.high)})`].join("<br>");
  const place = (one) => [x.place(one.cost), y.place(shown(one.value))];
  const named = namedSeries(good, advice);
  const keys = unique(good.map(({ series }) => series));
  const ofSeries = (key) => good.filter((one) => one.series === key).sort((a, b) => a.cost - b.cost);
  const look = (key) => (named.includes(key) ? style(key) : { ...style(key), color: inks.pale });
  const series = [...keys.filter((key) => !named.includes(key)), ...named].flatMap((key) => {
    const { color, symbol, dash } = look(key);
    const label = names.series(experiment, key);
    const own = ofSeries(key);
    const upright = own.filter(({ value_low, value_high }) => value_low !== null && value_high !== null);
    return [
      { type: "line", name: label, symbol, symbolSize: 8, itemStyle: { color }, lineStyle: { color, type: dash, width: 1.6 }, data: own.map((one) => ({ value: place(one), hover: hover(one) })) },
      intervals(label, own.map((one) => [y.place(shown(one.value)), x.place(one.low), x.place(one.high)]), "x", { color }),
      ...(upright.length > 0 ? [intervals(label, upright.map((one) => [x.place(one.cost), y.place(shown(one.value_low)), y.place(shown(one.value_high))]), "y", { color })] : []),
    ];
  });
  const find = (choice) => choice && good.find((one) => one.series === choice.series && one.setting === choice.setting);
  const [chosen, standard] = [find(advice.choice), find(advice.default)];
  const ends = (axis, at) => [axis.option.min ?? Math.min(...good.map((one) => place(one)[at])), axis.option.max ?? Math.max(...good.map((one) => place(one)[at]))];
  const [[left, right], [bottom, top]] = [ends(x, 0), ends(y, 1)];
  const pixel = ([across, up]) => [(size.width * (across - left)) / (right - left || 1), size.height * (1 - (up - bottom) / (top - bottom || 1))];
  const obstacles = keys.flatMap((key) => along(ofSeries(key).map((one) => pixel(place(one)))));
  for (const one of [chosen, standard]) if (one) obstacles.push(...filled({ x: pixel(place(one))[0] - 9, y: pixel(place(one))[1] - 9, width: 18, height: 18 }));
  const limitText = `${bound.at_least === undefined ? "at most" : "at least"} ${measured(limit, unit)}`;
  const atLimit = y.place(limit);
  const limitBox = freest(onLine(pixel([left, atLimit])[1], limitText), obstacles);
  series.push(lineAt("bound", atLimit, limitText, limitBox.position));
  obstacles.push(...filled(limitBox), ...along([pixel([left, atLimit]), pixel([right, atLimit])]));
  const put = (one, key, symbol, text) => {
    const box = freest(besidePoint(pixel(place(one)), text), obstacles);
    obstacles.push(...filled(box));
    series.push(mark(key, symbol, place(one), text, box.position));
  };
  if (chosen) put(chosen, "take", "circle", standard === chosen ? "take, the default" : "take");
  if (standard && standard !== chosen) put(standard, "default", "rect", !advice.default.called || advice.default.called.startsWith("the default") ? "default" : "instead of");
  const others = keys.length > named.length ? [{ name: `${keys.length - named.length} more`, color: inks.pale, dash: "solid", symbol: "circle" }] : [];
  return { option: smallPlot(x.option, y.option, series), bound, legend: [...named.map((key) => ({ name: names.series(experiment, key), ...style(key) })), ...others] };
}
