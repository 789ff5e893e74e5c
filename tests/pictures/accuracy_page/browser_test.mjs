// SPDX-License-Identifier: MIT
// The page that `boxstream accuracy --page` makes of a scene, in Chromium without a window.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open } from "../../../demos/pictures/viewer/browser.mjs";

const directory = mkdtempSync(join(tmpdir(), "boxstream-accuracy-"));
let browser;
let run;

before(async () => {
  const file = join(directory, "fall.html");
  const knobs = ["--knob", "iterations=5,10", "--knob", "substeps=1,2,4"];
  execFileSync(process.env.BOXSTREAM_TOOL, ["accuracy", "hard/free_fall", ...knobs, "--metric", "trajectory.last", "--repeats", "2", "--page", file], { stdio: "pipe" });
  browser = await launch();
  run = await open(browser, file, { hash: "", width: 390, height: 800, ready: (page) => page.waitForSelector("body[data-complete]") });
});

after(async () => {
  await browser?.close();
  rmSync(directory, { recursive: true, force: true });
});

test("shows the scene", async () => {
  assert.match(await run.page.textContent("h1"), /free_fall/);
  assert.ok(await run.page.$eval(".scenes img", async (image) => (await image.decode(), image.naturalWidth === 240)));
});

test("tells which settings no other beats", async () => assert.match(await run.page.textContent(".answer"), /4 substeps/));

test("tells which setting keeps a bound", async () => {
  // A second's fall in steps of h is g h / 2 too deep: 82, 41 and 20 mm, less that of the reference.
  await run.page.fill(".bounds input", "0.03");
  assert.match(await run.page.textContent(".answer b"), /4 substeps/);
  await run.page.fill(".bounds input", "0.001");
  assert.match(await run.page.textContent(".answer"), /^No measured setting keeps/);
});

test("draws plots, no wider than the window", async () => {
  const drawn = await run.page.$$eval(".chart", (all) => all.map((place) => (place.draw(), place.querySelectorAll("svg path").length)));
  assert.ok(drawn.length === 2 && drawn.every((marks) => marks > 3), String(drawn));
  assert.ok((await run.page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
});

test("was quiet all the time", () => assert.deepEqual(run.problems, []));
