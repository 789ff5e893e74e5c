// SPDX-License-Identifier: MIT
// Numbers that do not change with their knob: each is a finding or a mistake.
import { unique, valueOf } from "./data.js";

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
