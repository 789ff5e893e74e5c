// SPDX-License-Identifier: MIT
// Which setting to take: computed from the entries "advice" of the experiments and their tables.
import { keyOf, matches, noise, valueOf } from "./data.js";

/** Differences of time below this are ties, however narrow the intervals. */
const leastDifference = 0.01;

/** What breaks bounds by no more than this, and costs much less, is worth a word. */
const almost = { excess: 1.1, cost: 0.75 };

/** Geometric, so that no panel outweighs the others. */
const geometric = (values) => Math.exp(values.reduce((sum, value) => sum + Math.log(Math.max(value, 1e-300)), 0) / values.length);

/** Bounds may be about some panels only. */
const concerns = ({ panel }, point) => matches(point, { panel });

/** Is the bound kept? */
export const keeps = (value, bound) => value !== null && (bound.at_most === undefined || value <= bound.at_most) && (bound.at_least === undefined || value >= bound.at_least);

/** How far a value is beyond its bound, 1 is on it: to find what comes nearest. */
function excess(value, bound) {
  if (value === null) return Infinity;
  if (keeps(value, bound)) return 1;
  if (bound.at_least !== undefined) return value > 0 ? bound.at_least / value : 1e9;
  return bound.at_most > 0 ? value / bound.at_most : 1e6 * (1 + value);
}

const worse = (bound) => (a, b) => ((bound.at_least !== undefined ? a < b : a > b) ? a : b);

/** The worst value of a metric over points that have it, of those that the bound is about. */
export function worst(points, bound) {
  const values = points.filter((point) => concerns(bound, point)).map((point) => valueOf(point, bound.metric)).filter((value) => value !== null);
  return values.length > 0 ? values.reduce(worse(bound)) : null;
}

/**
 * Key -> {series, setting, points}. Where the setting is a question and not a choice, such as how many boxes there are,
 * a candidate is a series with all its settings. Those that were not measured wherever the default was, or wherever
 * anything was, are left out.
 */
function candidates(points, over, defaultKey) {
  const place = (point) => JSON.stringify([point.panel, over ? point.setting : ""]);
  const groups = new Map();
  for (const point of points) {
    const setting = over ? "" : point.setting;
    const key = JSON.stringify([point.series, setting]);
    if (!groups.has(key)) groups.set(key, { key, series: point.series, setting, points: [] });
    groups.get(key).points.push(point);
  }
  const wanted = new Set((groups.get(defaultKey)?.points ?? points).map(place));
  for (const [key, group] of groups) {
    group.points = group.points.filter((point) => wanted.has(place(point)));
    if (new Set(group.points.map(place)).size < wanted.size) groups.delete(key);
  }
  return groups;
}

/** The point of another candidate at the place of a point. */
const beside = (point, others, over) => others.find((other) => other.panel === point.panel && (!over || other.setting === point.setting));

/**
 * Ratio of times of two candidates: geometric mean over scenes, with an interval from those of both and from `by`, what
 * two series of the same candidate differ by. `places` are the ratios that it is the mean of.
 */
function ratioOf(points, others, by, over) {
  const mean = (of, name) => geometric(of.map((point) => point[name] ?? point.cost));
  const places = points.flatMap((point) => {
    const other = beside(point, others, over);
    return other ? [{ panel: point.panel, setting: over ? point.setting : "", value: point.cost / other.cost }] : [];
  });
  return {
    value: mean(points, "cost") / mean(others, "cost"),
    low: mean(points, "cost_low") / mean(others, "cost_high") / (1 + by),
    high: (mean(points, "cost_high") / mean(others, "cost_low")) * (1 + by),
    places,
  };
}

/** The largest part of a bound that a candidate uses, in hundredths; bounds of 0 have no parts. */
function strain(points, bounds) {
  const part = (bound) => {
    const value = worst(points, bound);
    if (value === null) return 0;
    if (bound.at_least !== undefined) return value > 0 ? bound.at_least / value : 0;
    return bound.at_most > 0 ? value / bound.at_most : 0;
  };
  return Math.round(100 * Math.max(...bounds.map(part)));
}

/** Ratio of instructions, where both were counted at all places; null otherwise: some places do not speak for all. */
function countRatio(experiment, points, others, over) {
  const count = (point) => point.instructions ?? experiment.counts.get(keyOf(point)) ?? null;
  const pairs = points.flatMap((point) => {
    const other = beside(point, others, over);
    const [a, b] = [count(point), other ? count(other) : null];
    return a && b ? [a / b] : [];
  });
  return pairs.length > 0 && pairs.length === points.length ? geometric(pairs) : null;
}

/** What an advice compares with. "@simd" is the widest kind of vector instructions of the machine, which is what callers get. */
function defaultOf(experiment, entry, over) {
  const { series = "", setting = "" } = entry.default ?? {};
  return { series: series === "@simd" ? experiment.table.facts.simd ?? "" : String(series), setting: over ? "" : String(setting) };
}

/** What an entry is about: {groups, panels, asked(point), over, defaultKey}, or {missing}. */
function scope(experiment, entry) {
  const { bounds } = entry;
  const { table } = experiment;
  if (!table) return { missing: "not measured" };
  const unknown = bounds.find((bound) => bound.metric !== "cost" && !table.metrics.includes(bound.metric));
  if (unknown) return { missing: `the table has no ${unknown.metric}` };
  const named = [entry.panel ?? "*"].flat();
  const inPanels = table.points.filter((point) => (named.includes("*") || named.includes(point.panel)) && (entry.settings?.includes(point.setting) ?? true));
  if (inPanels.length === 0) return { missing: `no ${named.join(", ")} in the table` };

  // Where no metric applies there is nothing to keep.
  const applies = new Set(inPanels.flatMap((point) => bounds.filter((bound) => concerns(bound, point) && valueOf(point, bound.metric) !== null).map((bound) => `${point.panel}\n${bound.metric}`)));
  const asked = (point) => bounds.filter((bound) => concerns(bound, point) && applies.has(`${point.panel}\n${bound.metric}`));
  const points = inPanels.filter((point) => point.failure || asked(point).some((bound) => valueOf(point, bound.metric) !== null));
  const over = entry.over === "setting";
  const standard = defaultOf(experiment, entry, over);
  const defaultKey = JSON.stringify([standard.series, standard.setting]);
  return { groups: candidates(points, over, defaultKey), panels: [...new Set(points.map((point) => point.panel))], asked, over, defaultKey };
}

/**
 * All that an entry chooses from, each as one point: {series, setting, x, cost, low, high, value, failure}. Over several
 * scenes the cost is the geometric mean and the value the worst.
 */
export function tried(experiment, entry, metric) {
  const found = scope(experiment, entry);
  if (found.missing) return [];
  const bound = entry.bounds.find((one) => one.metric === metric) ?? { metric, at_most: 0 };
  return [...found.groups.values()].map(({ series, setting, points }) => {
    const mean = (name) => (points.every((point) => point.cost > 0) ? geometric(points.map((point) => point[name] ?? point.cost)) : null);
    const end = (name) => worst(points.filter((point) => concerns(bound, point)), { ...bound, metric: `${metric}.${name}`, panel: undefined });
    return { series, setting, x: points[0].x, cost: mean("cost"), low: mean("cost_low"), high: mean("cost_high"), value: worst(points, bound), value_low: end("low"), value_high: end("high"), failure: points.find((point) => point.failure)?.failure ?? "" };
  });
}

/**
 * The cheapest setting that keeps all bounds on all panels that the entry is about:
 * {purpose, bounds, panels, choice, values: [{bound, value, default}], ratio, tie, isDefault, defaultBreaks, counts,
 * almost, nearest, without, alone, missing}. `almost` is a much cheaper one that misses a bound by little.
 */
export function advise(experiment, entry) {
  const { bounds } = entry;
  const advice = { experiment, purpose: entry.for ?? experiment.title, isPrice: entry.price === true, note: entry.note ?? "", bounds, panels: [], values: [], without: [], alone: [] };
  const found = scope(experiment, entry);
  if (found.missing) return { ...advice, missing: found.missing };
  const { groups, asked, over, defaultKey } = found;
  advice.panels = found.panels;
  const fits = (point) => !point.failure && point.cost !== null && asked(point).every((bound) => keeps(valueOf(point, bound.metric), bound));
  const allowed = [...groups.values()].filter((group) => entry.series === undefined || group.series === entry.series);
  const fallback = groups.get(defaultKey);
  advice.default = entry.default ? { ...defaultOf(experiment, entry, over), called: entry.default.called ?? "", measured: Boolean(fallback) } : null;
  const defaultFailure = fallback?.points.find((point) => point.failure)?.failure ?? "";
  if (fallback) advice.default.failure = defaultFailure;
  advice.defaultBreaks = fallback && !defaultFailure ? bounds.filter((bound) => fallback.points.some((point) => asked(point).includes(bound) && !keeps(valueOf(point, bound.metric), bound))) : [];

  const cost = (group) => geometric(group.points.map((point) => point.cost));
  const cheapest = (all) => all.reduce((best, group) => (!best || cost(group) < cost(best) ? group : best), null);
  const fitting = allowed.filter((group) => group.points.every(fits));
  const noiseHere = noise(experiment, advice.panels);
  const ratio = (group, other) => ratioOf(group.points, other.points, noiseHere, over);
  const isTie = (one) => (one.low <= 1 && one.high >= 1) || Math.abs(one.value - 1) <= Math.max(leastDifference, noiseHere);
  const beyond = (group, bound) => Math.max(...group.points.filter((point) => asked(point).includes(bound)).map((point) => excess(valueOf(point, bound.metric), bound)), 1);
  const far = (group) => Math.max(...bounds.map((bound) => beyond(group, bound)));
  const usable = allowed.filter((group) => group.points.every((point) => !point.failure));
  if (fitting.length === 0) {
    const nearest = usable.reduce((found, group) => (!found || far(group) < far(found) ? group : found), null);
    advice.nearest = nearest && { series: nearest.series, setting: nearest.setting, values: bounds.map((bound) => ({ bound, value: worst(nearest.points, bound) })) };
    for (const panel of advice.panels) {
      const here = allowed.map((group) => ({ ...group, points: group.points.filter((point) => point.panel === panel) })).filter((group) => group.points.length > 0);
      const found = cheapest(here.filter((group) => group.points.every(fits)));
      if (found) advice.alone.push({ panel, series: found.series, setting: found.setting });
      else advice.without.push(panel);
    }
    return advice;
  }
  // Of those that take as long as the cheapest the default; else what uses the least of its bounds, then what is most like
  // the default.
  const least = cheapest(fitting);
  const tied = fitting.filter((group) => isTie(ratio(least, group)));
  const rank = (group) => [group !== fallback, strain(group.points, bounds), group.series !== advice.default?.series, group.setting !== advice.default?.setting, cost(group)].map(Number);
  const before = (a, b) => rank(a).map((value, i) => value - rank(b)[i]).find((difference) => difference !== 0) ?? 0;
  const best = tied.sort(before)[0];
  advice.choice = { series: best.series, setting: best.setting };
  advice.isDefault = best === fallback;
  advice.ratio = fallback && !defaultFailure ? ratio(best, fallback) : null;
  advice.tie = Boolean(advice.ratio) && !advice.isDefault && isTie(advice.ratio);
  const missing = (group) => bounds.filter((bound) => beyond(group, bound) > 1).map((bound) => ({ bound, value: worst(group.points, bound) }));
  const near = cheapest(usable.filter((group) => far(group) > 1 && far(group) <= almost.excess && cost(group) < almost.cost * cost(best)));
  advice.almost = near && { series: near.series, setting: near.setting, ratio: fallback && !defaultFailure ? ratio(near, fallback) : null, missing: missing(near) };
  advice.counts = fallback ? countRatio(experiment, best.points, fallback.points, over) : null;
  advice.costs = best.points.map((point) => point.cost);
  advice.values = bounds.map((bound) => ({ bound, value: worst(best.points, bound), default: fallback && !defaultFailure ? worst(fallback.points, bound) : null }));
  return advice;
}

export const advices = (experiment) => experiment.advice.map((entry) => advise(experiment, entry));
