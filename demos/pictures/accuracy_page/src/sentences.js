// SPDX-License-Identifier: MIT
// Advice in words.
import { limitOfTwins, noise } from "./data.js";
import { errorWords, figure, listed, measured, timesWords } from "./words.js";

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
