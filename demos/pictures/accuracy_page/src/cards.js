// SPDX-License-Identifier: MIT
// The first screen: for each kind of user which settings to take and what they cost.
import { advise, advices } from "./advice.js";
import { element } from "./dom.js";
import { front } from "./front.js";
import { adviceWords, priceText } from "./sentences.js";

/** A line of advice, short: the section has all of it. */
function line(names, experiment, advice) {
  const words = adviceWords(names, advice, { named: true });
  const link = element("a", { href: `#${experiment.id}-advice` }, "evidence");
  if (words.trouble) return element("li", {}, element("span.for", {}, `${advice.purpose}: `), words.trouble, " ", link);
  return element(
    "li",
    {},
    element("span.for", {}, `${advice.purpose}: `),
    advice.isPrice ? [priceText(words), "."] : [element("b", {}, words.take), advice.isDefault ? ", the default." : `: ${[words.cost, words.gain].filter(Boolean).join(", ")}.`, words.almost ? ` ${words.almost}` : ""],
    element("span.holds", {}, ` Holds on ${words.scenes}. `),
    link,
  );
}

/** "S7": the first advice of an experiment that has a setting to take, without one the first; "S7#2": its second. */
function shown(experiments, wanted) {
  const [id, number] = wanted.split("#");
  const experiment = experiments.find((one) => one.id === id);
  if (!experiment?.table) return [];
  const all = advices(experiment);
  const advice = number ? all[number - 1] : all.find((one) => one.choice) ?? all[0];
  return advice ? [{ experiment, advice }] : [];
}

function card(names, experiments, user) {
  const found = user.experiments.flatMap((wanted) => shown(experiments, wanted));
  const [first, rest] = [found.slice(0, user.first ?? 2), found.slice(user.first ?? 2)];
  const lines = (some) => element("ul", {}, some.map(({ experiment, advice }) => line(names, experiment, advice)));
  return element("article.card", { id: `for-${user.id}` }, element("h3", {}, user.title), element("p.small", {}, user.what), lines(first), rest.length > 0 ? element("details", {}, element("summary", {}, `${rest.length} more`), lines(rest)) : null);
}

/** Cards of all users, of whose experiments any is on the page. */
export function cards(names, experiments) {
  const users = (names.names.users ?? []).filter((user) => user.experiments.some((wanted) => shown(experiments, wanted).length > 0));
  return users.length > 0 ? element("div.cards", {}, users.map((user) => card(names, experiments, user))) : null;
}

/** How to ask for a bound on a metric: {label, bounds()}. */
function question({ experiment, names }, metric, better, oninput) {
  const { name, unit } = names.metric(experiment, metric);
  if (unit === "yes/no") {
    const input = element("input", { type: "checkbox", "aria-label": name, oninput });
    return { label: element("label", {}, input, ` ${name}`), bounds: () => (input.checked ? [{ metric, at_least: 1 }] : []) };
  }
  const label = names.metricLabel(experiment, metric);
  const input = element("input", { type: "number", step: "any", "aria-label": label, oninput });
  const words = { high: "at least", low: "at most", zero: "up or down by at most" }[better];
  return { label: element("label", {}, `${label}, ${words} `, input), bounds: () => (input.value === "" ? [] : [{ metric, [better === "high" ? "at_least" : "at_most"]: Number(input.value) }]) };
}

/** The same experiment where metrics that are better near zero have no sign. */
function withoutSigns(experiment, betterOf) {
  const sized = (values) => Object.fromEntries(Object.entries(values).map(([metric, value]) => [metric, value !== null && betterOf(metric) === "zero" ? Math.abs(value) : value]));
  return { ...experiment, table: { ...experiment.table, points: experiment.table.points.map((point) => ({ ...point, values: sized(point.values) })) } };
}

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** What is to be known of metrics before anything is read off. */
const notes = ({ experiment, names }) => (experiment.notes ?? []).map(({ metric, text }) => element("p.small", {}, `${capital(names.metric(experiment, metric).name)} ${text}.`));

/** For a scene of one's own: bounds to type, and the cheapest setting within them. */
export function ownBounds(context) {
  const { experiment, names } = context;
  const { metrics } = experiment.table;
  if (metrics.length === 0) return element("div.card", {}, notes(context));
  const betterOf = (metric) => experiment.plots.find((spec) => spec.y === metric)?.better ?? "low";
  const answer = element("p.answer", { "aria-live": "polite" });
  const questions = metrics.map((metric) => question(context, metric, betterOf(metric), update));
  const [first] = metrics;
  function update() {
    const bounds = questions.flatMap((one) => one.bounds());
    if (bounds.length === 0) {
      const best = front(experiment.table.points, first, betterOf(first));
      const words = best.map((point) => `${names.candidate(experiment, point.series, point.setting, point.panel)} (${names.value(experiment, first, point.values[first])})`);
      answer.replaceChildren(words.length > 0 ? `Settings that no other beats in both time and ${names.metric(experiment, first).name}, the cheapest first: ${words.join("; ")}.` : "Every run failed; the table says why.");
      return;
    }
    const advice = advise(withoutSigns(experiment, betterOf), { for: "this scene", panel: "*", bounds, default: experiment.default });
    // Where no setting is that of the scene itself, the first measured takes the default's place, but not its name.
    const other = experiment.default.own ? "the default" : "the first measured";
    const words = adviceWords(names, advice, { other });
    answer.replaceChildren(...(words.trouble ? [words.trouble] : ["Take ", element("b", {}, words.take), `: ${[words.cost, ...words.gains].filter(Boolean).join(", ")}${words.default ? ` (compared with ${words.default}, ${other})` : ""}.`]));
  }
  update();
  return element("div.card", {}, element("h3", {}, "Which setting keeps your bounds?"), element("div.bounds", {}, questions.map(({ label }) => label)), answer, notes(context));
}
