// SPDX-License-Identifier: MIT
import { unique, valueOf } from "./data.js";
import { element, unfolding } from "./dom.js";
import { capital, listed, several } from "./words.js";

// Numbers that do not change with their knob: each is a finding or a mistake.

/** What differs by less, as a share, is the same: a knob that does more than that shows in three digits. */
const leastChange = 1e-3;

const same = (values) => Math.max(...values) - Math.min(...values) <= leastChange * Math.max(...values.map(Math.abs));

/** One name, a list, or "*" for all; without it all. */
const names = (wanted, name) => wanted === undefined || [wanted].flat().some((one) => one === "*" || one === name);

/** Series -> values of a metric at the settings that have one. */
function valuesOf(points, metric) {
  const known = points.filter((point) => !point.failure && valueOf(point, metric) !== null);
  return new Map(unique(known.map((point) => point.series)).map((series) => [series, known.filter((point) => point.series === series).map((point) => valueOf(point, metric))]));
}

/** Sentences about a whole panel name no series, those about series do. */
function sentence(experiment, metric, panel, series) {
  const concerns = (entry) => (series === null ? entry.series === undefined || entry.series === "*" : entry.series !== undefined && names(entry.series, series));
  return experiment.constant.find((entry) => entry.metric !== undefined && names(entry.metric, metric) && names(entry.panel, panel) && concerns(entry));
}

/** Nothing wrong where others go wrong is a finding that needs no reason. */
function faultless(experiment, plain, metric, value, others) {
  const { noun, better } = plain.metric(experiment, metric);
  const isFault = better !== "high" && experiment.table.points.every((point) => (valueOf(point, metric) ?? 0) >= 0);
  return value === 0 && isFault && others.some((other) => other > 0) ? `No ${noun} at any setting, where others have some.` : "";
}

/**
 * Metrics that have one value on a panel, whatever series and setting, or one at three settings or more of a series. Where
 * no series of the panel changes, two settings are enough: series may differ from each other.
 */
function still(experiment, plain, panel, metric) {
  const bySeries = valuesOf(experiment.table.points.filter((point) => point.panel === panel), metric);
  const several = [...bySeries.values()].filter((values) => values.length > 1);
  const finding = (series, value, others) => {
    const said = sentence(experiment, metric, panel, series);
    return { metric, panel, series, value, said, why: said?.why ?? (series === null ? "" : faultless(experiment, plain, metric, value, others)) };
  };
  const all = [...bySeries.values()].flat();
  if (several.length > 0 && same(all)) return [finding(null, null, [])];
  const least = several.every(same) ? 2 : 3;
  return [...bySeries].filter(([, values]) => values.length >= least && same(values)).map(([series, [value]]) => finding(series, value, all));
}

/** Series of knobs ("name=value") that have the same numbers, none of which can be so by chance: their knob does nothing there. */
function alike(experiment, panel) {
  const { metrics, points } = experiment.table;
  const own = points.filter((point) => point.panel === panel && !point.failure && point.series.includes("=") && metrics.some((metric) => !Number.isInteger(valueOf(point, metric) ?? 0)));
  const found = new Map();
  for (const setting of unique(own.map((point) => point.setting))) {
    const there = own.filter((point) => point.setting === setting);
    for (const first of there) {
      const group = there.filter((point) => metrics.every((metric) => valueOf(point, metric) === valueOf(first, metric))).map((point) => point.series);
      const key = JSON.stringify(group);
      if (group.length > 1 && group[0] === first.series) found.set(key, [...(found.get(key) ?? []), setting]);
    }
  }
  return [...found].map(([key, settings]) => {
    const group = JSON.parse(key);
    const said = experiment.constant.find((entry) => entry.alike !== undefined && group.every((series) => entry.alike.includes(series)) && names(entry.panel, panel));
    return { panel, alike: group, settings, said, why: said?.why ?? "" };
  });
}

/**
 * [{metric, panel, series, value, said, why}] of metrics, where `series` is null for all of a panel, and [{panel, alike: [series],
 * settings, said, why}]. `said` is the experiment's sentence; `why` is empty where there is none. `plain` are Names.
 */
export function constants(experiment, plain) {
  if (!experiment.table) return [];
  const { metrics, panels } = experiment.table;
  return panels.flatMap((panel) => [...metrics.flatMap((metric) => still(experiment, plain, panel, metric)), ...alike(experiment, panel)]);
}

// What does not change with its knob, on the page: each finding once, with where it holds.

const grouped = (all, key) => unique(all.map(key)).map((one) => all.filter((item) => key(item) === one));

/** Names of panels may have commas. */
const panelsOf = ({ experiment, names }, found) => unique(found.map(({ panel }) => names.panel(experiment, panel))).join("; ");

/** "A and B on wall (0.3)", for findings about one metric. */
function placesOf(context, found) {
  const { experiment, names } = context;
  if (found[0].series === null) return panelsOf(context, found);
  const value = ({ metric, value }) => (value === 0 ? "" : ` (${names.value(experiment, metric, value)})`);
  const ofSeries = grouped(found, ({ series, value }) => JSON.stringify([series, value])).map((same) => ({ series: names.series(experiment, same[0].series), rest: ` on ${panelsOf(context, same)}${value(same[0])}` }));
  return grouped(ofSeries, ({ rest }) => rest).map((same) => `${listed(same.map(({ series }) => series))}${same[0].rest}`).join(". ");
}

/** {what, where} of findings that have the same sentence. */
export function constantWords(context, found) {
  const { experiment, names } = context;
  const [{ alike, settings, panel }] = found;
  if (alike) return { what: listed(alike.map((series) => names.series(experiment, series))), where: `the same numbers at ${listed(settings.map((setting) => names.setting(experiment, setting, panel)))} on ${panelsOf(context, found)}` };
  const metrics = grouped(found, ({ metric }) => metric);
  const name = (same) => names.metric(experiment, same[0].metric).name;
  const places = grouped(metrics.map((same) => ({ name: name(same), places: placesOf(context, same) })), ({ places }) => places);
  return { what: listed(metrics.map(name)), where: places.map((same) => `${places.length > 1 ? `${listed(same.map((one) => one.name))}: ` : ""}${same[0].places}`).join(". ") };
}

/** Findings of one sentence are together; those that need no reason come last. */
export const constantGroups = (experiment, names) => {
  const groups = grouped(constants(experiment, names), ({ why, series, alike }) => JSON.stringify([why, series === null, alike]));
  return [...groups.filter(([{ said, why }]) => said || !why), ...groups.filter(([{ said, why }]) => !said && why)];
};

export function constantList(context) {
  const groups = constantGroups(context.experiment, context.names);
  if (groups.length === 0) return null;
  const item = (found) => {
    const { what, where } = constantWords(context, found);
    return element("li", {}, element("b", {}, capital(what)), ": ", found[0].why || (context.experiment.id === "scene" ? "the settings do not matter for it here." : "nobody has said yet whether this is a finding or a mistake."), " ", element("span.small", {}, `Where: ${where}.`));
  };
  return unfolding(`What does not change with the setting, to a thousandth: ${several(groups.length, "finding")}`, () => element("ul", {}, groups.map(item)));
}
