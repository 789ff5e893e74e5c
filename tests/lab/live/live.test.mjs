// SPDX-License-Identifier: MIT
// The live page in Chromium without a window and without a network.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { launch, open } from "../../../demos/pictures/viewer/browser.mjs";

const file = join(process.env.BOXSTREAM_WEB_PACKAGES, "live.html");
const inputs = ["U", "S", "lattice", "heap"];
const motions = ["brown", "fall", "static5", "teleport"];
let browser;

before(async () => (browser = await launch()));
after(async () => await browser?.close());

/** Calls `body` with the page at `hash`, and fails if the page complains or asks the network for anything. */
async function withPage(hash, { width, height }, body) {
  const ready = (page) => page.waitForFunction(() => window.boxstreamLive?.frames > 0, null, { polling: 50 });
  const { page, problems, close } = await open(browser, file, { hash, width, height, ready, timeout: 20_000 });
  await body(page);
  assert.deepEqual(problems, []);
  await close();
}

/** What the first check of one of frame `frame` or later says. */
async function checkOf(page, frame) {
  const check = await page.waitForFunction(
    (least) => {
      const { beside, lastCheck } = boxstreamLive;
      beside.hurry();
      return lastCheck?.frame >= least && lastCheck;
    },
    frame,
    { polling: 30 },
  );
  return check.jsonValue();
}

/** The part of a picture that is not as its corner is; of the scene, drawn just before. */
const drawnPart = (page, id) =>
  page.evaluate((name) => {
    boxstreamLive.stage.stale = true;
    boxstreamLive.stage.draw();
    const source = document.getElementById(name);
    const copy = Object.assign(document.createElement("canvas"), { width: source.width, height: source.height }).getContext("2d");
    copy.drawImage(source, 0, 0);
    const pixels = new Uint32Array(copy.getImageData(0, 0, source.width, source.height).data.buffer);
    return pixels.filter((pixel) => pixel !== pixels[0]).length / pixels.length;
  }, id);

/** Without waiting for frames, as a mouse would. */
const press = (page, selector) => page.evaluate((what) => document.querySelector(what).click(), selector);

const hidden = (page, id) => page.evaluate((name) => document.getElementById(name).hidden, id);

function assertEqualPairs(check, where) {
  assert.equal(`${check.missing} missing, ${check.extra} too many`, "0 missing, 0 too many", where);
}

test("frames follow each other and are drawn", { timeout: 30_000 }, () =>
  withPage("n=300", { width: 900, height: 640 }, async (page) => {
    const before = await page.evaluate(() => boxstreamLive.frames);
    await page.waitForFunction((frames) => boxstreamLive.frames > frames + 4, before);
    const scene = await drawnPart(page, "scene");
    assert.ok(scene > 0.05 && scene < 0.9, `${scene} of the scene is drawn`);
    assert.ok((await drawnPart(page, "plot")) > 0.05);
    await page.locator("#n").fill("1");
    await page.waitForFunction(() => boxstreamLive.stage.frame.boxes.length === 6 * 200);
  }));

test("pairs are equal for each input and motion", { timeout: 60_000 }, () =>
  withPage("n=200&size=1.5", { width: 400, height: 400 }, async (page) => {
    for (const input of inputs) {
      await press(page, `#input [data-value=${input}]`);
      for (const motion of motions) {
        await press(page, `#motion [data-value=${motion}]`);
        const check = await checkOf(page, 3);
        assertEqualPairs(check, `${input}, ${motion}, frame ${check.frame}`);
        if (input !== "lattice") assert.ok(check.pairs > 10, `${input}, ${motion}: ${check.pairs} pairs`);
      }
    }
    assert.ok(await hidden(page, "alarm"));
  }));

test("packages race beside findPairs, and find the same", { timeout: 30_000 }, () =>
  withPage("n=300&engine=search", { width: 700, height: 600 }, async (page) => {
    await page.click("#all");
    await page.waitForFunction(() => [...boxstreamLive.history.series].every(([name, times]) => name === "World" || times.length > 0));
    assertEqualPairs(await checkOf(page, 1), "findPairs");
    assert.ok(await hidden(page, "alarm"));
  }));

test("a wrong pair is noticed", { timeout: 30_000 }, () =>
  withPage("n=300", { width: 700, height: 600 }, async (page) => {
    await page.click("#spoil");
    await page.waitForSelector("#alarm:not([hidden])");
    const check = await page.evaluate(() => boxstreamLive.lastCheck);
    assert.deepEqual([check.missing, check.extra], [1, 1]);
    assert.match(await page.textContent("#alarmtitle"), /planted pair was noticed/);
    await page.click("#dismiss");
    assertEqualPairs(await checkOf(page, check.frame + 1), "after it");
  }));

test("nothing is wider than a phone", { timeout: 30_000 }, () =>
  withPage("n=300", { width: 390, height: 844 }, async (page) => {
    const wide = await page.evaluate(() =>
      [document.documentElement, ...document.querySelectorAll("body *")]
        .filter((one) => one.getBoundingClientRect().right > innerWidth + 0.5 || one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0)
        .map((one) => one.id || one.outerHTML.slice(0, 60)),
    );
    assert.deepEqual(wide, []);
  }));

test("the address is heeded where it makes sense", { timeout: 30_000 }, () =>
  withPage("n=300&size=abc&seed=", { width: 700, height: 600 }, async (page) => {
    const of = (hash) =>
      page.evaluate(async (text) => {
        location.hash = text;
        await new Promise((done) => addEventListener("hashchange", done, { once: true }));
        const { n, size, seed } = boxstreamLive.settings;
        return [n, size, seed].join(" ");
      }, hash);
    assert.equal(await page.evaluate(() => boxstreamLive.settings.size), 1);
    assert.equal(await of("#n=1e9&size=0.1&seed=7"), "1000000 0.2 7");
    assert.equal(await of("#n=0&size=9"), "100 3 1");
    assert.equal(await of("#paused=yes&n=abc"), "100000 1 1");
  }));

test("colours are explained, and ? lists the keys", { timeout: 30_000 }, () =>
  withPage("n=300", { width: 900, height: 640 }, async (page) => {
    assert.match(await page.textContent("#legend"), /touches none.*eight or more/);
    await press(page, "#view [data-value=begun]");
    assert.match(await page.textContent("#legend"), /just now/);
    await page.keyboard.press("?");
    assert.ok(await page.evaluate(() => document.getElementById("helptext").open));
    assert.match(await page.textContent("#keys"), /\?, H/);
  }));

test("boxes stand still for whoever asks for less motion", { timeout: 30_000 }, async () => {
  const ready = (page) => page.waitForFunction(() => window.boxstreamLive?.frames > 0, null, { polling: 50 });
  const { page, problems, close } = await open(browser, file, { hash: "n=300", motion: "reduce", ready, timeout: 20_000 });
  const frames = await page.evaluate(() => boxstreamLive.frames);
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => boxstreamLive.frames), frames);
  assert.equal(await page.textContent("#pause"), "Play");
  await press(page, "#pause");
  await page.waitForFunction((before) => boxstreamLive.frames > before + 2, frames);
  assert.deepEqual(problems, []);
  await close();
});

test("without WebGL the page says so", { timeout: 30_000 }, async () => {
  const context = await browser.newContext({ offline: true });
  const page = await context.newPage();
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
      return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...more);
    };
  });
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => /WebGL 2/.test(document.getElementById("loading").textContent));
  await context.close();
});
