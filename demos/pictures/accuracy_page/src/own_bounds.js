// SPDX-License-Identifier: MIT
// For a scene of one's own: bounds to type, and the cheapest setting within them.
import { advise } from "./advice.js";
import { element } from "./dom.js";
import { adviceWords, capital } from "./words.js";

/** How to ask for a bound on a metric: {label, bounds()}. */
function question({ experiment, names }, metric, better, bound, oninput) {
  const { name, unit } = names.metric(experiment, metric);
  if (unit === "yes/no") {
    const input = element("input", { type: "checkbox", "aria-label": name, oninput });
    return { label: element("label", {}, input, ` ${name}`), bounds: () => (input.checked ? [{ metric, at_least: 1 }] : []) };
  }
  const label = names.metricLabel(experiment, metric);
  const input = element("input", { type: "number", step: "any", "aria-label": label, value: bound ?? "", oninput });
  const words = { high: "at least", low: "at most", zero: "up or down by at most", reference: "off by at most" }[better];
  return { label: element("label", {}, `${label}, ${words} `, input), bounds: () => (input.value === "" ? [] : [{ metric, [better === "high" ? "at_least" : "at_most"]: Number(input.value) }]) };
}

/** The same experiment with errors in the place of values: how far off, or how far from zero. */
function withErrors(experiment, plotOf) {
  const erring = ({ number, values }) => Object.fromEntries(Object.keys(values).map((metric) => [metric, plotOf(metric).errors[number][0]]));
  return { ...experiment, table: { ...experiment.table, points: experiment.table.points.map((point) => ({ ...point, values: erring(point) })) } };
}

/** What the runs say, as the tool's table has it, but for what legends of plots say. */
const findings = ({ experiment }) => element("dl.findings", {}, experiment.findings.filter(([word]) => !/^(order$|at )/.test(word)).map(([word, text]) => [element("dt", {}, word), element("dd", {}, text)]));

/** What is to be known of metrics before anything is read off. */
const notes = ({ experiment, names }) => (experiment.notes ?? []).map(({ metric, text }) => element("p.small", {}, `${capital(names.metric(experiment, metric).name)} ${text}.`));

export function ownBounds(context) {
  const { experiment, names } = context;
  const { metrics } = experiment.table;
  if (metrics.length === 0) return element("div.card", {}, notes(context));
  const plotOf = (metric) => experiment.plots.find((spec) => spec.y === metric);
  const betterOf = (metric) => (plotOf(metric).off ? "reference" : plotOf(metric).better);
  const answer = element("p.answer", { "aria-live": "polite" });
  const questions = metrics.map((metric) => question(context, metric, betterOf(metric), plotOf(metric).bound, update));
  const [first] = metrics;
  function update() {
    const bounds = questions.flatMap((one) => one.bounds());
    if (bounds.length === 0) {
      const best = plotOf(first).front.map((number) => experiment.table.points[number]);
      const words = best.map((point) => `${names.candidate(experiment, point.series, point.setting, point.panel)} (${names.value(experiment, first, plotOf(first).errors[point.number][0])})`);
      answer.replaceChildren(words.length > 0 ? `Sound settings that no other beats in both time and ${names.metric(experiment, first).name}, the cheapest first: ${words.join("; ")}.` : "No setting that was tried is sound; the table says why.");
      return;
    }
    const advice = advise(withErrors(experiment, plotOf), { for: "this scene", panel: "*", bounds, default: experiment.default });
    // Where no setting is that of the scene itself, the first measured takes the default's place, but not its name.
    const other = experiment.default.own ? "the default" : "the first measured";
    const words = adviceWords(names, advice, { other });
    const { points } = experiment.table;
    const unsound = points.every(({ failure }) => failure) ? ` None is sound: ${names.candidate(experiment, points.at(-1).series, points.at(-1).setting, points.at(-1).panel)} ${points.at(-1).failure.replace(/^not sound: /, "")}.` : "";
    answer.replaceChildren(...(words.trouble ? [words.trouble, unsound] : ["Take ", element("b", {}, words.take), `: ${[words.cost, ...words.gains].filter(Boolean).join(", ")}${words.default ? ` (compared with ${words.default}, ${other})` : ""}.`]));
  }
  update();
  return element("div.card", {}, findings(context), element("h3", {}, "Which setting keeps your bounds?"), element("div.bounds", {}, questions.map(({ label }) => label)), answer, notes(context));
}
