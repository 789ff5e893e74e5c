// SPDX-License-Identifier: MIT
// The first screen: for each kind of user one plot of work against precision, and one sentence.
import { advise, advices } from "./advice.js";
import { axisOf } from "./plot_parts.js";
import { chartPlace } from "./charts.js";
import { boundOf, mark, precisionPlot, rightAt, smallPlot } from "./precision.js";
import { plainStyle } from "./colours.js";
import { element, escaped, unfolding } from "./dom.js";
import { marked } from "./figures.js";
import { adviceWords, capital, figure, percent, priceText } from "./words.js";

const plotHeight = 158;

/** {experiment, entry, advice} of "S7", the first advice that has a setting to take, or of "S7#2", the second. */
function found(experiments, wanted) {
  const [id, number] = wanted.split("#");
  const experiment = experiments.find((one) => one.id === id);
  if (!experiment?.table) return [];
  const all = advices(experiment);
  const at = number ? number - 1 : Math.max(0, all.findIndex((one) => one.choice));
  return all[at] ? [{ experiment, entry: experiment.advice[at], advice: all[at] }] : [];
}

/** What to take and what that costs, in a sentence. */
function sentence(names, { experiment, advice }) {
  const words = adviceWords(names, advice, { named: true });
  const purpose = element("span.for", {}, `${capital(advice.purpose)}: `);
  // Counts of instructions are for those who doubt the times: the section has them.
  const cost = (words.cost ?? "").replace(/; [\d.]+ \u00d7 the instructions at small sizes/, "");
  if (words.trouble) return [purpose, words.trouble];
  if (advice.isPrice) return [purpose, priceText(words), "."];
  return [purpose, "take ", element("b", {}, words.take), advice.isDefault ? `, ${words.other}.` : `: ${[cost, words.gain].filter(Boolean).join(", ")}.`];
}

const evidence = (id, text = "evidence") => element("a", { href: `#${id}` }, text);

function legend(rows) {
  return element("p.key", {}, rows.map(({ name, color, ...look }) => element("span", {}, marked(color, { ...look, line: true }), name)));
}

/** The plot with its legend; the figure of the section that shows the same in full is its evidence. */
function drawn(contextOf, { experiment, entry, advice }, metric) {
  const plot = precisionPlot({ ...contextOf(experiment), escape: escaped }, entry, metric, advice);
  return plot ? [chartPlace(plot.option, { height: plotHeight }), plot.legend.length > 1 ? legend(plot.legend) : null] : null;
}

/** The figure of a section that plots the metric over time, else its advice. */
function evidenceOf({ experiment, entry }, metric) {
  const bound = boundOf(entry, metric);
  const at = experiment.plots.findIndex((spec) => spec.y === bound.metric);
  return at < 0 ? `${experiment.id}-advice` : `${experiment.id}-${at + 1}-${experiment.plots[at].kind}`;
}

function card(names, experiments, contextOf, user) {
  const [first, ...rest] = user.experiments.flatMap((wanted) => found(experiments, wanted));
  const more = () => element("ul", {}, rest.map((one) => element("li", {}, sentence(names, one), " ", evidence(`${one.experiment.id}-advice`))));
  return element(
    "article.card",
    { id: `for-${user.id}` },
    element("h2", {}, user.title),
    drawn(contextOf, first, user.metric),
    element("p.says", {}, sentence(names, first), " ", evidence(evidenceOf(first, user.metric))),
    rest.length > 0 ? unfolding(`${rest.length} more answers`, more) : null,
  );
}

function truthCard(closedForms) {
  const { all, steps, byDefault, never, most } = rightAt(closedForms);
  const x = axisOf([1, ...steps.map(([price]) => price)], { log: true, name: "time of the setting, beside the default's" });
  const y = axisOf([0, all], { name: "worlds within 1 % of the textbook" });
  const { color } = plainStyle;
  const place = ([price, count]) => [x.place(price), count];
  const dots = [[1, byDefault], ...steps].map((step) => ({ value: place(step), hover: `${step[1]} of ${all} at up to ${figure(step[0])} \u00d7 the time` }));
  const right = { type: "line", name: "right", step: "end", symbol: "circle", symbolSize: 6, itemStyle: { color }, lineStyle: { color, width: 1.8 }, data: dots };
  const ticks = { customValues: [0, all / 3, (2 * all) / 3, all].map(Math.round) };
  const upright = { ...y.option, min: 0, max: all, axisTick: ticks, splitLine: ticks, axisLabel: { ...y.option.axisLabel, ...ticks } };
  const option = smallPlot(x.option, upright, [right, mark("default", "rect", place([1, byDefault]), "default", "right")]);
  return element(
    "article.card",
    { id: "for-truth" },
    element("h2", {}, "Is it right at all?"),
    chartPlace(option, { height: plotHeight }),
    element("p.says", {}, `Of ${all} worlds with a textbook answer `, element("b", {}, `${byDefault} are right at default settings`), `, to ${percent(0.01)}; ${all - byDefault - never} more with a setting that takes up to ${figure(most, 2)} \u00d7 the time${never > 0 ? `, and ${never} with none that was tried` : ""}. `, evidence("closed-forms")),
  );
}

/** Cards of all users, of whose experiments any is on the page; what is known to be true comes first. */
export function cards(names, experiments, contextOf, closedForms) {
  const users = (names.names.users ?? []).filter((user) => user.experiments.some((wanted) => found(experiments, wanted).length > 0));
  return users.length > 0 ? element("div.cards", {}, closedForms ? truthCard(closedForms) : null, users.map((user) => card(names, experiments, contextOf, user))) : null;
}
