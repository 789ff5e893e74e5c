// SPDX-License-Identifier: MIT
// What the page of the stored tables says: node sentences_test.mjs; BOXSTREAM_PAGE is the page.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { test } from "node:test";
import { advices } from "../../../../../demos/pictures/accuracy_page/src/advice.js";
import { constants } from "../../../../../demos/pictures/accuracy_page/src/constants.js";
import { experimentOf, matching, verdicts } from "../../../../../demos/pictures/accuracy_page/src/data.js";
import { Names } from "../../../../../demos/pictures/accuracy_page/src/names.js";
import { panelsOf, specsOf } from "../../../../../demos/pictures/accuracy_page/src/plots.js";
import { plainNames } from "../../../../../demos/pictures/accuracy_page/src/plain_names.js";

const file = process.env.BOXSTREAM_PAGE;
const data = JSON.parse(readFileSync(file, "utf8").split('id="data">')[1].split("</script>")[0]);
const experiments = data.experiments.map(experimentOf).filter((experiment) => experiment.table);
const names = new Names(data.names);

test("the page is below 4 MB", () => assert.ok(statSync(file).size < 4e6));

test("what does not change with its knob has a sentence", () => {
  const unsaid = experiments.flatMap((experiment) => constants(experiment, names).filter(({ why }) => !why).map(({ metric, panel, series, alike }) => `${experiment.id}: ${metric ?? ""} of ${series ?? alike ?? "all"} on ${panel}`));
  assert.deepEqual(unsaid, []);
});

test("such sentences are about what does not change", () => {
  const stale = experiments.flatMap((experiment) => {
    const found = constants(experiment, names);
    return experiment.constant.filter((entry) => !found.some(({ said }) => said === entry)).map((entry) => `${experiment.id}: ${JSON.stringify(entry)}`);
  });
  assert.deepEqual(stale, []);
});

test("a front is about settings that a user chooses", () => {
  const asked = experiments.flatMap((experiment) => {
    const questions = experiment.advice.filter(({ over }) => over === "setting").flatMap(({ panel }) => matching(experiment.table.points, { panel }).map((point) => point.panel));
    return specsOf(experiment).filter(({ kind }) => kind === "front").flatMap((spec) => panelsOf(experiment, spec).filter((panel) => questions.includes(panel)).map((panel) => `${experiment.id}: ${spec.y} on ${panel}`));
  });
  assert.deepEqual(asked, []);
});

test("criteria and titles of plots are plain", () => {
  const said = experiments.flatMap(({ expect, plots }) => [...expect.map(({ text }) => text), ...plots.map(({ title }) => title)]);
  assert.deepEqual(said.filter((text) => /\bours\b|over the knob|[a-z]_[a-z]/i.test(text ?? "")), []);
});

test("bounds of one advice have words of their own", () => {
  const twice = experiments.flatMap((experiment) => experiment.advice.filter(({ bounds }) => new Set(bounds.map(({ metric }) => names.metric(experiment, metric).noun)).size < bounds.length).map((entry) => `${experiment.id}: ${entry.for}`));
  assert.deepEqual(twice, []);
});

test("what is broken has a sentence", () => {
  const broken = experiments.flatMap(verdicts).filter((verdict) => verdict.state === "broken");
  assert.deepEqual(broken.filter((verdict) => !verdict.means).map((verdict) => verdict.text), []);
});

test("what is broken says whose limit it is, and such words are about what is broken", () => {
  const all = experiments.flatMap((experiment) => verdicts(experiment).map((verdict) => ({ ...verdict, id: experiment.id })));
  assert.deepEqual(all.filter(({ state, limit }) => (state === "broken") !== Boolean(limit)).map(({ id, text, state }) => `${id}: ${text} (${state})`), []);
});

test("a limit of others is not boxstream's", () => {
  const wrong = experiments.flatMap((experiment) => verdicts(experiment).filter(({ limit, broken }) => limit && limit !== "boxstream" && broken.some((point) => point.series.startsWith("boxstream::"))).map(({ text }) => `${experiment.id}: ${text}`));
  assert.deepEqual(wrong, []);
});

test("the default is what a user has who chooses nothing, or has a name of its own", () => {
  const own = { iterations: "10", substeps: "1", contact_erp: "0.2", gyro: "conserving", friction_directions: "two", solver: "sequential_impulses", ccd: "as called for", threads: "1 thread" };
  // Knobs of narrow phases, such as P7's iterations, are others.
  const wrong = experiments.filter(({ id }) => id.startsWith("S")).flatMap((experiment) =>
    experiment.advice.filter((entry) => entry.default && !entry.default.called).flatMap(({ default: standard }) => {
      const knob = Object.values(experiment.knobs)[0];
      const parts = [...String(standard.series ?? "").split(/,? (?=\w+=)/).map((part) => part.split("=")), [knob, String(standard.setting ?? own[knob])]];
      return parts.filter(([name, value]) => name in own && value !== undefined && value.split(",")[0] !== own[name]).map(([name, value]) => `${experiment.id}: ${name} ${value}`);
    }),
  );
  assert.deepEqual(wrong, []);
});

test("every experiment stands in one group", () => {
  const grouped = data.names.groups.flatMap((group) => group.experiments);
  assert.deepEqual([...grouped].sort(), data.experiments.map(({ id }) => id).sort());
});

test("what cannot be compared has a sentence, and such sentences are about what cannot", () => {
  const all = experiments.flatMap(verdicts);
  assert.deepEqual(all.filter(({ state, without }) => (state === "not comparable") !== Boolean(without)).map(({ text }) => text), []);
});

test("names are plain, and metrics have entries", () => {
  const raw = experiments.flatMap((experiment) => [
    ...experiment.table.points.flatMap((point) => [names.panel(experiment, point.panel), names.candidate(experiment, point.series, point.setting, point.panel)]).filter((name) => /[_=]|^[a-z]\d|^[a-z]+(-[a-z0-9]+)+$/.test(name)),
    ...experiment.table.metrics.filter((metric) => !names.find(experiment, "metrics", metric)),
  ]);
  assert.deepEqual([...new Set(raw)], []);
});

test("names name what there is", () => {
  const unknown = Object.entries(data.names.experiments).flatMap(([id, kinds]) => {
    const points = experiments.find((experiment) => experiment.id === id)?.table.points ?? [];
    return ["panels", "series"].flatMap((kind) => Object.keys(kinds[kind] ?? {}).filter((key) => !points.some((point) => point[kind === "series" ? kind : "panel"] === key)));
  });
  assert.deepEqual(unknown, []);
  assert.ok(Object.keys(plainNames.metrics).length > 10);
});

test("five kinds of user have a setting to take, each in experiments that there are", () => {
  assert.deepEqual(data.names.users.map((user) => user.id), ["games", "robotics", "machinery", "granular", "batch"]);
  const named = (wanted) => wanted.split("#");
  const adviceOf = (id) => advices(experiments.find((experiment) => experiment.id === id) ?? { advice: [] });
  for (const user of data.names.users) {
    assert.deepEqual(user.experiments.map(named).filter(([id, number = 1]) => adviceOf(id).length < number), [], user.id);
    assert.ok(user.experiments.some((wanted) => adviceOf(named(wanted)[0]).some((advice) => advice.choice)), user.id);
  }
});
