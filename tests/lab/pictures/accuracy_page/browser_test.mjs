// SPDX-License-Identifier: MIT
// The page that `boxstream accuracy --page` makes of a scene, in Chromium without a window.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open } from "../../../../demos/pictures/viewer/browser.mjs";

const directory = mkdtempSync(join(tmpdir(), "boxstream-accuracy-"));
let browser;
let run;
let stack;

/** A stack of crates above the floor, as a user might name and place it. */
const ownScene = {
  format: 1,
  meta: { name: "My-Robot 2", about: "Crates above the floor.", source: "made" },
  time: { dt: 0.0166667, steps: 60 },
  world: { bounds: { min: [-9, -9, -9], max: [9, 9, 9] } },
  solver: { iterations: 20 },
  shapes: [{ name: "cube", type: "box", half_extents: [0.5, 0.5, 0.5] }, { name: "ground", type: "box", half_extents: [9, 1, 9] }],
  bodies: [{ shape: "ground", type: "static", position: [0, -1, 0] }],
  generators: [{ type: "grid", count: 3, columns: [1, 1], spacing: [1, 1.05, 1], origin: [0, 0.55, 0], mix: [{ shape: "cube", mass: 1, sleep: false }] }],
};

/** A ball that falls for a second; a run of half a step is half as far from the truth. */
const fall = {
  format: 1,
  meta: { name: "free_fall", about: "A ball falls for a second.", source: "made" },
  time: { dt: 0.016666666666666666, steps: 60 },
  world: { bounds: { min: [-5, 0, -5], max: [5, 12, 5] } },
  shapes: [{ name: "ball", type: "sphere", radius: 0.5 }],
  bodies: [{ name: "ball", shape: "ball", mass: 1, position: [0, 10, 0] }],
};

async function pageOf(scene, name, options) {
  const file = join(directory, name);
  execFileSync(process.env.BOXSTREAM_TOOL, ["accuracy", scene, ...options, "--page", file], { stdio: "pipe" });
  return open(browser, file, { hash: "", width: 390, height: 800, ready: (page) => page.waitForSelector("body[data-complete]") });
}

const metrics = (...names) => names.flatMap((name) => ["--metric", name]);

before(async () => {
  browser = await launch();
  const falling = join(directory, "fall.json");
  writeFileSync(falling, JSON.stringify(fall));
  run = await pageOf(falling, "fall.html", ["--knob", "iterations=5,10", "--knob", "substeps=1,2,4", ...metrics("trajectory.last"), "--repeats", "2", "--bound", "50mm"]);
  const scene = join(directory, "my robot.json");
  writeFileSync(scene, JSON.stringify(ownScene));
  stack = await pageOf(scene, "my stack.html", ["--knob", "warmstart=true,false", "--knob", "iterations=5,10", ...metrics("joint_error", "agrees_for", "stands", "energy_change"), "--repeats", "1"]);
});

after(async () => {
  await browser?.close();
  rmSync(directory, { recursive: true, force: true });
});

test("shows the scene", async () => {
  assert.match(await run.page.textContent("h1"), /free_fall/);
  assert.ok(await run.page.$eval(".scenes img", async (image) => (await image.decode(), image.naturalWidth === 240)));
});

test("begins with the bound that was asked for", async () => {
  assert.equal(await run.page.inputValue(".bounds input"), "0.05");
  assert.match(await run.page.textContent(".answer b"), /2 substeps/);
});

test("tells which settings no other beats, where there is no bound", async () => {
  await run.page.fill(".bounds input", "");
  assert.match(await run.page.textContent(".answer"), /^Sound settings that no other beats.*4 substeps/);
});

test("tells which setting keeps a bound", async () => {
  // A second's fall in steps of h is g h / 2 too deep: 82, 41 and 20 mm, less that of the reference.
  await run.page.fill(".bounds input", "0.03");
  assert.match(await run.page.textContent(".answer b"), /4 substeps/);
  await run.page.fill(".bounds input", "0.001");
  assert.match(await run.page.textContent(".answer"), /^No measured setting keeps/);
});

test("compares with the scene as it is", async () => {
  await run.page.fill(".bounds input", "0.03");
  assert.match(await run.page.textContent(".answer"), /\(compared with 10 iterations, 1 substep, the default\)/);
});

test("marks the bound, what it costs, the reference's band and the setting to take", async () => {
  await run.page.$$eval(".chart", (all) => all.forEach((place) => place.draw()));
  const words = await run.page.$$eval(".chart svg text", (all) => all.map((text) => text.textContent));
  for (const word of [/^at most 50 mm$/, /^take$/, /^as it is$/, /^4$/]) assert.ok(words.some((text) => word.test(text)), `${word}: ${words}`);
  assert.match(await run.page.textContent(".findings"), /^reference128 substeps.*advice.*substeps=2/s);
  assert.match(await run.page.textContent("#scene-1-precision .legend"), /10 iterations: order 1(\.\d)?, [\d.]+ ms at the bound/);
  assert.match(await run.page.textContent("#scene-1-precision > .small"), /Shaded: what the reference cannot tell apart.*Dashed: the bound/);
});

test("draws plots, no wider than the window", async () => {
  const drawn = await run.page.$$eval(".chart", (all) => all.map((place) => (place.draw(), place.querySelectorAll("svg path").length)));
  assert.ok(drawn.length === 1 && drawn.every((marks) => marks > 3), String(drawn));
  assert.ok((await run.page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
});

test("shows a scene whose name has capitals, blanks and hyphens", async () => assert.equal((await stack.page.$$(".scenes img")).length, 1));

test("asks in the direction in which a metric is better", async () => {
  assert.deepEqual(await stack.page.$$eval(".bounds label", (all) => all.map((label) => label.textContent.trim().replace(/.*, /, ""))), ["at least", "stands to the end", "up or down by at most"]);
  await stack.page.check(".bounds input[type=checkbox]");
  // No measured setting has the 20 iterations of the scene, so there is no default.
  assert.match(await stack.page.textContent(".answer"), /^Take .*the first measured/);
  assert.doesNotMatch(await stack.page.textContent(".answer"), /default/);
  // Falling loses energy: the change is below zero, and further from it than the bound.
  await stack.page.fill(".bounds label:last-child input", "1e-9");
  assert.match(await stack.page.textContent(".answer"), /^No measured setting .*energy \(share\) 0\.\d+\.$/);
});

test("says what does not apply, and draws it not", async () => {
  assert.match(await stack.page.textContent("#summary"), /Widest gap of a joint does not apply to this scene: it needs joints\./);
  assert.equal((await stack.page.$$("figure[id^=scene-]")).length, 3);
});

test("names settings in words", async () => assert.match(await stack.page.textContent("#scene-1-precision"), /warm starting off/));

test("says how to make it again", async () => {
  const command = await stack.page.textContent("#scene > p > code");
  assert.equal(command, `boxstream accuracy '${directory}/my robot.json' --knob warmstart=true,false --knob iterations=5,10 --metric joint_error --metric agrees_for --metric stands --metric energy_change --repeats 1 --page '${directory}/my stack.html'`);
});

test("speaks to a user", async () => assert.doesNotMatch(await stack.page.textContent("main"), /in scene|commit|nobody has said/));

test("was quiet all the time", () => assert.deepEqual([...run.problems, ...stack.problems], []));
