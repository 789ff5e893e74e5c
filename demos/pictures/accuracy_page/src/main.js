// SPDX-License-Identifier: MIT
// Makes the page of the data in it.
import { cards, ownBounds } from "./cards.js";
import { styles } from "./colours.js";
import { verdicts } from "./criteria.js";
import { experimentOf, limitOfTwins, noise, unique, wide } from "./data.js";
import { element, escaped, saveButton, tableOf, unfolding } from "./dom.js";
import { effectWithKey } from "./effect_names.js";
import { figureOf } from "./figures.js";
import { Names } from "./names.js";
import { pricesPlot } from "./plots.js";
import { brokenCriterion, section } from "./section.js";
import { figure, percent, several } from "./words.js";

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

/** One line about the whole. */
function state() {
  const points = measured.flatMap((experiment) => experiment.table.points);
  const judged = measured.flatMap(verdicts);
  const count = (wanted) => judged.filter((verdict) => verdict.state === wanted).length;
  const loud = measured.filter((experiment) => noise(experiment) > limitOfTwins).map((experiment) => experiment.id);
  const criteria = judged.length > 0 ? `${count("kept")} of ${judged.length} criteria hold, ${count("broken")} are broken (below)${["not comparable", "not measured"].map((wanted) => (count(wanted) > 0 ? `, ${count(wanted)} ${wanted}` : "")).join("")}. ` : "";
  return element(
    "p.small",
    { id: "state" },
    data.kind === "scene" ? "" : `${measured.length} of ${several(experiments.length, "experiment")} measured. `,
    `${several(points.length, "point")}, ${figure(points.filter((point) => point.failure).length)} of them failed. ${criteria}`,
    `Times of ${figure(wide(points).length)} points have an interval wider than \u00b1 ${percent(limitOfTwins)}. `,
    loud.length > 0 ? `Times are noisy (two series of the same candidate differ by more than 3 %)${data.kind === "scene" ? "" : ` in ${loud.length > 8 ? `${loud.length} experiments` : loud.join(", ")}`}.` : "",
  );
}

function origin() {
  const runs = unique(measured.map(({ table: { facts } }) => [facts.cpu ?? "?", facts.compiler ?? "?", (facts.date ?? "?").slice(0, 10)].join(", ")));
  return runs.length > 0 ? element("p.small", {}, `Measured on ${runs.join("; ")}.`) : null;
}

function smokeWarning() {
  const small = measured.filter(({ table }) => (table.facts.command ?? "").includes("--smoke")).map((experiment) => experiment.id);
  if (small.length === 0) return null;
  return element("p.warning", {}, `Smoke run${small.length < experiments.length ? ` (${small.join(", ")})` : ""}: a few points of small sizes, to see that all works. Decide nothing by it.`);
}

/** All broken criteria, each with what it means. */
function brokenList() {
  const broken = measured.flatMap((experiment) => verdicts(experiment).filter((verdict) => verdict.state === "broken").map((verdict) => brokenCriterion(contextOf(experiment), verdict, true)));
  return broken.length > 0 ? element("details", { id: "broken", open: broken.length < 4 }, element("summary", {}, `What does not hold: ${broken.length === 1 ? "1 criterion" : `${broken.length} criteria`}`), element("ul.criteria", {}, broken)) : null;
}

const groups = { S: "Whole scenes", B: "Finding pairs of boxes", P: "Questions about two shapes", N: "What must not matter" };

/** The questions, each a link. */
function questions() {
  if (data.kind === "scene") return null;
  const letter = (experiment) => experiment.id.replace(/\d+$/, "");
  const lists = unique(experiments.map(letter)).map((one) => element("div", {}, element("h3", {}, groups[one] ?? "Others"), element("ul", {}, experiments.filter((experiment) => letter(experiment) === one).map((experiment) => element("li", {}, element("a", { href: `#${experiment.id}` }, experiment.question || experiment.title))))));
  const prices = data.prices ? element("div", {}, element("h3", {}, "Effects"), element("ul", {}, element("li", {}, element("a", { href: "#prices" }, "What does it cost to switch an effect on?")))) : null;
  const known = data.closedForms ? element("div", {}, element("h3", {}, "Closed forms"), element("ul", {}, element("li", {}, element("a", { href: "#closed-forms" }, "Is it what the textbook says?")))) : null;
  return element("nav", { id: "questions" }, element("h2", {}, "Which question is yours?"), element("div.cards", {}, lists, known, prices));
}

function pricesSection() {
  if (!data.prices) return null;
  const head = ["effect", "ns per body and step (least to greatest round)", "instructions per body and step", "ns where nothing calls for it", "instructions where nothing calls for it", "bytes per body", "pairs per body"];
  const text = ({ ns_per_body_step: price, interval_ns: [low, high] }) => (low <= 0 && high >= 0 ? `within noise: ${figure(low)} to ${figure(high)}` : `${figure(price)} (${figure(low)} to ${figure(high)})`);
  const effects = Object.entries(data.prices.effects).sort((a, b) => b[1].ns_per_body_step - a[1].ns_per_body_step);
  const rows = effects.map(([name, price]) => [effectWithKey(name), ...[text(price), ...["instructions_per_body_step", "uncalled_ns_per_body_step", "uncalled_instructions_per_body_step", "bytes_per_body", "pairs_per_body"].map((key) => figure(price[key]))].map((cell) => ({ text: cell, number: true }))]);
  return element(
    "section",
    { id: "prices" },
    element("h2", {}, "What does it cost to switch an effect on?"),
    figureOf({ names }, pricesPlot(data.prices, escaped), "prices-plot"),
    unfolding(`Numbers: ${several(effects.length, "effect")}`, () => tableOf(head, rows)),
    element("p", {}, element("code", {}, "./dev prices"), " makes it again. ", saveButton("JSON", "prices.json", () => JSON.stringify(data.prices, null, 2), "application/json")),
    element("p.small", {}, data.prices.machine ?? ""),
  );
}

/** Worlds of which it is known what must come of them. */
function closedFormsSection() {
  if (!data.closedForms) return null;
  const cases = Object.entries(data.closedForms);
  const share = (error) => (error === null ? "nothing" : percent(error));
  const right = cases.filter(([, { error, tolerance }]) => error !== null && error <= tolerance).length;
  const none = cases.filter(([, { within }]) => !within).length;
  const head = ["case", "world", "truth", "formula", "source", "default", "error", "cheapest setting that gets it right", "there", "error", "time, over the default"];
  const rows = cases.map(([name, known]) => {
    const cells = [known.default, known.error, known.value, known.setting_error, known.price];
    const [value, error, there, left, price] = cells.map((cell, i) => ({ text: i === 1 || i === 3 ? share(cell) : cell === null ? "nothing" : figure(cell), number: true }));
    return [name, known.about, { text: `${figure(known.truth)} ${known.unit}`, number: true }, known.formula, known.source, value, error, known.within ? known.setting : `none; nearest: ${known.setting}`, there, left, price];
  });
  return element(
    "section",
    { id: "closed-forms" },
    element("h2", {}, "Is it what the textbook says?"),
    element("p", {}, `Of ${several(cases.length, "world")} with a closed form ${right} are right at default settings, within a hundredth or what is said; ${cases.length - right - none} are at the setting that is named, ${none} at none that was tried.`),
    unfolding(`Numbers: ${several(cases.length, "world")}`, () => tableOf(head, rows)),
    element("p", {}, element("code", {}, "tests/scenes/closed_forms.py"), " makes it again; docs/closed-forms.md says how to read it."),
  );
}

function summary() {
  const own = data.kind === "scene" && measured.length > 0 ? ownBounds(contextOf(measured[0])) : null;
  return element("header", { id: "summary" }, element("h1", {}, data.title), data.lead ? element("p", {}, data.lead) : null, smokeWarning(), own ?? cards(names, experiments), state(), brokenList(), origin());
}

/** Goes to what the address names; rows of tables are made first. */
function follow() {
  const id = decodeURIComponent(location.hash.slice(1));
  const [, experiment] = /^(.*)-point-\d+$/.exec(id) ?? [];
  const numbers = experiment && document.getElementById(`${experiment}-numbers`);
  if (numbers) {
    numbers.open = true;
    numbers.fill();
  }
  for (const marked of document.querySelectorAll("tr.marked")) marked.classList.remove("marked");
  const target = id && document.getElementById(id);
  target?.closest("details:not([open])")?.setAttribute("open", "");
  if (target?.tagName === "TR") target.classList.add("marked");
  target?.scrollIntoView({ block: target.tagName === "TR" ? "center" : "start" });
}

/** Sections come one after the other, so that the first screen is there at once. */
async function fill(main) {
  for (const experiment of experiments) {
    await new Promise((done) => setTimeout(done));
    main.append(section(contextOf(experiment)));
  }
  main.append(closedFormsSection() ?? "", pricesSection() ?? "");
  if (location.hash) follow();
  document.body.dataset.complete = "yes";
}

document.title = data.title;
const main = element("main", {}, summary(), questions());
document.body.append(main);
addEventListener("hashchange", follow);
fill(main);
