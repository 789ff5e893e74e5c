// SPDX-License-Identifier: MIT
// What does not change with its knob, on the page: each finding once, with where it holds.
import { constants } from "./constants.js";
import { unique } from "./data.js";
import { element, unfolding } from "./dom.js";
import { listed, several } from "./words.js";

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
    return element("li", {}, element("b", {}, what.charAt(0).toUpperCase() + what.slice(1)), ": ", found[0].why || (context.experiment.id === "scene" ? "the settings do not matter for it here." : "nobody has said yet whether this is a finding or a mistake."), " ", element("span.small", {}, `Where: ${where}.`));
  };
  return unfolding(`What does not change with the setting, to a thousandth: ${several(groups.length, "finding")}`, () => element("ul", {}, groups.map(item)));
}
