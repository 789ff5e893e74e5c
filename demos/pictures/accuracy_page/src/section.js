// SPDX-License-Identifier: MIT
// An experiment on the page: question, advice, plots, criteria, what does not change, numbers, and how to get them again.
import { advices } from "./advice.js";
import { constantList } from "./constants.js";
import { limitOfTwins, unique, verdicts, wide } from "./data.js";
import { element, saveButton, tableOf, unfolding } from "./dom.js";
import { csvOf, curvesCsv, drawing, pointsTable } from "./figures.js";
import { criticalDifference, hypervolumes, ranks } from "./front.js";
import { panelsOf, specsOf } from "./plots.js";
import { adviceWords, capital, figure, listed, percent, priceText, several } from "./words.js";

export const pointId = (experiment, point) => `${experiment.id}-point-${point.number + 1}`;

/** What is said of a setting to take, or of one whose price is told. */
function adviceText(words, advice) {
  const besides = words.default ? ` (${words.other.replace(/^the /, "")}: ${words.default})` : "";
  if (advice.isPrice) return [priceText(words), `${besides}. `];
  return ["take ", element("b", {}, words.take), advice.isDefault ? `, ${words.other}. ` : `: ${[words.cost, ...words.gains].filter(Boolean).join(", ")}${besides}. `, words.almost ? `${words.almost} ` : "", words.breaks ? `${capital(words.other)} breaks a bound: ${words.breaks}. ` : ""];
}

/** Settings to take, and apart from them what is a price only. */
function adviceList({ experiment, names }) {
  const item = (advice) => {
    const words = adviceWords(names, advice);
    const purpose = element("span.for", {}, `${advice.purpose}: `);
    if (words.trouble) return element("li", {}, purpose, words.trouble);
    return element("li", {}, purpose, adviceText(words, advice), element("span.holds", {}, `Bounds: ${words.bounds}. Holds on ${words.scenes}.`), advice.note ? ` ${advice.note}` : "");
  };
  const all = advices(experiment);
  const list = (title, some) => (some.length > 0 ? [element("h3", {}, title), element("ul.advice", {}, some.map(item))] : []);
  const isPrice = (advice) => advice.isPrice;
  return all.length > 0 ? element("div", { id: `${experiment.id}-advice` }, list("Which setting to take", all.filter((advice) => !isPrice(advice))), list("What it costs", all.filter(isPrice))) : null;
}

/** A link to the row of a point. */
function pointLink({ experiment, names }, point, metric) {
  const value = point.failure || `${names.metric(experiment, metric).name} ${names.value(experiment, metric, metric === "cost" ? point.cost : point.values[metric])}`;
  return element("a", { href: `#${pointId(experiment, point)}` }, `${names.panel(experiment, point.panel)}, ${names.candidate(experiment, point.series, point.setting, point.panel)}: ${value}`);
}

const sentence = (text) => (text === "" || /[.!?]$/.test(text) ? text : `${text}.`);

/** A broken criterion with what it means and a point that breaks it; `named` says whose it is. */
export function brokenCriterion(context, verdict, named = false) {
  const { experiment } = context;
  const { broken, points } = verdict;
  return element(
    "li",
    {},
    element("b.bad", {}, "Broken: "),
    sentence(verdict.text),
    " ",
    element("span.means", {}, verdict.means),
    verdict.limit && !named ? ` A limit of ${verdict.limit}.` : "",
    " ",
    element("span.small", {}, `By ${figure(broken.length)} of ${several(points, "point")}${broken.length > 1 ? ", the first" : ""}: `, pointLink(context, broken[0], verdict.metric), "."),
    named ? element("span.small", {}, " ", element("a", { href: `#${experiment.id}` }, experiment.question || experiment.title)) : null,
  );
}

function criteria(context) {
  const all = verdicts(context.experiment);
  if (all.length === 0) return null;
  const labels = { kept: "Kept: ", "not comparable": "Not comparable: ", "not measured": "Not measured: " };
  const more = { kept: ({ points, kept }) => ` (${several(points, "point")}) ${kept ?? ""}`, "not comparable": ({ without }) => ` ${without}`, "not measured": () => "" };
  const items = all.map((verdict) =>
    verdict.state === "broken" ? brokenCriterion(context, verdict) : element("li", {}, element(`b.${verdict.state === "kept" ? "good" : "plain"}`, {}, labels[verdict.state]), sentence(verdict.text), more[verdict.state](verdict)),
  );
  return element("div", {}, element("h3", {}, "What has to hold"), element("ul.criteria", {}, items));
}

function twins({ experiment, names }) {
  const known = experiment.table.controls.filter(([, spread]) => spread !== null);
  if (experiment.table.controls.length === 0) return null;
  if (known.length === 0) return element("p.small", {}, "The candidate that was measured twice failed, so the noise of times is not known.");
  const loud = known.some(([, spread]) => spread > limitOfTwins);
  const text = `Two series of the same candidate differ by ${listed(known.map(([panel, spread]) => `${percent(spread)}${panel ? ` (${names.panel(experiment, panel)})` : ""}`))}.`;
  const { points } = experiment.table;
  const intervals = wide(points).length > 0 ? ` Times of ${figure(wide(points).length)} of ${several(points.length, "point")} have an interval wider than \u00b1 ${percent(limitOfTwins)}.` : "";
  return element(`p.small${loud ? ".noisy" : ""}`, {}, loud ? element("b", {}, "Times are noisy. ") : "", text, loud ? " Differences of time of this size mean nothing; instructions, where they were counted, have no noise." : "", intervals);
}

/** How much of the plane of cost and error the front of each series reaches, where there is more than one. */
function volumes({ experiment, names }, spec) {
  const { table } = experiment;
  const series = unique(table.points.map((point) => point.series));
  const byPanel = new Map(panelsOf(experiment, spec).map((panel) => [panel, hypervolumes(table.points.filter((point) => point.panel === panel), spec.y, spec.better)]).filter(([, found]) => found.size === series.length));
  if (series.length < 2 || byPanel.size === 0) return null;
  const ranked = new Map([...byPanel].map(([panel, found]) => [panel, ranks(found)]));
  const mean = (name) => [...ranked.values()].reduce((sum, found) => sum + found.get(name), 0) / ranked.size;
  const difference = criticalDifference(series.length, byPanel.size);
  const { name } = names.metric(experiment, spec.y);
  return unfolding(`How much of time and ${name} each candidate reaches (hypervolume, ranks)`, () => [
    element("p.small", {}, `Part of the plane, scaled to what was measured on each scene, that the front of a candidate reaches; 1 is all of it. In brackets its rank.${difference ? ` Mean ranks nearer than ${difference.toFixed(2)} are not significantly different (Nemenyi, 5 %).` : ""}`),
    tableOf(
      ["candidate", ...[...byPanel.keys()].map((panel) => ({ text: names.panel(experiment, panel), number: true })), { text: "mean rank", number: true }],
      [...series].sort((a, b) => mean(a) - mean(b)).map((one) => [names.series(experiment, one), ...[...byPanel].map(([panel, found]) => ({ text: `${found.get(one).toFixed(3)} (${figure(ranked.get(panel).get(one))})`, number: true })), { text: mean(one).toFixed(2), number: true }]),
    ),
  ]);
}

/** Instructions of the small sizes, which are points of their own, beside the fewest of their scene. */
function countsTable({ experiment, names }) {
  const facts = experiment.countsFacts;
  if (!facts) return null;
  const counts = [...experiment.counts].map(([key, count]) => [...JSON.parse(key), count]);
  const fewest = (panel) => Math.min(...counts.filter(([where]) => where === panel).map((row) => row[3]));
  return unfolding(`Instructions of the small sizes: ${several(counts.length, "point")}`, () => [
    element("p.small", {}, `Counted by callgrind (${(facts.date ?? "?").slice(0, 10)}, commit ${facts.commit ?? "?"}). They have no noise, and compare candidates with each other, not with the times above, which are of whole sizes.`),
    tableOf(
      ["scene", "candidate", { text: "instructions", number: true }, { text: "beside the fewest", number: true }],
      counts.map(([panel, series, setting, count]) => [names.panel(experiment, panel), names.candidate(experiment, series, setting, panel), { text: figure(count), number: true }, { text: `${figure(count / fewest(panel))} \u00d7`, number: true }]),
    ),
  ]);
}

function origin({ experiment }) {
  const { facts } = experiment.table;
  const machine = ["cpu", "compiler", "flags", "simd"].map((name) => facts[name]).filter(Boolean).join(", ");
  // Who made a page of an own scene has no commit, but a release.
  const what = [facts.version && `boxstream ${facts.version}`, experiment.id !== "scene" && `commit ${facts.commit || "unknown"}`].filter(Boolean).join(", ");
  const busy = facts.others ? `; other processes kept ${facts.others} processors busy` : "";
  return element("p.small", {}, `${machine}; ${what}; ${facts.date ?? "?"}; ${facts.repeats ?? "?"} timed runs of each${facts.load ? `; load ${facts.load}` : ""}${busy}.${experiment.fresh === false ? " These are the stored figures, not of a run here." : ""}`);
}

function numbers(context) {
  const { experiment } = context;
  const { metrics, points } = experiment.table;
  return unfolding(`All numbers: ${several(points.length, "point")}`, () => pointsTable(context, points, metrics, (point) => pointId(experiment, point)), { id: `${experiment.id}-numbers` });
}

function saves(context) {
  const { experiment } = context;
  return element("p", {}, element("code", {}, experiment.table.facts.command ?? "?"), " makes it again. ", saveButton("CSV", `${experiment.id}.csv`, () => csvOf(experiment, experiment.table.metrics), "text/csv"), " ", experiment.curves.length > 0 ? saveButton("CSV of curves", `${experiment.id}.curves.csv`, () => curvesCsv(experiment), "text/csv") : null);
}

/** Pictures of the scenes that the experiment has. */
function pictures({ experiment, names, pictureOf }) {
  const found = unique(experiment.table.panels.map((panel) => pictureOf(panel)).filter(Boolean));
  const caption = (picture) => unique(experiment.table.panels.filter((panel) => pictureOf(panel) === picture).map((panel) => names.panel(experiment, panel))).join("; ");
  return found.length > 0 ? element("div.scenes", {}, found.map((picture) => element("figure", {}, element("img", { src: picture, alt: "", width: 240, height: 120, decoding: "async" }), element("figcaption", {}, caption(picture))))) : null;
}

/** All of an experiment but its question. */
function contents(context) {
  const { experiment } = context;
  const source = experiment.source ? unfolding("Where scene and criteria come from", () => element("p", {}, experiment.source)) : null;
  if (!experiment.table) return [element("p", {}, "Not measured here yet: ", element("code", {}, `./dev report ${experiment.id}`)), source];
  const specs = specsOf(experiment);
  const plots = specs.map((spec, i) => drawing(context, spec, `${experiment.id}-${i + 1}-${spec.kind}`));
  const fronts = specs.filter((spec) => spec.kind === "front" && experiment.table.metrics.includes(spec.y)).map((spec) => volumes(context, spec));
  return [pictures(context), adviceList(context), plots, criteria(context), constantList(context), fronts, numbers(context), twins(context), countsTable(context), saves(context), origin(context), source];
}

/** The answer in a line: what to take and what that costs. */
function answer({ experiment, names }) {
  if (!experiment.table) return "not measured here yet";
  const advice = advices(experiment).find((one) => one.choice);
  const broken = verdicts(experiment).filter((verdict) => verdict.state === "broken").length;
  if (!advice) return broken === 0 && experiment.expect.length > 0 ? "all that has to hold holds" : experiment.title;
  const words = adviceWords(names, advice, { named: true });
  return advice.isPrice ? priceText(words) : `${words.take}: ${[advice.isDefault ? words.other : words.cost, words.gain].filter(Boolean).join(", ")}`;
}

/** The page of one scene has its only experiment open. */
export const openSection = (context) => element("section", { id: context.experiment.id }, element("h2", {}, context.experiment.question || context.experiment.title), contents(context));

/** A question with its answer in a line; all else is made when it is opened. */
export function section(context) {
  const { experiment } = context;
  const day = (experiment.table?.facts.date ?? "").slice(0, 10);
  const summary = [element("h3", {}, experiment.question || experiment.title), element("span.answered", {}, answer(context)), element("span.small", {}, [experiment.id, day].filter(Boolean).join(", "))];
  return unfolding(summary, () => [element("p.small", {}, experiment.title), ...contents(context)], { id: experiment.id, class: "question" });
}
