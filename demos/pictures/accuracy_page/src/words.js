// SPDX-License-Identifier: MIT
import { limitOfTwins, noise } from "./data.js";

// Numbers as people read them.

const thin = "\u202f";

/** Three digits, without an exponent where that can be read; null is a dash. */
export function figure(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "\u2013";
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  if (value === 0) return "0";
  const size = Math.abs(value);
  let text;
  if (Number.isInteger(value) && size < 1e6) text = String(value).replace(/\B(?=(\d{3})+$)/g, thin);
  else if (size >= 1e6 || size < 1e-4) text = value.toExponential(digits - 1).replace(/\.?0*e/, "e").replace("e+", "e");
  else text = value.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(size)))).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  return text.replaceAll("-", "\u2212");
}

const prefixed = { m: [[1e-6, "nm", 1e9], [1e-3, "\u00b5m", 1e6], [1, "mm", 1e3]], s: [[1e-3, "\u00b5s", 1e6], [1, "ms", 1e3]] };

/** "0.18 mm": with the unit, in the prefix that reads best. */
export function measured(value, unit = "", digits = 3) {
  if (unit === "yes/no" && value !== null) return value >= 1 ? "yes" : "no";
  if (value === null || value === undefined || !Number.isFinite(value) || value === 0) return unit && value === 0 ? `0 ${unit}` : figure(value);
  const found = (prefixed[unit] ?? []).find(([below]) => Math.abs(value) < 0.1 * below) ?? [0, unit, 1];
  const shown = figure(value * found[2], digits);
  return found[1] ? `${shown} ${found[1]}` : shown;
}

export const percent = (share) => `${figure(100 * share, 2)} %`;

export const several = (count, noun) => `${figure(count)} ${noun}${count === 1 ? "" : "s"}`;

export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** "a, b and c". */
export function listed(names) {
  return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}

/** A number with as many digits as its interval bears: the last digit is of the size of half the interval. */
export function borne(value, low, high) {
  const half = (high - low) / 2;
  if (!(half > 0)) return figure(value);
  const digits = Math.floor(Math.log10(Math.abs(value))) - Math.round(Math.log10(half)) + 1;
  return figure(Number(value.toPrecision(Math.min(3, Math.max(1, digits)))), 3);
}

/** What a ratio of times means: "30 × faster", "2.1 × the default's time". */
export function timeWords({ value, low, high }, other = "the default") {
  if (value <= 1 / 1.5) return `${borne(1 / value, 1 / high, 1 / low)} \u00d7 faster than ${other}`;
  if (value >= 1.5) return `${borne(value, low, high)} \u00d7 the time of ${other}`;
  const part = (ratio) => 100 * (value < 1 ? 1 - ratio : ratio - 1);
  const [least, most] = [part(low), part(high)].sort((a, b) => a - b);
  return `${part(value) < 1 ? "about 1" : borne(part(value), least, most)} % ${value < 1 ? "less" : "more"} time than ${other}`;
}

/** Ratios nearer to each other than this are one number. */
const alike = 1.3;

/**
 * The same where there are several: "1.7 to 4.6 × faster". Where it is faster here and slower there, both are named.
 * `places` are {value, name}; what differs from 1 by less than `noise` is neither.
 */
export function timesWords(mean, places, noise, other = "the default") {
  const two = (ratio) => figure(Number(ratio.toPrecision(2)));
  const [least, ...more] = [...places].sort((a, b) => a.value - b.value);
  const most = more.at(-1);
  if (!most || most.value / least.value <= alike) return timeWords(mean, other);
  if (most.value <= 1 + noise) return `${two(Math.max(1, 1 / most.value))} to ${two(1 / least.value)} \u00d7 faster than ${other}`;
  if (least.value >= 1 - noise) return `${two(Math.max(1, least.value))} to ${two(most.value)} \u00d7 the time of ${other}`;
  const part = (ratio) => `${figure(Number((100 * Math.abs(ratio - 1)).toPrecision(1)))} %`;
  const faster = least.value <= 1 / 1.5 ? `${two(1 / least.value)} \u00d7 faster` : `${part(least.value)} less time`;
  const slower = most.value >= 1.5 ? `${two(most.value)} \u00d7 its time` : `${part(most.value)} more time`;
  return `from ${faster} than ${other} (${least.name}) to ${slower} (${most.name})`;
}

/** A ratio of errors: two digits, and no more than a thousand. */
const times = (ratio) => (ratio > 1000 ? "over 1000 \u00d7" : `${figure(Number(ratio.toPrecision(2)))} \u00d7`);

/** What a ratio of errors means: "12 × less penetration"; nothing where they are alike. */
export function errorWords(value, other, noun, better = "low") {
  if (value === null || other === null || value === other) return "";
  const [small, large] = better === "high" ? [other, value] : [value, other];
  if (better === "high") return small > 0 && large / small >= 1.1 ? `${times(large / small)} more ${noun}` : "";
  if (small === 0 && large > 0) return `no ${noun}`;
  return small > 0 && large / small >= 1.1 ? `${times(large / small)} less ${noun}` : "";
}

// Advice in words.

/** "deepest contact at most 5 mm". */
export function boundWords(names, experiment, bound) {
  const { name, noun, unit } = names.metric(experiment, bound.metric);
  const where = bound.panel === undefined ? "" : ` (${listed([bound.panel].flat().map((panel) => names.panel(experiment, panel)))})`;
  if (bound.at_least !== undefined) return (unit === "yes/no" ? name : `${name} at least ${measured(bound.at_least, unit)}`) + where;
  return (bound.at_most === 0 ? `no ${noun}` : `${name} at most ${measured(bound.at_most, unit)}`) + where;
}

/** "1.7 to 4.6 × faster than `other`". */
function ratioWords(names, { experiment, panels }, ratio, other) {
  const places = ratio.places.map(({ panel, setting, value }) => ({
    value,
    name: [panels.length > 1 ? names.panel(experiment, panel) : "", setting ? names.setting(experiment, setting, panel) : ""].filter(Boolean).join(", "),
  }));
  return timesWords(ratio, places, Math.max(limitOfTwins, noise(experiment, panels)), other);
}

/** What the choice costs beside the default, which is called `other`. */
function costWords(names, advice, other) {
  const { experiment } = advice;
  if (advice.isDefault) return other;
  if (!advice.ratio) {
    const failure = advice.default?.failure;
    const [least, most] = [Math.min(...advice.costs), Math.max(...advice.costs)].map((cost) => figure(cost));
    return [`${least === most ? least : `${least} to ${most}`} ${names.cost(experiment)}`, failure ? `${other} fails: ${failure}` : ""].filter(Boolean).join("; ");
  }
  const time = advice.tie ? `the same time as ${other}, within the noise` : ratioWords(names, advice, advice.ratio, other);
  // Half the interval has the noise in it, but for rounding.
  const { value, low, high } = advice.ratio;
  const noisy = Math.max(noise(experiment, advice.panels), (high - low) / (2 * value)) > limitOfTwins;
  return noisy && advice.counts ? `${time}; ${figure(advice.counts, 2)} \u00d7 the instructions at small sizes` : time;
}

/** What the choice buys, for each bound where it differs from the default: {better: "30 × less penetration" or "", words}. */
function gainsOf(names, advice) {
  if (advice.isDefault) return [];
  return advice.values
    .filter(({ value, default: other }) => value !== null && other !== null && value !== other)
    .map(({ bound, value, default: other }) => {
      const { name, noun } = names.metric(advice.experiment, bound.metric);
      const better = errorWords(value, other, noun, bound.at_least !== undefined ? "high" : "low");
      const numbers = `${names.value(advice.experiment, bound.metric, value)} instead of ${names.value(advice.experiment, bound.metric, other)}`;
      return { better, words: better ? `${better} (${numbers})` : `${name} ${numbers}` };
    });
}

/**
 * All sentences of an advice: {take, cost, gains, gain, almost, trouble ...}; `gain` is the first that is one. The
 * default is called `other`, or what its entry calls it; where its setting is to be `named`, what the choice costs says it.
 */
export function adviceWords(names, advice, { other: standard = "the default", named = false } = {}) {
  const { experiment } = advice;
  const other = advice.default?.called || standard;
  // Panels may have their own knobs; several that have the same may speak of it.
  const knobs = new Set(advice.panels.map((one) => names.knob(experiment, one).text));
  const panel = knobs.size === 1 ? advice.panels[0] : "";
  const candidate = (choice, where = panel) => names.candidate(experiment, choice.series, choice.setting, where);
  const scenes = listed(advice.panels.map((one) => names.panel(experiment, one)));
  const bounds = listed(advice.bounds.map((bound) => boundWords(names, experiment, bound)));
  if (advice.missing) return { trouble: `${advice.missing}.` };
  const from = advice.default?.measured ? candidate(advice.default) : "";
  if (!advice.choice) {
    const nearest = advice.nearest
      ? `Nearest: ${candidate(advice.nearest)} with ${listed(advice.nearest.values.filter(({ value }) => value !== null).map(({ bound, value }) => `${names.metric(experiment, bound.metric).name} ${names.value(experiment, bound.metric, value)}`))}.`
      : "";
    const alone = advice.panels.length > 1 ? advice.alone.map((found) => `On ${names.panel(experiment, found.panel)} alone: ${candidate(found, found.panel)}.`) : [];
    const none = advice.panels.length > 1 && advice.without.length > 0 ? `Nothing reaches them on ${listed(advice.without.map((one) => names.panel(experiment, one)))}.` : "";
    return { bounds, scenes, default: from, trouble: [`No measured setting keeps all bounds (${bounds}) on ${advice.panels.length > 1 ? "all of " : ""}${scenes}.`, none, ...alone, nearest].filter(Boolean).join(" ") };
  }
  const gains = gainsOf(names, advice);
  const { almost } = advice;
  const almostWords = almost
    ? `Nearly: ${candidate(almost)}${almost.ratio ? `, ${ratioWords(names, advice, almost.ratio, other)}` : ""}, but for ${listed(almost.missing.map(({ bound, value }) => `${names.metric(experiment, bound.metric).name} ${names.value(experiment, bound.metric, value)}`))}.`
    : "";
  const breaks = advice.defaultBreaks.map((bound) => boundWords(names, experiment, bound));
  return { take: candidate(advice.choice), other, cost: costWords(names, advice, named && from ? `${other} (${from})` : other), gains: gains.map(({ words }) => words), gain: gains.find(({ better }) => better)?.better ?? "", almost: almostWords, scenes, bounds, default: advice.isDefault ? "" : from, breaks: advice.isDefault ? "" : listed(breaks) };
}

/** "costs 10 % more time than the default, measured with a margin of 0.05 m": of an entry that recommends nothing. */
export const priceText = ({ cost, take }) => `${/faster/.test(cost) ? "" : "costs "}${cost}, measured with ${take}`;
