// SPDX-License-Identifier: MIT
// The report as people see it, in Chromium without a window. BOXSTREAM_PAGE is the page.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open } from "../../../../demos/pictures/viewer/browser.mjs";

const width = 1280;
const height = 800;
let browser;
let run;

before(async () => {
  browser = await launch();
  run = await open(browser, process.env.BOXSTREAM_PAGE, { hash: "", width, height, ready: () => {} });
});

after(async () => {
  await browser?.close();
});

test("the summary is on the first screen", async () => {
  const box = await run.page.locator("#summary").boundingBox();
  assert.ok(box.y >= 0 && box.height > 100, JSON.stringify(box));
  assert.ok(box.y + box.height <= height, `the summary ends at ${Math.round(box.y + box.height)} of ${height}`);
  assert.ok(await run.page.isVisible("#summary table.advice"));
});

test("nothing is wider than the window", async () => {
  assert.ok((await run.page.evaluate(() => document.documentElement.scrollWidth)) <= width);
});

test("the screen is not blank", async () => {
  const picture = (await run.page.screenshot()).toString("base64");
  const dark = await run.page.evaluate(async (data) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const context = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data: bytes } = context.getImageData(0, 0, image.width, image.height);
    let count = 0;
    for (let i = 0; i < bytes.length; i += 4) count += bytes[i] + bytes[i + 1] + bytes[i + 2] < 384;
    return count / (bytes.length / 4);
  }, picture);
  assert.ok(dark > 0.005 && dark < 0.5, `${dark} of the screen is dark`);
});

test("every plot is there, with text in it", async () => {
  const plots = await run.page.$$eval("figure svg", (all) => all.map((svg) => {
    const { width, height } = svg.getBoundingClientRect();
    const words = [...svg.querySelectorAll("text")].filter((text) => text.getBoundingClientRect().width > 0).length;
    return { name: svg.parentElement.id, width, height, words };
  }));
  assert.ok(plots.length > 1);
  for (const plot of plots) assert.ok(plot.width > 100 && plot.height > 50 && plot.words > 3, JSON.stringify(plot));
});

test("links of the summary lead to sections", async () => {
  const targets = await run.page.$$eval('#summary a, nav a', (all) => all.map((link) => link.hash.slice(1)));
  assert.ok(targets.length > 1);
  for (const target of targets) assert.ok(await run.page.locator(`section[id="${target}"]`).count(), target);
});

test("a table can be saved", async () => {
  const [file] = await Promise.all([run.page.waitForEvent("download"), run.page.click('a[download$=".csv"]')]);
  assert.match(file.suggestedFilename(), /\.csv$/);
});

test("was quiet all the time", () => {
  assert.deepEqual(run.problems, []);
});
