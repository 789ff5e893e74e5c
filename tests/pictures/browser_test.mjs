// SPDX-License-Identifier: MIT
// The viewer as people use it, in Chromium without a window: node browser_test.mjs BOXSTREAM MIXED.json
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open, settled } from "../../demos/pictures/viewer/browser.mjs";

const tool = process.env.BOXSTREAM_TOOL;
const mixed = process.env.BOXSTREAM_MIXED_SCENE;
const directory = mkdtempSync(join(tmpdir(), "boxstream-view-"));
const steps = 200;
let browser;
let run;

const simulate = (scene, file, ...more) => execFileSync(tool, ["simulate", scene, "--view", file, ...more], { stdio: "pipe" });
const state = () => run.page.evaluate(() => ({ step: boxstreamViewer.player.step, playing: boxstreamViewer.player.playing, colour: boxstreamViewer.colours.mode, overlays: { ...boxstreamViewer.overlays } }));

/** The picture of the scene, without what stands around it. */
async function picture() {
  await settled(run.page);
  return run.page.screenshot({ clip: { x: 0, y: 180, width: 760, height: 180 } });
}

async function press(...keys) {
  for (const key of keys) await run.page.keyboard.press(key);
  await settled(run.page);
}

before(async () => {
  const file = join(directory, "mixed.html");
  simulate(mixed, file, "--steps", String(steps));
  browser = await launch();
  run = await open(browser, file, { hash: "paused&plain", width: 760, height: 600 });
});

after(async () => {
  await browser?.close();
  rmSync(directory, { recursive: true, force: true });
});

test("shows what the run is about", async () => {
  assert.equal(await run.page.textContent("#title"), "mixed");
  assert.match(await run.page.textContent("#about"), /At least one of everything/);
  assert.match(await run.page.textContent("#facts"), /Broad-phase boxstream/);
  assert.deepEqual(await state(), { step: 0, playing: false, colour: "created", overlays: { boxes: false, pairs: false } });
});

test("plays, and stops again", async () => {
  await run.page.click("#play");
  await run.page.waitForFunction(() => boxstreamViewer.player.step > 3);
  assert.equal((await state()).playing, true);
  await run.page.click("#play");
  const { step, playing } = await state();
  assert.equal(playing, false);
  assert.ok(step > 3);
  await settled(run.page);
  assert.equal((await state()).step, step);
});

test("goes to any frame, and looks different there", async () => {
  const pictures = [];
  for (const place of [0, 0.5, 1]) {
    await run.page.locator("#scrubber").evaluate((slider, at) => {
      slider.value = Math.round(at * slider.max);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    }, place);
    pictures.push(await picture());
    assert.equal((await state()).step, place * steps);
    assert.equal(await run.page.textContent("#step"), String(place * steps));
  }
  for (const [a, b] of [[0, 1], [1, 2], [0, 2]]) assert.ok(!pictures[a].equals(pictures[b]), `pictures ${a} and ${b}`);
});

test("goes there by keys", async () => {
  await press("Home");
  assert.equal((await state()).step, 0);
  await press("ArrowRight", "ArrowRight", "ArrowLeft");
  assert.equal((await state()).step, 1);
  await press("Shift+ArrowRight");
  assert.equal((await state()).step, 11);
  await press("End");
  assert.equal((await state()).step, steps);
  const end = await picture();
  await press("Home", "End");
  assert.ok(end.equals(await picture()), "the same frame looks the same again");
});

test("a click into the graphs goes to that step", async () => {
  const box = await run.page.locator("#graphs").boundingBox();
  await run.page.mouse.click(box.x + box.width * 0.25, box.y + box.height / 2);
  await settled(run.page);
  const { step } = await state();
  assert.ok(Math.abs(step - steps / 4) <= 1, `step ${step}`);
  await run.page.mouse.move(10, 300);
});

test("colours and overlays change the picture", async () => {
  await press("End");
  const pictures = new Map([["created", await picture()]]);
  for (const [key, mode] of [["2", "kind"], ["3", "island"], ["4", "asleep"], ["5", "pairs"]]) {
    await press(key);
    assert.equal((await state()).colour, mode);
    pictures.set(mode, await picture());
  }
  await press("1", "b");
  pictures.set("boxes", await picture());
  await press("b", "p");
  pictures.set("pairs overlay", await picture());
  await press("p");
  const list = [...pictures];
  for (let i = 0; i < list.length; ++i)
    for (let k = 0; k < i; ++k) assert.ok(!list[i][1].equals(list[k][1]), `${list[i][0]} looks like ${list[k][0]}`);
  assert.ok(pictures.get("created").equals(await picture()), "everything is as before");
});

test("says what was clicked", async () => {
  // A body that is in front: where the camera looks at one, the ray meets it or another one before it.
  const at = await run.page.evaluate(() => {
    const { viewport, poses, movers, frames } = boxstreamViewer;
    const object = movers.find((mover) => mover < frames.objects && poses.visible[mover]);
    const spot = viewport.controls.target.clone().fromArray(poses.places, 3 * object).project(viewport.camera);
    const { width, height } = viewport.renderer.domElement.getBoundingClientRect();
    return [((spot.x + 1) / 2) * width, ((1 - spot.y) / 2) * height];
  });
  await run.page.mouse.click(...at);
  await settled(run.page);
  assert.match(await run.page.textContent("#object"), /object\d+kind\w/);
  await press("Escape");
  assert.equal(await run.page.isVisible("#object"), false);
});

test("has help", async () => {
  await press("h");
  assert.equal(await run.page.isVisible("#helptext"), true);
  await press("Escape");
  assert.equal(await run.page.isVisible("#helptext"), false);
});

test("turns", async () => {
  const first = await picture();
  await run.page.mouse.move(380, 300);
  await run.page.mouse.down();
  await run.page.mouse.move(480, 290, { steps: 2 });
  await run.page.mouse.up();
  assert.ok(!first.equals(await picture()));
});

test("was quiet all the time", () => {
  assert.deepEqual(run.problems, []);
});

test("opens a run of 20 000 bodies", async () => {
  const file = join(directory, "storm.html");
  simulate("storm", file, "--steps", "8");
  const start = performance.now();
  const storm = await open(browser, file, { hash: "paused&plain", width: 760, height: 600, timeout: 120_000 });
  const opened = performance.now();
  await storm.page.keyboard.press("End");
  await settled(storm.page, 120_000);
  const moved = performance.now();
  console.log(`storm: ${(statSync(file).size / 1e6).toFixed(1)} MB for 9 frames, first picture after ${Math.round(opened - start)} ms, another frame after ${Math.round(moved - opened)} ms`);
  assert.equal(await storm.page.evaluate(() => boxstreamViewer.player.step), 8);
  assert.deepEqual(storm.problems, []);
  // With WebGL in software, on a busy machine; a graphics card takes a small part of it.
  assert.ok(opened - start < 60_000);
  assert.ok(moved - opened < 20_000);
  await storm.close();
});
