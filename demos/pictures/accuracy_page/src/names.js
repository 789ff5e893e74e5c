// SPDX-License-Identifier: MIT
// Plain names for what tables name by keys.
import { plainNames } from "./plain_names.js";
import { figure, measured } from "./words.js";

const units = { m: "m", s: "s", ms: "ms", us: "\u00b5s", ns: "ns", deg: "degrees", rad: "rad", bytes: "bytes", j: "J", percent: "%" };

const statistics = { p95: "95 of 100 steps stay below", mean: "mean of all steps", last: "at the end", integral: "summed over time" };

/** A metric without an entry: its unit ends its name. */
function metricByKey(key) {
  const cut = key.lastIndexOf("_");
  const unit = cut > 0 ? units[key.slice(cut + 1).toLowerCase()] : undefined;
  return { name: (unit ? key.slice(0, cut) : key).replaceAll("_", " ").replace(".", ", "), unit: unit ?? "" };
}

const statisticOfNoun = { p95: "in 95 of 100 steps", mean: "on average", last: "at the end", integral: "over time" };

const isNumber = (text) => text !== "" && Number.isFinite(Number(text));

const words = { true: "on", false: "off" };

const valueText = (value) => (isNumber(value) ? figure(Number(value)) : words[value] ?? value);

/** "1 substep", "2 substeps"; "warm starting on". */
const knobText = ({ text, values }, value) => (value === "1" ? text.replace(/^(\{\} .*)s$/, "$1") : text).replace("{}", values?.[value] ?? valueText(value));

/** Of a knob that is a place in a scene's file: its values may be words. */
const knobOfPointer = (key) => (key.startsWith("/") ? { text: `${key} {}`, axis: key, words: true } : undefined);

/** `names` as in names.json: what holds in each experiment. */
export class Names {
  constructor(names = {}) {
    this.names = names;
  }

  find(experiment, kind, key) {
    return this.names.experiments?.[experiment.id]?.[kind]?.[key] ?? plainNames[kind]?.[key];
  }

  panel(experiment, key) {
    return this.find(experiment, "panels", key) ?? key;
  }

  series(experiment, key) {
    const found = this.find(experiment, "series", key);
    if (found !== undefined) return found;
    const parts = key.split(" ").map((part) => part.split("=")).map(([name, value]) => [plainNames.knobs[name] ?? knobOfPointer(name), value]);
    return parts.every(([knob, value]) => knob && value) ? parts.map(([knob, value]) => knobText(knob, value)).join(", ") : key;
  }

  /** {name, unit, noun}. */
  metric(experiment, key) {
    if (key === "cost") return { name: "time", noun: "time", unit: this.cost(experiment) };
    const [stem, statistic] = key.split(".");
    const base = this.find(experiment, "metrics", stem);
    const summed = base && statistics[statistic] ? { ...base, name: `${base.name}, ${statistics[statistic]}`, noun: `${base.noun ?? base.name} ${statisticOfNoun[statistic]}` } : undefined;
    const found = this.find(experiment, "metrics", key) ?? summed ?? metricByKey(key);
    return { unit: "", noun: found.name, ...found };
  }

  cost(experiment) {
    return (experiment.table?.costUnit ?? "").replace(/^us\b/, "\u00b5s");
  }

  /** "deepest contact, m", for axes. */
  metricLabel(experiment, key) {
    const { name, unit } = this.metric(experiment, key);
    return unit === "yes/no" ? `${name} (1: yes, 0: no)` : unit ? `${name}, ${unit}` : name;
  }

  value(experiment, key, value) {
    return measured(value, this.metric(experiment, key).unit);
  }

  /** {text: "{} iterations", axis: "solver iterations"} of what a setting is a value of. */
  knob(experiment, panel) {
    const key = experiment.knobs?.[panel] ?? experiment.knobs?.[""] ?? "";
    return this.find(experiment, "knobs", key) ?? knobOfPointer(key) ?? { text: key ? `${key} {}` : "{}", axis: key };
  }

  setting(experiment, setting, panel) {
    const named = this.find(experiment, "settings", setting);
    if (named !== undefined) return named;
    const knob = this.knob(experiment, panel);
    return isNumber(setting) || knob.words ? knobText(knob, setting) : setting;
  }

  /** A setting beside a point, where the axis says what it is: a number with a unit says enough. */
  shortSetting(experiment, { setting }) {
    const named = /^[-+.\de]+( \S+)?$/.test(setting) ? undefined : this.find(experiment, "settings", setting);
    return named ?? valueText(setting);
  }

  /** A candidate in words: "FCL, tolerance 1e-6". */
  candidate(experiment, series, setting, panel) {
    const parts = [this.series(experiment, series), setting && setting !== series ? this.setting(experiment, setting, panel) : ""];
    return parts.filter((part) => part !== "").join(", ");
  }
}
