// SPDX-License-Identifier: MIT
// Fronts, hypervolumes, advice, criteria and constants of known data.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { advise, tried } from "../../../../demos/pictures/accuracy_page/src/advice.js";
import { precisionPlot, rightAt } from "../../../../demos/pictures/accuracy_page/src/precision.js";
import { constantGroups, constants, constantWords } from "../../../../demos/pictures/accuracy_page/src/constants.js";
import { errorAtCost, experimentOf, judge } from "../../../../demos/pictures/accuracy_page/src/data.js";
import { criticalDifference, front, hypervolumes, ranks } from "../../../../demos/pictures/accuracy_page/src/front.js";
import { Names } from "../../../../demos/pictures/accuracy_page/src/names.js";
import { adviceWords, priceText } from "../../../../demos/pictures/accuracy_page/src/words.js";
import { experiment, row } from "./tables.mjs";

const knob = [[1, 1, 0.9], [2, 2, 0.5], [4, 3, 0.6], [8, 4, 0.1], [16, 8, 0.1]].map(([n, cost, error]) => row("wall", "iterations", n, cost, [error]));
const standard = { series: "iterations", setting: 8 };

describe("the front", () => {
  const settings = (rows, better) => front(experiment(rows).table.points, "error_m", better).map((point) => point.setting);

  test("has what no other beats", () => assert.deepEqual(settings(knob), ["1", "2", "8"]));
  test("turns round where more is better", () => assert.deepEqual(settings(knob, "high"), ["1"]));
  test("takes what is nearest to zero where that is better", () => assert.deepEqual(settings([row("wall", "a", 1, 1, [0.2]), row("wall", "a", 2, 2, [-0.9]), row("wall", "a", 4, 3, [-0.1])], "zero"), ["1", "4"]));
  test("has no failures and nothing without a value", () => {
    const rows = [row("wall", "s", 1, 0.1, [0], { failure: "exploded" }), row("wall", "s", 2, 0.2, [null]), ...knob];
    assert.deepEqual(settings(rows), ["1", "2", "8"]);
  });
});

describe("the hypervolume", () => {
  const volumes = (rows) => hypervolumes(experiment(rows).table.points, "error_m");

  test("is the part of the plane that is reached", () => {
    // On scales of logarithms: a at (0, 1/2) and (1/2, 0), b at (1, 1) and (1/2, 1/2).
    const found = volumes([row("w", "a", 1, 1, [10]), row("w", "a", 2, 10, [1]), row("w", "b", 1, 100, [100]), row("w", "b", 2, 10, [10])]);
    assert.ok(Math.abs(found.get("a") - (0.5 * 0.5 + 0.5 * 1)) < 1e-12);
    assert.ok(Math.abs(found.get("b") - 0.5 * 0.5) < 1e-12);
  });
  test("of what failed is nothing", () => {
    assert.equal(volumes([row("w", "a", 1, 1, [10]), row("w", "a", 2, 2, [5]), row("w", "b", 1, 1, [1], { failure: "exploded" })]).get("b"), 0);
  });
  test("ranks share", () => assert.deepEqual([...ranks(new Map([["a", 0.5], ["b", 0.9], ["c", 0.5]]))], [["a", 2.5], ["b", 1], ["c", 2.5]]));
  test("critical difference", () => {
    // Demsar 2006, section 3.2.2: four classifiers, fourteen data sets: 1.25.
    assert.ok(Math.abs(criticalDifference(4, 14) - 1.25) < 0.01);
    assert.equal(criticalDifference(4, 1), null);
    assert.equal(criticalDifference(11, 5), null);
  });
});

describe("advice", () => {
  const advised = (rows, { limit = 0.55, keys = {}, ...entry } = {}) =>
    advise(experiment(rows, keys), { panel: "*", bounds: [{ metric: "error_m", at_most: limit }], default: standard, for: "walls", ...entry });
  const words = (advice) => adviceWords(new Names(), advice);

  test("is the cheapest within the bound", () => {
    const found = advised(knob);
    assert.deepEqual(found.choice, { series: "iterations", setting: "2" });
    assert.equal(found.ratio.value, 0.5);
    assert.equal(words(found).cost, "2 \u00d7 faster than the default");
    assert.deepEqual(found.values.map(({ value, default: other }) => [value, other]), [[0.5, 0.1]]);
  });
  test("may be the default", () => assert.equal(advised(knob, { limit: 0.1 }).isDefault, true));
  test("may cost more than the default", () => assert.equal(words(advised(knob, { default: { series: "iterations", setting: 1 } })).cost, "2 \u00d7 the time of the default"));
  test("keeps all bounds at once", () => {
    const rows = [[1, 1, 0.1, 9], [2, 2, 0.1, 2], [8, 4, 0.1, 1]].map(([n, cost, a, b]) => row("wall", "iterations", n, cost, [a, b]));
    const bounds = [{ metric: "error_m", at_most: 0.2 }, { metric: "sunk_m", at_most: 3 }];
    assert.equal(advised(rows, { bounds, keys: { metrics: ["error_m", "sunk_m"] } }).choice.setting, "2");
    bounds[1] = { metric: "sunk_m", at_least: 5 };
    assert.equal(advised(rows, { bounds, keys: { metrics: ["error_m", "sunk_m"] } }).choice.setting, "1");
  });
  test("gives a tie to the default: intervals overlap", () => {
    const rows = (spread) => [[4, 3, 0.5], [8, 4, 0.1]].map(([n, cost, error]) => row("wall", "iterations", n, cost, [error], { spread }));
    assert.equal(advised(rows(0.3)).choice.setting, "8");
    assert.equal(advised(rows(0.01)).choice.setting, "4");
  });
  test("gives a tie to the default: 0.2 % apart, or less than the twins differ", () => {
    const rows = (cost) => [row("wall", "iterations", 4, cost, [0.5], { spread: 1e-5 }), row("wall", "iterations", 8, 4, [0.1], { spread: 1e-5 })];
    assert.equal(advised(rows(3.992)).choice.setting, "8");
    assert.equal(advised(rows(3.8)).choice.setting, "4");
    assert.equal(advised(rows(3.8), { keys: { controls: [["wall", 0.08]] } }).choice.setting, "8");
  });
  test("of those that take as long is what strains its bounds least, then what is most like the default", () => {
    const rows = (...errors) => errors.map(([series, n, error]) => row("wall", series, n, n === 8 ? 9 : 1 + 1e-4 * n, [error]));
    assert.equal(advised(rows(["iterations", 1, 0.5], ["iterations", 2, 0.1], ["iterations", 8, 0.1])).choice.setting, "2");
    assert.equal(advised(rows(["others", 1, 0.1], ["iterations", 2, 0.1001], ["iterations", 8, 0.1])).choice.series, "iterations");
  });
  test("says where it is slower than the default", () => {
    const rows = [["wall", 4, 1], ["wall", 8, 4], ["pile", 4, 3], ["pile", 8, 2]].map(([panel, n, cost]) => row(panel, "iterations", n, cost, [0.1]));
    assert.equal(words(advised(rows)).cost, "from 4 \u00d7 faster than the default (wall) to 1.5 \u00d7 its time (pile)");
  });
  test("names what nearly keeps the bounds for much less", () => {
    const rows = [[1, 1, 0.9], [2, 2, 0.58], [8, 8, 0.5]].map(([n, cost, error]) => row("wall", "iterations", n, cost, [error]));
    assert.match(words(advised(rows)).almost, /^Nearly: iterations, 2, 4 \u00d7 faster than the default, but for error 0\.58 m\.$/);
    assert.equal(words(advised(rows, { limit: 0.5 })).almost, "");
  });
  test("has no more digits than twins bear", () => {
    const rows = [[2, 2, 0.5], [8, 4.69, 0.1]].map(([n, cost, error]) => row("wall", "iterations", n, cost, [error], { spread: 1e-3 }));
    assert.equal(words(advised(rows)).cost, "2.35 \u00d7 faster than the default");
    assert.equal(words(advised(rows, { keys: { controls: [["wall", 0.3]] } })).cost, "2 \u00d7 faster than the default");
  });
  test("does not take the default for its time where it breaks a bound", () => {
    const rows = [row("wall", "iterations", 4, 4, [0.1]), row("wall", "iterations", 8, 4, [0.9])];
    const found = advised(rows);
    assert.deepEqual([found.choice.setting, found.tie, found.defaultBreaks.length], ["4", true, 1]);
  });
  test("says when nothing is good enough, what comes nearest, and where it fails", () => {
    const rows = [...knob, ...[[2, 5, 0.001], [8, 20, 0.002]].map(([n, cost, error]) => row("pile", "iterations", n, cost, [error]))];
    const found = advised(rows, { limit: 0.01 });
    assert.equal(found.choice, undefined);
    assert.deepEqual(found.without, ["wall"]);
    assert.deepEqual(found.alone, [{ panel: "pile", series: "iterations", setting: "2" }]);
    assert.deepEqual([found.nearest.setting, found.nearest.values[0].value], ["8", 0.1]);
    assert.match(words(found).trouble, /Nothing reaches them on wall\./);
  });
  test("takes no failure", () => assert.equal(advised([row("wall", "iterations", 1, 0.5, [0.01], { failure: "exploded" }), ...knob.slice(1)]).choice.setting, "2"));
  test("says that the default fails", () => {
    const found = advised([...knob.slice(0, 3), row("wall", "iterations", 8, null, [null], { failure: "exploded" })]);
    assert.equal(found.ratio, null);
    assert.match(words(found).cost, /^2 ms per simulated second; the default fails: exploded/);
    const both = advised(["wall", "pile"].flatMap((panel) => [row(panel, "iterations", 4, panel === "pile" ? 7 : 3, [0.1]), row(panel, "iterations", 8, 9, [0.1], { failure: "torn" })]));
    assert.match(words(both).cost, /^3 to 7 ms per simulated second; the default fails: torn/);
  });
  test("holds on all scenes together", () => {
    const rows = [...knob, ...[[2, 5, 0.7], [8, 20, 0.2], [16, 30, 0.1]].map(([n, cost, error]) => row("pile", "iterations", n, cost, [error]))];
    const found = advised(rows);
    assert.deepEqual([found.choice.setting, found.panels.length, found.values[0].value], ["8", 2, 0.2]);
    assert.equal(advised(rows, { panel: ["wall"] }).choice.setting, "2");
  });
  test("holds for all settings where these are questions", () => {
    const rows = [["tree", 10, 1, 0], ["tree", 100, 4, 0], ["fast", 10, 0.1, 0], ["fast", 100, 0.2, 3], ["good", 10, 0.5, 0], ["good", 100, 2, 0], ["partly", 10, 0.1, 0]];
    const found = advised(rows.map(([series, n, cost, error]) => row("wall", series, n, cost, [error])), { over: "setting", limit: 0, default: { series: "tree" } });
    assert.equal(found.choice.series, "good");
    assert.ok(Math.abs(found.ratio.value - 0.5) < 1e-12);
  });
  test("concerns the settings that it names", () => {
    const rows = [["tree", 10, 1, 0], ["tree", 100, 4, 0], ["fast", 10, 0.1, 0], ["fast", 100, 8, 0]].map(([series, n, cost, error]) => row("wall", series, n, cost, [error]));
    const choice = (settings) => advised(rows, { over: "setting", limit: 0, default: { series: "tree" }, settings }).choice.series;
    assert.deepEqual([choice(["10"]), choice(["100"])], ["fast", "tree"]);
  });
  test("skips scenes where the metric does not apply", () => {
    const found = advised([...knob, ...[1, 2, 8].map((n) => row("hill", "iterations", n, 1, [null]))]);
    assert.deepEqual([found.choice.setting, found.panels], ["2", ["wall"]]);
  });
  test("tells instructions where times are noisy", () => {
    const counts = [["wall", "iterations", "2", 300], ["wall", "iterations", "8", 1000]];
    assert.match(words(advised(knob, { keys: { counts, controls: [["wall", 0.2]] } })).cost, /faster than the default; 0\.3 \u00d7 the instructions/);
    assert.doesNotMatch(words(advised(knob, { keys: { counts } })).cost, /instructions/);
  });
  test("tells instructions where intervals are wide, and only where all places are counted", () => {
    const rows = (spread, panel = "wall") => [[2, 2, 0.5], [8, 8, 0.1]].map(([n, cost, error]) => row(panel, "iterations", n, cost, [error], { spread }));
    const counts = ["wall", "pile"].flatMap((panel) => [[panel, "iterations", "2", 300], [panel, "iterations", "8", 1000]]);
    const cost = (all, counted) => words(advised(all, { keys: { counts: counted } })).cost;
    assert.match(cost(rows(0.1), counts.slice(0, 2)), /faster than the default; 0\.3 \u00d7 the instructions at small sizes$/);
    assert.doesNotMatch(cost(rows(0.01), counts.slice(0, 2)), /instructions/);
    const both = [...rows(0.1), ...rows(0.1, "pile")];
    assert.match(cost(both, counts), /instructions/);
    assert.doesNotMatch(cost(both, counts.slice(0, 2)), /instructions/);
  });
  test("may bound some of its scenes only, and names them", () => {
    const rows = ["wall", "pile"].flatMap((panel) => [[1, 1, panel === "wall" ? 0.9 : 0.2], [2, 2, 0.1], [8, 4, 0.1]].map(([n, cost, error]) => row(panel, "iterations", n, cost, [error])));
    const found = (panel) => advised(rows, { bounds: [{ metric: "error_m", at_most: 0.55, panel }] });
    assert.deepEqual([found(undefined).choice.setting, found("wall").choice.setting, found("pile").choice.setting], ["2", "2", "1"]);
    assert.deepEqual([found("pile").values[0].value, words(found(["pile"])).bounds], [0.2, "error at most 0.55 m (pile)"]);
  });
  test("is a price where nothing is recommended", () => {
    const text = (default_) => priceText(words(advised(knob, { limit: 1, price: true, series: "iterations", settings: ["1", "8"], default: default_ })));
    assert.equal(advised(knob, { price: true }).isPrice, true);
    assert.equal(advised(knob).isPrice, false);
    assert.equal(text(standard), "4 \u00d7 faster than the default, measured with iterations, 1");
    const dear = [row("wall", "bullet", 1, 1, [0]), row("wall", "float", 1, 1.1, [0])];
    assert.equal(priceText(words(advised(dear, { price: true, series: "float", default: { series: "bullet", setting: 1 } }))), "costs 10 % more time than the default, measured with float, 1");
  });
  test("misses nothing silently", () => {
    assert.match(advised(knob, { bounds: [{ metric: "nix", at_most: 1 }] }).missing, /no nix/);
    assert.match(advised(knob, { panel: "hill" }).missing, /no hill/);
    assert.equal(advise(experimentOf({ id: "E" }), { bounds: [] }).missing, "not measured");
  });
});

describe("criteria", () => {
  const judged = (entry, rows = knob) => judge(experiment(rows), { text: "t", metric: "error_m", op: "<=", value: 0.9, ...entry });

  test("are kept", () => assert.deepEqual([judged({}).state, judged({}).points], ["kept", 5]));
  test("are broken by points", () => assert.deepEqual(judged({ value: 0.55 }).broken.map((point) => point.setting), ["1", "4"]));
  test("concern the points that they name", () => {
    assert.equal(judged({ value: 0.55, where: { setting: 2 } }).state, "kept");
    assert.equal(judged({ where: { panel: "hill" } }).state, "not measured");
  });
  test("are broken by failures, and not by what does not apply", () => {
    assert.equal(judged({}, [row("wall", "a", 1, 1, [0], { failure: "exploded" })]).state, "broken");
    assert.equal(judged({}, [row("wall", "a", 1, 1, [null])]).state, "not measured");
  });
});

describe("errors beside those for the same time", () => {
  const points = (rows) => experiment(rows).table.points;
  const ratios = [{ name: "beside", metric: "error_m", panel: "rope", beside: { series: "a" } }];
  const alone = [[1, 1], [10, 0.01], [100, 0.001]].map(([cost, error]) => row("rope", "a", cost, cost, [error]));

  test("follow the power law between neighbours", () => {
    for (const [cost, error] of [[Math.sqrt(10), 0.1], [10, 0.01], [10 * Math.sqrt(10), 0.01 / Math.sqrt(10)]]) assert.ok(Math.abs(errorAtCost(points(alone), "error_m", cost) / error - 1) < 1e-12);
  });
  test("are not known where nothing good was measured on either side", () => {
    const rows = [...alone.slice(0, 2), row("rope", "a", 5, 0.1, [7], { failure: "exploded" }), row("rope", "a", 6, 100, [0])];
    for (const cost of [0.5, 50]) assert.equal(errorAtCost(points(rows), "error_m", cost), null);
    assert.equal(errorAtCost([], "error_m", 1), null);
  });
  test("are ratios to the points that are named, of the same panel", () => {
    const { table } = experiment([...alone, row("rope", "b", 1, 10, [0.0025]), row("rope", "b", 2, 1000, [1]), row("wall", "b", 1, 10, [1])], { ratios });
    assert.deepEqual(table.metrics, ["error_m", "beside"]);
    assert.deepEqual(table.points.map(({ values }) => values.beside), [null, null, null, 0.25, null, undefined]);
  });
  test("have no ratio to runs that failed though nothing exploded", () => {
    const judged = (above, rows = []) => {
      const made = experiment([...alone, row("rope", "b", 1, 10, [0.0025]), ...rows], { ratios, failed: [{ panel: "rope", metric: "error_m", above, why: "torn" }] });
      return { ...judge(made, { metric: "beside", op: "<", value: 1, where: { panel: "rope" }, without: "never holds" }), failures: made.table.points.filter(({ failure }) => failure === "torn").length };
    };
    const short = ({ state, points, failures }) => [state, points, failures];
    assert.deepEqual(short(judged(2)), ["kept", 1, 0]);
    assert.deepEqual(short(judged(1e-4)), ["not comparable", 0, 4]);
    assert.equal(judged(1e-4).without, "never holds");
    // One that fails where the others hold breaks the criterion, with or without a value.
    assert.deepEqual(short(judged(2, [row("rope", "b", 2, 10, [5])])), ["broken", 2, 1]);
    assert.deepEqual(short(judged(2, [row("rope", "b", 2, 10, [null], { failure: "exploded" })])), ["broken", 2, 0]);
  });
});

describe("constants", () => {
  const rows = [[1, 5, 1], [2, 5, 2]].map(([n, a, b]) => row("wall", "s", n, n, [a, b]));
  const found = (keys, all = rows) => constants(experiment(all, { metrics: ["still", "moving"], ...keys }), new Names());
  const short = (all) => all.map(({ metric, panel, series, why }) => [metric, panel, series, why]);

  test("are metrics that do not change with the knob, and have no sentence by themselves", () => assert.deepEqual(short(found({})), [["still", "wall", null, ""]]));
  test("take the sentence of their panel", () => {
    const why = (entry) => found({ constant: [{ why: "it stands", ...entry }] })[0].why;
    assert.equal(why({ metric: "still" }), "it stands");
    assert.equal(why({ metric: ["moving", "still"], panel: ["hill", "wall"] }), "it stands");
    assert.equal(why({ metric: "still", panel: "hill" }), "");
    assert.equal(why({ metric: "still", series: "s" }), "");
    assert.equal(why({ metric: "still", series: "*" }), "it stands");
  });
  test("need two settings of a series", () => assert.deepEqual(constants(experiment([row("wall", "a", 1, 1, [5]), row("wall", "b", 1, 1, [5])]), new Names()), []));

  const oneStill = (value) => [1, 2, 3].flatMap((n) => [row("wall", "a", n, 1, [value, n]), row("wall", "b", n, 1, [n, n])]);
  test("are three settings of one series where others change", () => {
    assert.deepEqual(short(found({}, oneStill(5))), [["still", "wall", "a", ""]]);
    assert.deepEqual(found({}, oneStill(5).slice(0, 4)), []);
    const why = (entry) => found({ constant: [{ metric: "still", why: "a formula", ...entry }] }, oneStill(5))[0].why;
    assert.deepEqual([why({ series: "a" }), why({ series: ["b", "a"] }), why({ series: "*" }), why({ series: "b" }), why({})], ["a formula", "a formula", "a formula", "", ""]);
  });
  test("are of a whole panel only where its series have one value", () => {
    const still = (n) => [1, 2, 3].slice(0, n).flatMap((setting) => [row("wall", "a", setting, 1, [1, setting]), row("wall", "b", setting, 1, [-1, setting])]);
    for (const settings of [2, 3]) assert.deepEqual(short(found({}, still(settings))), [["still", "wall", "a", ""], ["still", "wall", "b", ""]]);
    assert.deepEqual(short(found({}, [...[1, 2].map((n) => row("wall", "a", n, 1, [5, n])), row("wall", "b", 1, 1, [7, 1])])), [["still", "wall", "a", ""]]);
  });
  test("are the same to a thousandth", () => {
    const last = (value) => found({}, [[1, 14.0605], [2, 14.0612], [3, value]].map(([n, error]) => row("wall", "a", n, 1, [error, n])));
    assert.deepEqual(short(last(14.06)), [["still", "wall", null, ""]]);
    assert.deepEqual(last(14.09), []);
  });
  test("explain themselves where they are faults that others have", () => {
    assert.match(found({}, oneStill(0))[0].why, /^No still at any setting/);
    assert.equal(found({}, [...oneStill(0), row("hill", "a", 1, 1, [-1, 0])])[0].why, "");
    const good = [1, 2, 3].flatMap((n) => [row("wall", "a", n, 1, [0]), row("wall", "b", n, 1, [n])]);
    assert.deepEqual(found({ metrics: ["steps_alike"] }, good).map(({ series, why }) => [series, why]), [["a", ""]]);
    assert.equal(found({}, oneStill(0).map((line) => (line[1] === "b" ? row("wall", "b", line[2], 1, [0, Number(line[2])]) : line)))[0].series, null);
  });
  test("are series of knobs that have the same numbers", () => {
    const twins = [1, 2, 3].flatMap((n) => ["a=1", "a=2", "b"].map((series) => row("wall", series, n, 1, [0.3 * n, series === "a=2" && n === 3 ? 1 : n])));
    const [alike, ...more] = found({}, twins).filter((one) => one.alike);
    assert.deepEqual([more, alike.alike, alike.settings, alike.why], [[], ["a=1", "a=2"], ["1", "2"], ""]);
    assert.equal(found({ constant: [{ alike: ["a=2", "a=1"], why: "one joint" }] }, twins).find((one) => one.alike).why, "one joint");
    const whole = [1, 2].flatMap((n) => ["a=1", "a=2"].map((series) => row("wall", series, n, 1, [n, n])));
    assert.deepEqual(found({}, whole).filter((one) => one.alike), []);
  });
  test("are said once for all metrics, series and panels that have the same sentence", () => {
    const rows = [1, 2, 3].flatMap((n) => ["a", "b", "c"].map((series) => row("wall", series, n, 1, series === "c" ? [n, n] : [5, 7])));
    const context = { experiment: experiment(rows, { metrics: ["one", "two"], constant: [{ metric: ["one", "two"], series: "*", why: "a formula" }] }), names: new Names() };
    const groups = constantGroups(context.experiment, context.names);
    assert.equal(groups.length, 1);
    assert.deepEqual(constantWords(context, groups[0]), { what: "one and two", where: "one: a and b on wall (5). two: a and b on wall (7)" });
  });
});

describe("work against precision", () => {
  const entry = { panel: "*", bounds: [{ metric: "error_m", at_most: 0.55 }], default: standard };
  const plotOf = (rows, changed = {}) => {
    const made = experiment(rows);
    const asked = { ...entry, ...changed };
    return precisionPlot({ experiment: made, names: new Names(), style: () => ({ color: "#0072b2", symbol: "circle", dash: "solid" }), escape: (text) => text }, asked, "error_m", advise(made, asked));
  };
  const named = (plot, name) => plot.option.series.find((series) => series.name === name);

  test("has the geometric mean of times and the worst error over scenes", () => {
    const found = tried(experiment([row("wall", "a", 1, 1, [0.1]), row("hill", "a", 1, 4, [0.3])]), { ...entry, default: {} }, "error_m");
    assert.equal(found.length, 1);
    assert.ok(Math.abs(found[0].cost - 2) < 1e-12);
    assert.equal(found[0].value, 0.3);
  });
  test("marks the chosen point, the default and the bound", () => {
    const plot = plotOf(knob);
    assert.deepEqual(named(plot, "take").data[0].value, [Math.log10(2), Math.log10(0.5)]);
    assert.deepEqual(named(plot, "default").data[0].value, [Math.log10(4), Math.log10(0.1)]);
    assert.equal(named(plot, "bound").markLine.data[0].yAxis, Math.log10(0.55));
    assert.match(named(plot, "bound").markLine.label.formatter, /^at most 0.55/);
  });
  test("has one mark where the default is the choice, and says what stands in for a default", () => {
    const own = plotOf(knob, { default: { series: "iterations", setting: 2 } });
    assert.equal(named(own, "default"), undefined);
    assert.equal(named(own, "take").data[0].label.formatter, "take, the default");
    const other = plotOf(knob, { default: { ...standard, called: "what a paper has" } });
    assert.equal(named(other, "default").data[0].label.formatter, "instead of");
  });
  test("names three series, and is there without any that keeps the bound", () => {
    const rows = ["a", "b", "c", "d", "e"].map((series, i) => row("wall", series, 1, 1 + i, [5 - i]));
    assert.equal(plotOf(rows).legend.at(-1).name, "2 more");
    assert.equal(named(plotOf(rows, { bounds: [{ metric: "error_m", at_most: 0.1 }] }), "take"), undefined);
    assert.equal(plotOf([row("wall", "a", 1, 1, [1], { failure: "exploded" })]), null);
  });
  test("what is a thousand times better than the bound stands at the foot, but nothing is not moved", () => {
    const plot = plotOf([row("wall", "iterations", 1, 1, [1e-9]), row("wall", "iterations", 2, 2, [0]), row("wall", "iterations", 8, 3, [1])]);
    const [line] = plot.option.series;
    assert.ok(Math.abs(line.data[0].value[1] - Math.log10(0.00055)) < 1e-9);
    assert.ok(line.data[1].value[1] < line.data[0].value[1]);
  });
});

test("worlds with a closed form are counted by the price at which they are right", () => {
  const known = (error, within, price) => ({ error, tolerance: 0.01, within, price });
  const found = rightAt({ a: known(0.001, true, 1), b: known(0.5, true, 3), c: known(null, true, 0.9), d: known(0.2, false, 4) });
  assert.deepEqual(found, { all: 4, steps: [[1, 2], [3, 3]], byDefault: 1, never: 1, most: 3 });
});
