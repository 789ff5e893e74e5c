// SPDX-License-Identifier: MIT
// How the report looks, on a desktop and on a phone, light and dark: nothing sticks out, covers its neighbour or cannot be
// read. BOXSTREAM_PAGE is the page; pictures of it go to BOXSTREAM_PICTURES, if that is given.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { launch, open } from "../../../../../demos/pictures/viewer/browser.mjs";

const longest = 15_000; // pixels of a desktop, before anything is opened

let browser;

before(async () => {
  browser = await launch();
});

after(async () => {
  await browser?.close();
});

const draw = (page) => page.evaluate(() => { for (const place of document.querySelectorAll(".chart")) place.draw(); });

const openAll = (page) => page.evaluate(() => { for (const one of document.querySelectorAll("details.question")) one.reveal(); });

const picture = (page, name, options = {}) => (process.env.BOXSTREAM_PICTURES ? page.screenshot({ path: join(process.env.BOXSTREAM_PICTURES, `${name}.png`), ...options }) : null);

/** Texts of one plot that cover each other, each as "figure: text | text". Lines of one text may touch. */
const covered = () =>
  [...document.querySelectorAll(".chart")].flatMap((place) => {
    const words = [...place.querySelectorAll("svg text")].filter((one) => one.textContent.trim()).map((one) => ({ text: one.textContent, box: one.getBoundingClientRect() })).filter(({ box }) => box.width > 0);
    const common = (a, b, low, high) => Math.min(a[high], b[high]) - Math.max(a[low], b[low]);
    return words.flatMap((a, i) => words.slice(i + 1).filter((b) => common(a.box, b.box, "left", "right") > 2 && common(a.box, b.box, "top", "bottom") > 4).map((b) => `${place.closest("figure, article").id}: ${a.text} | ${b.text}`));
  });

/** Texts whose contrast is below that of WCAG 2.1, AA: 4.5, or 3 where they are large. */
const pale = () => {
  const parse = (colour) => {
    const [r, g, b, a = 1] = colour.match(/[\d.]+/g).map(Number);
    return { rgb: [r, g, b], a };
  };
  const over = (top, below) => top.rgb.map((part, i) => part * top.a + below[i] * (1 - top.a));
  const light = (rgb) => rgb.map((part) => part / 255).map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)).reduce((sum, part, i) => sum + part * [0.2126, 0.7152, 0.0722][i], 0);
  const contrast = (a, b) => {
    const [high, low] = [light(a), light(b)].sort((x, y) => y - x);
    return (high + 0.05) / (low + 0.05);
  };
  const ground = (element) => {
    const around = [];
    for (let one = element; one; one = one.parentElement) around.push(parse(getComputedStyle(one).backgroundColor));
    return around.reverse().reduce((below, layer) => over(layer, below), [255, 255, 255]);
  };
  /** A halo; else cells and bars of a plot that the middle of a text lies in. */
  const behind = (text) => {
    const { stroke, strokeWidth } = getComputedStyle(text);
    if (stroke !== "none" && Number.parseFloat(strokeWidth) >= 2) return parse(stroke).rgb;
    const box = text.getBoundingClientRect();
    const [x, y] = [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
    const fills = [...text.ownerSVGElement.querySelectorAll("path, rect")].filter((shape) => {
      const { left, right, top, bottom } = shape.getBoundingClientRect();
      return left < x && x < right && top < y && y < bottom && right - left < 400 && !["none", "transparent"].includes(getComputedStyle(shape).fill) && shape.compareDocumentPosition(text) & Node.DOCUMENT_POSITION_FOLLOWING;
    });
    return fills.map((shape) => { const fill = parse(getComputedStyle(shape).fill); return { ...fill, a: fill.a * Number(getComputedStyle(shape).fillOpacity) }; }).reduce((below, layer) => over(layer, below), ground(text.ownerSVGElement.parentElement));
  };
  const found = [];
  const judge = (element, colour, below) => {
    const style = getComputedStyle(element);
    const size = Number.parseFloat(style.fontSize);
    const least = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700) ? 3 : 4.5;
    const ratio = contrast(over(parse(colour), below), below);
    if (ratio < least) found.push(`${ratio.toFixed(2)}: ${element.textContent.trim().slice(0, 60)} (${element.closest("[id]")?.id})`);
  };
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const element = walk.currentNode.parentElement;
    if (!walk.currentNode.textContent.trim() || ["SCRIPT", "NOSCRIPT", "STYLE"].includes(element.tagName) || element.getClientRects().length === 0) continue;
    const text = element.closest("svg text");
    if (text) judge(text, getComputedStyle(text).fill, behind(text));
    else judge(element, getComputedStyle(element).color, ground(element));
  }
  return [...new Set(found)];
};

for (const width of [1280, 390])
  for (const scheme of ["light", "dark"])
    describe(`at ${width} pixels, ${scheme}`, () => {
      let run;

      before(async () => {
        run = await open(browser, process.env.BOXSTREAM_PAGE, { hash: "", width, height: 800, scheme, ready: (page) => page.waitForSelector("body[data-complete]") });
        await draw(run.page);
        await picture(run.page, `report-${width}-${scheme}`);
        await picture(run.page, `report-${width}-${scheme}-whole`, { fullPage: true });
      });

      test("the ground is as the browser prefers", async () => {
        const [red] = await run.page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
        assert.ok(scheme === "dark" ? red < 60 : red > 200, String(red));
      });

      test("is not too long before anything is opened", async () => {
        const height = await run.page.evaluate(() => document.documentElement.scrollHeight);
        assert.ok(height <= longest, `${height} px`);
      });

      test("markers of legends have shapes", async () => {
        const bare = await run.page.$$eval(".key > span, .legend button", (all) => all.filter((one) => !one.querySelector("svg path, svg circle, svg rect")).map((one) => one.textContent));
        assert.deepEqual(bare, []);
        // Neighbours differ without their colours.
        const alike = await run.page.$$eval(".key", (all) => all.filter((key) => { const marks = [...key.querySelectorAll("svg")].map((svg) => svg.innerHTML).slice(0, 3); return new Set(marks).size < marks.length; }).map((key) => key.textContent));
        assert.deepEqual(alike, []);
      });

      for (const [what, prepare] of [["before anything is opened", async () => {}], ["when all is open", openAll]])
        describe(what, () => {
          before(async () => {
            await prepare(run.page);
            await draw(run.page);
          });

          test("nothing is wider than the window", async () => assert.ok((await run.page.evaluate(() => document.documentElement.scrollWidth)) <= width));

          test("no words of a plot cover others", async () => assert.deepEqual(await run.page.evaluate(covered), []));

          test("all words can be read", async () => assert.deepEqual(await run.page.evaluate(pale), []));
        });

      test("was quiet all the time", () => assert.deepEqual(run.problems, []));
    });

test("light and dark can be chosen, and plots follow", async () => {
  const run = await open(browser, process.env.BOXSTREAM_PAGE, { hash: "", scheme: "dark", ready: (page) => page.waitForSelector("body[data-complete]") });
  await draw(run.page);
  const ink = () => run.page.$eval("#for-games svg text", (text) => getComputedStyle(text).fill);
  const before = await ink();
  await run.page.click("button.theme");
  assert.equal(await run.page.evaluate(() => document.documentElement.classList.contains("dark")), false);
  assert.notEqual(await ink(), before);
  assert.deepEqual(run.problems, []);
});

test("nothing moves by itself where less motion is wanted", async () => {
  const run = await open(browser, process.env.BOXSTREAM_PAGE, { hash: "S7", motion: "reduce", ready: (page) => page.waitForSelector("body[data-complete]") });
  await draw(run.page);
  assert.equal(await run.page.evaluate(() => document.getAnimations().length), 0);
});
