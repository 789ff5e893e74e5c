// SPDX-License-Identifier: MIT
// Numbers, names, colours, axes and plots.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { describe, test } from "node:test";
import { axisOf } from "../../../../demos/pictures/accuracy_page/src/plot_parts.js";
import { inks, partColours, setGround, styles, tint, tinted } from "../../../../demos/pictures/accuracy_page/src/colours.js";
import { Names } from "../../../../demos/pictures/accuracy_page/src/names.js";
import { plainNames } from "../../../../demos/pictures/accuracy_page/src/plain_names.js";
import { plotOf, pricesPlot, slope } from "../../../../demos/pictures/accuracy_page/src/plots.js";
import { borne, errorWords, figure, listed, measured, timesWords, timeWords } from "../../../../demos/pictures/accuracy_page/src/words.js";
import { experiment, row } from "./tables.mjs";

describe("numbers", () => {
  test("have three digits, and no exponent where that can be read", () => {
    const shown = { 0: "0", 1: "1", 12345: "12\u202f345", 0.0337: "0.0337", 3.14159: "3.14", 123.456: "123", 0.5: "0.5", "-2": "\u22122", 1e-9: "1e\u22129" };
    for (const [value, text] of Object.entries(shown)) assert.equal(figure(Number(value)), text);
    assert.equal(figure(null), "\u2013");
    assert.equal(figure(Infinity), "\u221e");
  });
  test("have a unit in the prefix that reads best", () => {
    assert.equal(measured(0.000178, "m"), "0.178 mm");
    assert.equal(measured(0.25, "m"), "0.25 m");
    assert.equal(measured(7, "degrees"), "7 degrees");
    assert.equal(measured(0, "m"), "0 m");
    assert.equal(measured(1, "yes/no"), "yes");
  });
  test("have as many digits as their interval bears", () => {
    assert.equal(borne(2.134, 2.05, 2.22), "2.1");
    assert.equal(borne(2.134, 2.124, 2.144), "2.13");
    assert.equal(borne(29.7, 25, 35), "30");
    assert.equal(borne(2.134, 1, 4), "2");
  });
  test("become sentences", () => {
    assert.equal(timeWords({ value: 0.0337, low: 0.033, high: 0.0345 }), "30 \u00d7 faster than the default");
    assert.equal(timeWords({ value: 2.13, low: 2.05, high: 2.22 }), "2.1 \u00d7 the time of the default");
    assert.equal(timeWords({ value: 0.85, low: 0.84, high: 0.86 }), "15 % less time than the default");
    assert.equal(timeWords({ value: 0.8512, low: 0.82, high: 0.88 }), "15 % less time than the default");
    assert.equal(timeWords({ value: 0.9645, low: 0.904, high: 1.004 }), "4 % less time than the default");
    assert.equal(timeWords({ value: 1.2, low: 1.19, high: 1.21 }), "20 % more time than the default");
    assert.equal(errorWords(0.001, 0.03, "penetration"), "30 \u00d7 less penetration");
    assert.equal(errorWords(0, 0.03, "missed pairs"), "no missed pairs");
    assert.equal(errorWords(1e-12, 1, "error"), "over 1000 \u00d7 less error");
    assert.equal(errorWords(0.03, 0.001, "penetration"), "");
    assert.equal(errorWords(4, 2, "standing time", "high"), "2 \u00d7 more standing time");
  });
  test("are a range where places differ", () => {
    const words = (...values) => timesWords({ value: 0.5, low: 0.49, high: 0.51 }, values.map((value, i) => ({ value, name: `place ${i}` })), 0.03);
    assert.equal(words(0.5, 0.55), "2 \u00d7 faster than the default");
    assert.equal(words(0.25, 1.02), "1 to 4 \u00d7 faster than the default");
    assert.equal(words(0.98, 3), "1 to 3 \u00d7 the time of the default");
    assert.equal(words(2.2, 0.25), "from 4 \u00d7 faster than the default (place 1) to 2.2 \u00d7 its time (place 0)");
    assert.equal(words(0.8, 1.1), "from 20 % less time than the default (place 0) to 10 % more time (place 1)");
  });
  test("are listed", () => assert.equal(listed(["a", "b", "c"]), "a, b and c"));
});

describe("names", () => {
  const names = new Names({ experiments: { E1: { panels: { s7_wall: "brick wall" }, series: { "rooms-tested": "with room" }, settings: { "5 %": "5 % of the side" } } } });
  const given = (knobs) => experiment([row("s7_wall", "a", 1, 1, [1])], { knobs });

  test("are plain", () => {
    assert.equal(names.panel(given({}), "s7_wall"), "brick wall");
    assert.equal(names.candidate(given({}), "rooms-tested", "5 %"), "with room, 5 % of the side");
    assert.equal(names.candidate(given({ "": "tolerance" }), "FCL", "1e-6"), "FCL, tolerance 1e\u22126");
    assert.equal(names.candidate(given({ s7_wall: "substeps" }), "iterations=10", "1", "s7_wall"), "10 iterations, 1 substep");
    assert.equal(names.candidate(given({ s7_wall: "substeps" }), "iterations=10", "4", "s7_wall"), "10 iterations, 4 substeps");
    assert.equal(names.candidate(given({}), "sphere", "sphere"), "sphere");
    assert.equal(names.candidate(given({ "": "split_impulse" }), "warmstart=true", "true"), "warm starting on, split impulses on");
    assert.equal(names.candidate(given({ "": "friction_directions" }), "/bodies/0/ccd=false", "two"), "/bodies/0/ccd off, friction directions: two");
    assert.equal(names.candidate(given({ "": "/bodies/*/shape" }), "", "hull"), "/bodies/*/shape hull");
  });
  test("of metrics have units", () => {
    assert.equal(names.metricLabel(given({}), "penetration.p95"), "deepest contact (95 of 100 steps stay below), m");
    assert.equal(names.metricLabel(given({}), "trajectory.mean"), "distance from the reference run, mean of all steps, m");
    assert.equal(names.metricLabel(given({}), "some_error_m"), "some error, m");
    assert.equal(names.metricLabel(given({}), "cost"), "time, ms per simulated second");
    assert.equal(names.metricLabel(given({}), "stands"), "stands to the end (1: yes, 0: no)");
  });
  test("of statistics are told apart in sentences", () => {
    const nouns = (...keys) => keys.map((key) => names.metric(given({}), key).noun);
    assert.deepEqual(nouns("penetration", "penetration.p95"), ["penetration in the worst step", "penetration in 95 of 100 steps"]);
    assert.deepEqual(nouns("joint_error", "joint_error.mean"), ["gap of joints", "gap of joints on average"]);
  });
  test("are there for whatever the tool offers", { skip: !process.env.BOXSTREAM_TOOL }, () => {
    const offered = (option, other) => spawnSync(process.env.BOXSTREAM_TOOL, ["accuracy", "hard/free_fall", option, "nix=1", ...other]).stderr.toString().match(/there are ([\w, ]+)/)[1].trim().split(/, | or | and /);
    for (const key of offered("--metric", ["--knob", "substeps=1"])) assert.ok(plainNames.metrics[key], key);
    for (const key of offered("--knob", [])) assert.ok(plainNames.knobs[key], key);
  });
});

test("the same name has the same colour, and names of one plot differ", () => {
  const looks = styles([["a", "b"], ["c", "b"], Array.from({ length: 30 }, (_, i) => `n${i}`)]);
  assert.equal(looks.size, 33);
  assert.notDeepEqual(looks.get("c"), looks.get("b"));
  // Colours differ although "a" and "c" were not together at first.
  const later = styles([["a"], ["c"], ["a", "c"]]);
  assert.notEqual(later.get("a").color, later.get("c").color);
  // Lines without symbols differ as well.
  assert.equal(new Set(Array.from({ length: 30 }, (_, i) => `${looks.get(`n${i}`).color} ${looks.get(`n${i}`).dash}`)).size, 30);
});

test("colours of plots are others on a dark ground, at any depth", () => {
  setGround(true);
  try {
    const colours = [...partColours, ...Object.values(inks)];
    assert.deepEqual(colours.filter((colour) => tint(colour) === colour), []);
    assert.deepEqual(tinted({ a: [{ color: inks.text, n: 1 }], f: String }), { a: [{ color: tint(inks.text), n: 1 }], f: String });
    assert.match(tint("rgba(224, 124, 32, 0.500)"), /^rgba\(168, 86, 12, 0\.500\)$/);
  } finally {
    setGround(false);
  }
  assert.equal(tint(inks.text), inks.text);
});

describe("axes", () => {
  test("have their ticks at a knob's values", () => {
    const axis = axisOf([1, 2, 4, 8], { log: true, ticks: [1, 2, 4, 8] });
    assert.deepEqual(axis.option.axisTick.customValues.map(axis.option.axisLabel.formatter), ["1", "2", "4", "8"]);
  });
  test("have a place for zero below all else", () => {
    const axis = axisOf([0, 0.001, 1], { log: true });
    assert.ok(axis.place(0) < axis.place(0.001));
    assert.equal(axis.option.axisLabel.formatter(axis.place(0)), "0");
  });
  test("are linear where values are below zero", () => assert.equal(axisOf([-1, 1], { log: true }).log, false));
});

test("slopes are those of power laws", () => {
  assert.ok(Math.abs(slope([1, 2, 4, 8], [3, 12, 48, 192]) - 2) < 1e-12);
  assert.equal(slope([1, 2], [1, 2]), null);
});

describe("plots", () => {
  const rows = [row("wall", "a", 1, 1, [0.9]), row("wall", "a", 2, 2, [0.5]), row("wall", "b", 1, 3, [null], { failure: "exploded" }), row("hill", "a", 1, null, [null], { failure: "exploded" })];
  const curves = [["wall", "a", "1", [0, 1], [1e-9, 1]]];
  const made = experiment(rows, { curves });
  const style = () => ({ color: "#123456", symbol: "circle", dash: "solid" });
  const context = { experiment: made, names: new Names(), style, escape: (text) => text, points: (panel) => made.table.points.filter((point) => point.panel === panel) };

  for (const spec of [{ kind: "front", y: "error_m" }, { kind: "lines", y: "error_m", log: "xy" }, { kind: "bars", y: "error_m" }, { kind: "heat", y: "error_m" }, { kind: "heat", y: "error_m", x: "x" }])
    test(`a failure is a cross and said: ${JSON.stringify(spec)}`, () => {
      const plot = plotOf(context, spec);
      assert.equal(plot.failed, true);
      const items = plot.panels.flatMap(({ option }) => option.series.flatMap((series) => series.data));
      assert.ok(items.some((item) => item?.failed && item.hover.includes("exploded")));
      assert.ok(items.some((item) => item?.hover?.includes("0.9")));
    });
  test("a panel where all failed is still there", () => assert.deepEqual(plotOf(context, { kind: "lines", y: "error_m" }).panels.map(({ panel }) => panel), ["wall", "hill"]));
  test("curves are values over time", () => assert.deepEqual(plotOf(context, { kind: "curves", y: "distance_m" }).panels[0].option.series[0].data, [[0, 1e-9], [1, 1]]));
  test("curves have the looks of their series, and a panel for each setting where a series has several", () => {
    const ofSeries = (key) => ({ color: key === "a" ? "#aaaaaa" : "#bbbbbb", symbol: "circle", dash: "solid" });
    const curve = (series, setting, last) => ["wall: speed", series, setting, [0, 1], [0, last]];
    const spec = { kind: "curves", y: "speed" };
    const drawn = (all) => plotOf({ ...context, experiment: { ...made, curves: all }, style: ofSeries }, spec);
    const { panels, legend } = drawn([curve("a", "1", 2), curve("b", "1", 3), curve("a", "2", 9), curve("b", "2", 5), ["wall: depth", "a", "1", [0], [7]]]);
    assert.deepEqual(panels.map(({ title }) => title), ["wall, 1", "wall, 2"]);
    assert.deepEqual(panels.map(({ option }) => option.series.map(({ lineStyle }) => lineStyle.color)), [["#aaaaaa", "#bbbbbb"], ["#aaaaaa", "#bbbbbb"]]);
    assert.deepEqual(panels.map(({ option }) => [option.yAxis.min, option.yAxis.max]), [[0, 9], [0, 9]]);
    assert.deepEqual(legend.map(({ name }) => name), ["a", "b"]);
    const quantiles = drawn([curve("a", "1, 10 %", 1), curve("a", "1, 50 %", 2), curve("b", "1, 50 %", 3)]);
    assert.deepEqual(quantiles.panels.map(({ title, option }) => [title, option.series.map(({ lineStyle }) => lineStyle.width > 1)]), [["wall", [false, true, true]]]);
    assert.match(quantiles.note, /half of the runs/);
  });
  test("fronts and lines have the panels that they name", () => {
    for (const kind of ["front", "lines"]) assert.deepEqual(plotOf(context, { kind, y: "error_m", panel: "hill" }).panels.map(({ panel }) => panel), ["hill"]);
  });
  test("lines have intervals where the table has them", () => {
    const rated = experiment([row("wall", "a", 1, 1, [4, 3, 6]), row("wall", "a", 2, 1, [5, 4, 7])], { metrics: ["rate", "rate.low", "rate.high"] });
    const plot = plotOf({ ...context, experiment: rated, points: () => rated.table.points }, { kind: "lines", y: "rate" });
    assert.deepEqual(plot.panels[0].option.series.find(({ type }) => type === "custom").data, [[1, 3, 6], [2, 4, 7]]);
    assert.match(plot.note, /95 %/);
    assert.match(plot.panels[0].option.series[0].data[0].hover, /3 to 6/);
    assert.equal(plotOf(context, { kind: "lines", y: "error_m" }).note.includes("95 %"), false);
  });
  describe("maps", () => {
    const cells = (values, spec, expect = []) => {
      const table = experiment(values.map((value, i) => row(`p${i}`, "a", 1, 1, [value])), { expect });
      const plot = plotOf({ ...context, experiment: table, points: () => [] }, { kind: "heat", y: "error_m", ...spec });
      const kind = (fill) => (fill.startsWith("rgba(224") ? "orange" : fill.startsWith("rgba(38") ? "green" : fill);
      const { data } = plot.panels[0].option.series[0];
      return { kinds: data.map(({ fill }) => kind(fill)), depths: data.map(({ fill }) => Number(/([\d.]+)\)$/.exec(fill)?.[1] ?? 0)), note: plot.note };
    };
    test("tell better from worse beside a neutral value", () => {
      const found = cells([0.5, 0.952, 1, 1.0003, 1.048, 1.5], { neutral: 1 });
      assert.deepEqual(found.kinds, ["green", "green", "#f1f1f1", "#f1f1f1", "orange", "orange"]);
      assert.ok(found.depths[0] > found.depths[1] && found.depths[5] > found.depths[4]);
      assert.match(found.note, /Green: less than 1, which is better/);
      assert.deepEqual(cells([0.5, 1.5], { neutral: 1, better: "high" }).kinds, ["orange", "green"]);
    });
    test("have one right value without it", () => {
      assert.deepEqual(cells([0, 1], {}).kinds, ["#d9efe2", "orange"]);
      const found = cells([0, 1], {}, [{ text: "t", metric: "error_m", op: "==", value: 1 }]);
      assert.deepEqual([found.kinds, found.note], [["orange", "#d9efe2"], "Green: as it should be (1). The deeper the orange, the worse."]);
      const { depths } = cells([0, 1, 80], { better: "high" });
      assert.ok(depths[1] > depths[2] && depths[2] > 0);
    });
  });
  test("names under each other have room for all their lines", () => {
    const long = "order of the broad-phase's pairs, as Bullet's dynamic tree (dbvt) has them";
    const wordy = experiment([row("wall", long, 1, 1, [1]), row("wall", "b", 1, 1, [1])]);
    for (const kind of ["heat", "bars"]) {
      const [{ option, height }] = plotOf({ ...context, experiment: wordy, points: () => wordy.table.points }, { kind, y: "error_m" }).panels;
      const lines = option.yAxis.axisLabel.formatter(long).split("\n").length;
      assert.ok(lines > 2 && height > 2 * 12 * lines + 40, `${kind}: ${lines} lines, ${height} px`);
      assert.equal(option.yAxis.axisLabel.formatter("boxes with a margin of 0.05 m"), "boxes with a margin of\n0.05 m");
    }
  });
  test("of prices name effects in words", () => {
    const { effects } = JSON.parse(readFileSync(new URL("../../../../demos/simulation/effects/prices.json", import.meta.url), "utf8"));
    const names = pricesPlot({ effects }, (text) => text).panels[0].option.yAxis.data;
    assert.deepEqual(names.filter((name) => ["exclusions", "out of bounds", "forced boxes"].includes(name) || name.includes("_")), []);
    assert.deepEqual(names.length, Object.keys(effects).length);
  });
  test("what cannot be drawn is said", () => assert.match(plotOf(context, { kind: "front", y: "beauty" }).missing, /no beauty/));
  test("axes have units", () => {
    const { option } = plotOf(context, { kind: "front", y: "error_m" }).panels[0];
    assert.deepEqual([option.xAxis.name, option.yAxis.name], ["ms per simulated second", "error, m"]);
  });
});
