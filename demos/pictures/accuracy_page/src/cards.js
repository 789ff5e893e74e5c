// SPDX-License-Identifier: MIT
// The first screen: for each kind of user which settings to take and what they cost.
import { advise, advices } from "./advice.js";
import { element } from "./dom.js";
import { front } from "./front.js";
import { adviceWords } from "./sentences.js";

/** A line of advice, short: the section has all of it. */
function line(names, experiment, advice) {
  const words = adviceWords(names, advice);
  const link = element("a", { href: `#${experiment.id}-advice` }, "evidence");
  if (words.trouble) return element("li", {}, element("span.for", {}, `${advice.purpose}: `), words.trouble, " ", link);
  return element(
    "li",
    {},
    element("span.for", {}, `${advice.purpose}: `),
    element("b", {}, words.take),
    advice.isDefault ? ", the default." : `: ${[words.default ? words.cost.replace("the default", `the default (${words.default})`) : words.cost, words.gain].filter(Boolean).join(", ")}.`,
    words.almost ? ` ${words.almost}` : "",
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

/** For a scene of one's own: bounds to type, and the cheapest setting within them. */
export function ownBounds(context) {
  const { experiment, names } = context;
  const { metrics } = experiment.table;
  const answer = element("p.answer", { "aria-live": "polite" });
  const inputs = metrics.map((metric) => element("input", { type: "number", step: "any", "aria-label": names.metricLabel(experiment, metric), oninput: update }));
  function update() {
    const bounds = metrics.flatMap((metric, i) => (inputs[i].value === "" ? [] : [{ metric, [names.metric(experiment, metric).better === "high" ? "at_least" : "at_most"]: Number(inputs[i].value) }]));
    if (bounds.length === 0) {
      const best = front(experiment.table.points, metrics[0], names.metric(experiment, metrics[0]).better);
      const words = best.map((point) => `${names.candidate(experiment, point.series, point.setting, point.panel)} (${names.value(experiment, metrics[0], valueOfFirst(point))})`);
      answer.replaceChildren(words.length > 0 ? `Settings that no other beats in both time and ${names.metric(experiment, metrics[0]).name}, the cheapest first: ${words.join("; ")}.` : "Every run failed; the table says why.");
      return;
    }
    const advice = advise(experiment, { for: "this scene", panel: "*", bounds, default: experiment.default });
    const words = adviceWords(names, advice);
    answer.replaceChildren(...(words.trouble ? [words.trouble] : ["Take ", element("b", {}, words.take), `: ${[words.cost, ...words.gains].filter(Boolean).join(", ")}${words.default ? ` (compared with ${words.default})` : ""}.`]));
  }
  const valueOfFirst = (point) => point.values[metrics[0]];
  update();
  return element("div.card", {}, element("h3", {}, "Which setting keeps your bounds?"), element("div.bounds", {}, metrics.map((metric, i) => element("label", {}, `${names.metricLabel(experiment, metric)}, ${names.metric(experiment, metric).better === "high" ? "at least" : "at most"} `, inputs[i]))), answer);
}
