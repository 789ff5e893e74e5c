// SPDX-License-Identifier: MIT
// Makes the page of the data in it.
import { cards } from "./cards.js";
import { rightAt } from "./precision.js";
import { styles } from "./colours.js";
import { themeButton } from "./theme.js";
import { experimentOf, limitOfTwins, noise, unique, verdicts, wide } from "./data.js";
import { element, escaped, saveButton, tableOf, unfolding } from "./dom.js";
import { effectWithKey } from "./plain_names.js";
import { figureOf } from "./figures.js";
import { Names } from "./names.js";
import { pricesPlot } from "./plots.js";
import { ownBounds } from "./own_bounds.js";
import { brokenCriterion, openSection, section } from "./section.js";
import { figure, listed, percent, several } from "./words.js";

const data = JSON.parse(document.getElementById("data").textContent);
const names = new Names(data.names);
const experiments = data.experiments.map(experimentOf);
const measured = experiments.filter((experiment) => experiment.table);

const seriesNames = (experiment) => unique(experiment.table.points.map((point) => names.series(experiment, point.series)));
const looks = styles(measured.map(seriesNames));

const plain = (name) => name.toLowerCase().replaceAll(/[^a-z0-9]+/g, "_");

/** The picture of the scene that a panel names: the longest name in it. */
function pictureOf(panel) {
  const found = Object.keys(data.pictures ?? {}).filter((name) => plain(panel).includes(plain(name).replace("broadmark_", ""))).sort((a, b) => b.length - a.length)[0];
  return found && data.pictures[found];
}

const contextOf = (experiment) => ({
  experiment,
  names,
  pictureOf,
  style: (series) => looks.get(names.series(experiment, series)),
  points: (panel) => experiment.table.points.filter((point) => point.panel === panel),
});

/** Where and when it was measured. */
function origin() {
  const facts = measured.map(({ table }) => table.facts);
  const days = unique(facts.map(({ date }) => (date ?? "?").slice(0, 10))).sort();
  const machines = unique(facts.map(({ cpu, threads, compiler }) => [cpu ?? "?", threads && several(Number(threads), "thread"), compiler].filter(Boolean).join(", ")));
  return measured.length > 0 ? `${listed(machines)}, ${days.length > 1 ? `${days[0]} to ${days.at(-1)}` : days[0]}` : "";
}

/** What the page is about, for somebody who comes from elsewhere. */
function about() {
  if (data.kind === "scene") return element("p.small", {}, `Measured on ${origin()}.`);
  return [
    element("p", {}, element("b", {}, "boxstream"), " finds which boxes overlap, the first step of finding collisions, for ", element("b", {}, "Bullet"), ", which simulates bodies, and ", element("b", {}, "FCL"), ", which robots ask about shapes. What do right answers cost, and which setting is enough?"),
    element("p.small", {}, `Measured on ${origin()}. Plots: error over time; dashed: the bound; \u25cb the cheapest setting within all bounds, \u25a1 the default.`),
  ];
}

/** How sure the numbers are. */
function state() {
  const points = measured.flatMap((experiment) => experiment.table.points);
  const judged = measured.flatMap(verdicts);
  const count = (wanted) => judged.filter((verdict) => verdict.state === wanted).length;
  const loud = measured.filter((experiment) => noise(experiment) > limitOfTwins).map((experiment) => experiment.id);
  const criteria = judged.length > 0 ? `${count("kept")} of ${judged.length} criteria hold, ${count("broken")} do not${["not comparable", "not measured"].map((wanted) => (count(wanted) > 0 ? `, ${count(wanted)} are ${wanted}` : "")).join("")}. ` : "";
  const failed = points.filter((point) => point.failure).length;
  return element(
    "p.small",
    { id: "state" },
    data.kind === "scene" ? "" : `${measured.length} of ${several(experiments.length, "experiment")} measured. `,
    `${several(points.length, "point")}, ${failed === 0 ? "none" : figure(failed)} of them ${data.kind === "scene" ? "failed or not sound" : "failed"}. ${criteria}`,
    wide(points).length > 0 ? `Times of ${several(wide(points).length, "point")} have an interval wider than \u00b1 ${percent(limitOfTwins)}. ` : "",
    loud.length > 0 ? `Times are noisy (two series of the same candidate differ by more than 3 %)${data.kind === "scene" ? "" : ` in ${loud.length > 8 ? `${loud.length} experiments` : loud.join(", ")}`}.` : "",
  );
}

function smokeWarning() {
  const small = measured.filter(({ table }) => (table.facts.command ?? "").includes("--smoke")).map((experiment) => experiment.id);
  if (small.length === 0) return null;
  return element("p.warning", {}, `Smoke run${small.length < experiments.length ? ` (${small.join(", ")})` : ""}: a few points of small sizes, to see that all works. Decide nothing by it.`);
}

/** All broken criteria by whose limit they are, each with what it means. */
function brokenList() {
  const broken = measured.flatMap((experiment) => verdicts(experiment).filter((verdict) => verdict.state === "broken").map((verdict) => ({ experiment, verdict })));
  if (broken.length === 0) return null;
  const limits = unique(broken.map(({ verdict }) => verdict.limit || "not known")).map((limit) => ({ limit, own: broken.filter(({ verdict }) => (verdict.limit || "not known") === limit) })).sort((a, b) => b.own.length - a.own.length);
  const counts = limits.map(({ limit, own }) => `${figure(own.length)} by ${limit}`).join("; ");
  const ours = limits.some(({ limit }) => limit === "boxstream") ? "" : "; none by boxstream";
  const list = () => limits.map(({ limit, own }) => [element("h4", {}, `Broken by ${limit}`), element("ul.criteria", {}, own.map(({ experiment, verdict }) => brokenCriterion(contextOf(experiment), verdict, true)))]);
  return unfolding(`What does not hold: ${several(broken.length, "criterion").replace("criterions", "criteria")}, broken ${counts}${ours}`, list, { id: "broken" });
}

/** Groups of experiments, in the order of the page; those that no group names come last. */
function groups() {
  const known = data.names.groups ?? [];
  const rest = experiments.filter(({ id }) => !known.some((group) => group.experiments.includes(id)));
  return [...known.map((group) => ({ ...group, own: group.experiments.flatMap((id) => experiments.find((one) => one.id === id) ?? []) })), { title: "Others", own: rest }].filter(({ own, parts }) => own.length > 0 || (parts ?? []).some((part) => chapters[part]?.()));
}

const chapters = { "closed-forms": closedFormsSection, witnesses: witnessesSection, prices: pricesSection };

/** All questions, each with its answer in a line; the rest opens. */
function questions() {
  return element(
    "div",
    { id: "questions" },
    element("h2", {}, "All questions"),
    element("p.small", {}, "Each opens: its scenes, advice, plots, what has to hold, and all numbers."),
    groups().map(({ title, about: said, parts = [], own }) => element("section.group", {}, element("h3", {}, title), said ? element("p.small", {}, said) : null, parts.map((part) => chapters[part]?.()), own.map((experiment) => section(contextOf(experiment))))),
  );
}

function pricesSection() {
  if (!data.prices) return null;
  const head = ["effect", "ns per body and step (least to greatest round)", "instructions per body and step", "ns where nothing calls for it", "instructions where nothing calls for it", "bytes per body", "pairs per body"];
  const text = ({ ns_per_body_step: price, interval_ns: [low, high] }) => (low <= 0 && high >= 0 ? `within noise: ${figure(low)} to ${figure(high)}` : `${figure(price)} (${figure(low)} to ${figure(high)})`);
  const effects = Object.entries(data.prices.effects).sort((a, b) => b[1].ns_per_body_step - a[1].ns_per_body_step);
  const rows = effects.map(([name, price]) => [effectWithKey(name), ...[text(price), ...["instructions_per_body_step", "uncalled_ns_per_body_step", "uncalled_instructions_per_body_step", "bytes_per_body", "pairs_per_body"].map((key) => figure(price[key]))].map((cell) => ({ text: cell, number: true }))]);
  const summary = [element("h3", {}, "What does it cost to switch an effect on?"), element("span.answered", {}, `${several(effects.length, "effect")}, from nothing to ${figure(effects[0][1].ns_per_body_step, 2)} ns per body and step (${effectWithKey(effects[0][0])})`)];
  return unfolding(
    summary,
    () => [
      figureOf({ names }, pricesPlot(data.prices, escaped), "prices-plot"),
      unfolding(`Numbers: ${several(effects.length, "effect")}`, () => tableOf(head, rows)),
      element("p", {}, element("code", {}, "./dev prices"), " makes it again. ", saveButton("JSON", "prices.json", () => JSON.stringify(data.prices, null, 2), "application/json")),
      element("p.small", {}, data.prices.machine ?? ""),
    ],
    { id: "prices", class: "question" },
  );
}

/** Worlds of which it is known what must come of them. */
function closedFormsSection() {
  if (!data.closedForms) return null;
  const cases = Object.entries(data.closedForms);
  const share = (error) => (error === null ? "nothing" : percent(error));
  const { byDefault, never } = rightAt(data.closedForms);
  const head = ["case", "world", "truth", "formula", "source", "default", "error", "cheapest setting that gets it right", "there", "error", "time, over the default"];
  const rows = cases.map(([name, known]) => {
    const cells = [known.default, known.error, known.value, known.setting_error, known.price];
    const [value, error, there, left, price] = cells.map((cell, i) => ({ text: i === 1 || i === 3 ? share(cell) : cell === null ? "nothing" : figure(cell), number: true }));
    return [name, known.about, { text: `${figure(known.truth)} ${known.unit}`, number: true }, known.formula, known.source, value, error, known.within ? known.setting : `none; nearest: ${known.setting}`, there, left, price];
  });
  const summary = [element("h3", {}, "Is it what the textbook says?"), element("span.answered", {}, `${byDefault} of ${several(cases.length, "world")} with a closed form are right at default settings, ${cases.length - byDefault - never} at another one, ${never} at none that was tried`)];
  return unfolding(
    summary,
    () => [
      element("p", {}, "Right is what is within a hundredth of the truth, or within what is said."),
      tableOf(head, rows),
      element("p", {}, element("code", {}, "tests/lab/scenes/closed_forms.py"), " makes it again; docs/internals/closed-forms.md says how to read it."),
    ],
    { id: "closed-forms", class: "question" },
  );
}

/** Worlds that engines of others run as well. */
function witnessesSection() {
  if (!data.witnesses) return null;
  const cases = Object.entries(data.witnesses);
  const share = (difference) => ({ text: difference === null ? "nothing" : percent(difference), number: true });
  const agrees = ({ setting, within }) => within && setting === "default";
  const byDefault = cases.filter(([, one]) => agrees(one)).length;
  const never = cases.filter(([, one]) => !one.within).length;
  const head = ["world", "what happens", "compared", "witness", "changes by, at a coarser step", "ours at default settings differs by", "cheapest setting that agrees", "differs by", "time, over the default", "what differs"];
  const rows = cases.map(([name, one]) => [name, one.about, one.compared, one.witness === "ode" ? "ODE" : "Simbody", share(one.witness_change), share(one.difference), one.within ? one.setting : `none; nearest: ${one.setting}`, share(one.setting_difference), { text: figure(one.price), number: true }, one.why]);
  const summary = [element("h3", {}, "Do other engines say the same?"), element("span.answered", {}, `${byDefault} of ${several(cases.length, "world")} agree at default settings with Simbody or ODE, ${cases.length - byDefault - never} at another one, ${never} at none that was tried`)];
  return unfolding(
    summary,
    () => [
      element("p", {}, "To agree is to differ by a hundredth or less. No formula says what comes of these worlds; Simbody (joints, free motion) and the Open Dynamics Engine (contacts) run the same files."),
      tableOf(head, rows),
      element("p", {}, element("code", {}, "tests/lab/scenes/witnesses.py"), " makes it again; docs/internals/witnesses.md says how to read it, and how good the witnesses are."),
    ],
    { id: "witnesses", class: "question" },
  );
}

function summary() {
  const own = data.kind === "scene" && measured.length > 0 ? ownBounds(contextOf(measured[0])) : null;
  const head = element("div.row", {}, element("h1", {}, data.title), themeButton());
  return element("header", { id: "summary" }, head, data.lead ? element("p", {}, data.lead) : null, about(), smokeWarning(), own ?? cards(names, experiments, contextOf, data.closedForms), brokenList(), state());
}

/** Opens all that a place is in, and makes what is in it. */
function open(place) {
  for (let around = place?.closest("details"); around; around = around.parentElement.closest("details")) around.reveal?.();
}

/** Goes to what the address names. Sections are made first, and rows of tables. */
function follow() {
  const id = decodeURIComponent(location.hash.slice(1));
  const holder = experiments.map((one) => one.id).filter((one) => id === one || id.startsWith(`${one}-`)).map((one) => document.getElementById(one))[0];
  (holder ?? document.getElementById(id))?.reveal?.();
  const [, experiment] = /^(.*)-point-\d+$/.exec(id) ?? [];
  if (experiment) document.getElementById(`${experiment}-numbers`)?.reveal();
  for (const marked of document.querySelectorAll("tr.marked")) marked.classList.remove("marked");
  const target = id && document.getElementById(id);
  open(target);
  if (target?.tagName === "TR") target.classList.add("marked");
  target?.scrollIntoView({ block: target.tagName === "TR" ? "center" : "start" });
}

document.title = data.title;
const main = element("main", {}, summary(), data.kind === "scene" ? measured.map((experiment) => openSection(contextOf(experiment))) : questions());
document.body.append(main);
addEventListener("hashchange", follow);
// A link to where one is already has no change of the address.
addEventListener("click", ({ target }) => target.closest?.("a[href^='#']")?.hash === location.hash && follow());
if (location.hash) follow();
document.body.dataset.complete = "yes";
