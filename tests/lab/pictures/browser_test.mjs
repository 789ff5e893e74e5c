// SPDX-License-Identifier: MIT
// The viewer as people use it, in Chromium without a window.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open, settled } from "../../../demos/pictures/viewer/browser.mjs";

const tool = process.env.BOXSTREAM_TOOL;
const mixed = process.env.BOXSTREAM_MIXED_SCENE;
const directory = mkdtempSync(join(tmpdir(), "boxstream-view-"));
const file = join(directory, "mixed.html");
const compared = join(directory, "compared.html");
const steps = 200;
let browser;
let run;

const simulate = (scene, page, ...more) => execFileSync(tool, ["simulate", scene, "--view", page, ...more], { stdio: "pipe" });
const state = (page = run.page) =>
  page.evaluate(() => {
    const { player, colour, overlays, selected, path } = boxstreamViewer;
    return { step: player.step, playing: player.playing, colour, overlays: { ...overlays }, selected, chased: path.chased };
  });

/** The picture of the scene, without what stands around it. */
async function picture(page = run.page) {
  await settled(page);
  return page.screenshot({ clip: { x: 0, y: 180, width: 560, height: 180 } });
}

async function press(...keys) {
  for (const key of keys) await run.page.keyboard.press(key);
  await settled(run.page);
}

/** Where an object is on the page; it is seen there, or another one before it. */
const spotOf = (page, object) =>
  page.evaluate((wanted) => {
    const { viewport, worlds } = boxstreamViewer;
    const { poses, movers } = worlds[0];
    const spot = viewport.controls.target.clone().fromArray(poses.places, 3 * (wanted ?? movers.find((mover) => poses.visible[mover] && worlds[0].colours.kinds[mover] === "sphere"))).project(viewport.camera);
    const { left, top } = viewport.canvas.getBoundingClientRect();
    const { width, height } = viewport.rectangles[0];
    return [left + ((spot.x + 1) / 2) * width, top + ((1 - spot.y) / 2) * height];
  }, object);

before(async () => {
  simulate(mixed, file, "--steps", String(steps));
  simulate(mixed, compared, "--steps", "120", "--compare", "dbvt");
  browser = await launch();
  run = await open(browser, file, { hash: "paused&plain", width: 960, height: 700 });
});

after(async () => {
  await browser?.close();
  rmSync(directory, { recursive: true, force: true });
});

test("shows what the run is about", async () => {
  assert.equal(await run.page.textContent("#title"), "mixed");
  assert.match(await run.page.textContent("#about"), /At least one of everything/);
  assert.match(await run.page.textContent("#facts"), /broad-phase boxstream/);
  const overlays = { boxes: false, pairs: false, contacts: false, joints: true };
  assert.deepEqual(await state(), { step: 0, playing: false, colour: "created", overlays, selected: -1, chased: -1 });
});

test("unpacks what was recorded: as many pairs as were reported, and boxes of pairs that meet, or that contacts may bridge", async () => {
  const wrong = await run.page.evaluate(async () => {
    const [world] = boxstreamViewer.worlds;
    const { run: page, frames } = world;
    const found = [];
    let checked = 0;
    for (let index = 1; index < frames.count; ++index) {
      const frame = await frames.load(index);
      const { pairs } = frame;
      if (pairs.length / 2 !== page.series.pairs[index - 1]) found.push(`${pairs.length / 2} pairs in step ${index}, not ${page.series.pairs[index - 1]}`);
      for (let i = 0; i < pairs.length; i += 2) {
        const [a, b] = [world.boxIn(frame, pairs[i]), world.boxIn(frame, pairs[i + 1])];
        if (!a || !b) continue;
        ++checked;
        const gap = Math.max(...[0, 1, 2].map((d) => Math.max(a[0][d] - b[1][d], b[0][d] - a[1][d])));
        if (gap > 2 * 0.05 + 4.2 * page.unit) found.push(`step ${index}: ${gap / page.unit} units between the boxes of ${pairs[i]} and ${pairs[i + 1]}`);
      }
    }
    return checked > 20_000 ? found.slice(0, 5) : [`only ${checked} pairs`];
  });
  assert.deepEqual(wrong, []);
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
});

test("a click into the curves goes to that step, and they have axes with units", async () => {
  await run.page.waitForFunction(() => boxstreamViewer.graphs.chart);
  const [x, y] = await run.page.evaluate(() => {
    const { chart, place, dt } = boxstreamViewer.graphs;
    const { left, top } = place.getBoundingClientRect();
    const [across, down] = chart.convertToPixel({ gridIndex: 1 }, [50 * dt, 0]);
    return [left + across, top + down - 20];
  });
  await run.page.mouse.click(x, y);
  await settled(run.page);
  const { step } = await state();
  assert.ok(Math.abs(step - 50) <= 1, `step ${step}`);
  const labels = await run.page.evaluate(() => boxstreamViewer.graphs.chart.getZr().storage.getDisplayList().map((shape) => shape.style?.text).filter(Boolean));
  assert.ok(labels.some((label) => /^[\d.]+ s$/.test(label)), labels.join("; "));
  assert.ok(labels.some((label) => /(ms|\u00b5s)$/.test(label)), labels.join("; "));
  assert.ok(labels.every((label) => !/e[+-]\d/.test(label)), labels.join("; "));
  assert.match(await run.page.evaluate(() => boxstreamViewer.graphs.hover(9)), /step 10, 0\.17 s.*pairs: \d+.*Whole step: [\d.]+.(ms|\u00b5s)/s);
  await run.page.mouse.move(10, 300);
});

test("colours and overlays change the picture", async () => {
  await press("End", "f");
  const modes = await run.page.locator("#modes option").evaluateAll((options) => options.map((option) => option.value));
  assert.deepEqual(modes, ["created", "kind", "island", "asleep", "speed", "contacts", "pairs", "idle"]);
  await run.page.evaluate(() => boxstreamViewer.player.goToStep(100));
  const pictures = new Map();
  for (const [i, mode] of modes.entries()) {
    await press(String(i + 1));
    assert.equal((await state()).colour, mode);
    pictures.set(mode, await picture());
  }
  await press("1");
  for (const [key, overlay] of [["b", "boxes"], ["p", "pairs"], ["k", "contacts"]]) {
    await press(key);
    assert.equal((await state()).overlays[overlay], true);
    pictures.set(`overlay ${overlay}`, await picture());
    await press(key);
  }
  const list = [...pictures];
  for (let i = 0; i < list.length; ++i)
    for (let k = 0; k < i; ++k) assert.ok(!list[i][1].equals(list[k][1]), `${list[i][0]} looks like ${list[k][0]}`);
  assert.ok(pictures.get("created").equals(await picture()), "everything is as before");
});

test("counts contacts as Bullet does: a body that lies alone touches the floor", async () => {
  await run.page.evaluate(() => boxstreamViewer.player.goToStep(200));
  await settled(run.page);
  const lone = await run.page.evaluate(() => {
    const { colours, shown, movers } = boxstreamViewer.worlds[0];
    const { pairs, touching } = shown.frame;
    return { pairs: pairs.length / 2, touching: touching.reduce((sum, touches) => sum + touches, 0), most: Math.max(...movers.map((i) => colours.touchesOf[i] - colours.pairsOf[i])), contacts: shown.frame.contacts.anchors.length };
  });
  assert.ok(lone.most <= 0, "no body touches more than it is paired with");
  assert.ok(lone.touching > 30 && lone.touching < lone.pairs, `${lone.touching} of ${lone.pairs} pairs touch`);
  assert.ok(lone.contacts >= lone.touching);
});

test("says what was clicked, and follows it", async () => {
  await run.page.mouse.click(...(await spotOf(run.page)));
  await settled(run.page);
  const { selected } = await state();
  assert.ok(selected >= 0);
  const text = await run.page.textContent("#object");
  for (const word of ["kind", "place", "velocity", "m/s", "pairs"]) assert.ok(text.includes(word), `${word} in ${text}`);
  await press("t");
  assert.equal((await state()).chased, selected);
  await run.page.evaluate(() => boxstreamViewer.player.goToStep(20));
  await settled(run.page);
  const off = await run.page.evaluate((object) => {
    const { viewport, worlds } = boxstreamViewer;
    return viewport.controls.target.clone().fromArray(worlds[0].poses.places, 3 * object).distanceTo(viewport.controls.target);
  }, selected);
  assert.ok(off < 0.01, `the camera looks ${off} m beside it`);
  await press("Escape");
  assert.equal(await run.page.isVisible("#object"), false);
  assert.deepEqual([(await state()).selected, (await state()).chased], [-1, -1]);
});

test("finds bodies by their names and numbers", async () => {
  const find = async (words) => {
    await run.page.fill("#wanted", words);
    await run.page.keyboard.press("Enter");
    await settled(run.page);
    return (await state()).selected;
  };
  await press("/");
  const paddle = await find("paddle");
  assert.equal(await run.page.textContent("#name"), "paddle");
  assert.equal(await find("17"), 17);
  const [one, two] = [await find("pill"), await find("pill")];
  assert.ok(one >= 0 && two > one, `${one}, ${two}`);
  assert.match(await run.page.textContent("#found"), /2 of \d+/);
  assert.equal(await find("nothing of this name"), two);
  assert.equal(await run.page.textContent("#found"), "none");
  assert.ok(paddle >= 0);
  await press("Escape", "Escape");
});

test("has help, for all of its keys", async () => {
  await press("h");
  assert.equal(await run.page.isVisible("#helptext"), true);
  assert.ok((await run.page.locator("#keys kbd").count()) >= 28);
  await press("Escape");
  assert.equal(await run.page.isVisible("#helptext"), false);
});

test("turns, and fits again", async () => {
  await press("f");
  const distance = () => run.page.evaluate(() => boxstreamViewer.viewport.camera.position.distanceTo(boxstreamViewer.viewport.controls.target));
  const [first, before] = [await picture(), await distance()];
  await run.page.mouse.move(380, 300);
  await run.page.mouse.down();
  await run.page.mouse.move(480, 290, { steps: 2 });
  await run.page.mouse.up();
  assert.ok(!first.equals(await picture()));
  await run.page.mouse.wheel(0, 600);
  await run.page.waitForTimeout(300);
  assert.ok((await distance()) > 1.05 * before);
  await press("f");
  assert.ok(Math.abs((await distance()) / before - 1) < 0.2);
});

/** How much of the height or width of the view the crowd takes. */
const share = (page) =>
  page.evaluate(() => {
    const { path, player, viewport } = boxstreamViewer;
    const { min, max } = path.crowd(player);
    const spots = Array.from({ length: 8 }, (_, i) => viewport.controls.target.clone().set(i & 1 ? min.x : max.x, i & 2 ? min.y : max.y, i & 4 ? min.z : max.z).project(viewport.camera));
    return Math.max(...spots.flatMap(({ x, y }) => [Math.abs(x), Math.abs(y)]));
  });

test("has what moves in the view, and large, at any time", async () => {
  for (const step of [0, 60, 200]) {
    await run.page.evaluate((at) => boxstreamViewer.player.goToStep(at), step);
    await settled(run.page);
    const taken = await share(run.page);
    assert.ok(taken > 0.6 && taken < 1.1, `${taken} at step ${step}`);
  }
});

test("is dark on request", async () => {
  await press("d");
  const paper = () => run.page.evaluate(() => getComputedStyle(document.querySelector("footer")).backgroundColor);
  const dark = await paper();
  const first = await picture();
  await press("d");
  assert.notEqual(await paper(), dark);
  assert.ok(!first.equals(await picture()));
});

test("an address brings back what is shown", async () => {
  await press("Home", "5", "b", "k");
  await run.page.evaluate(() => {
    boxstreamViewer.player.goToStep(33);
    boxstreamViewer.select(17);
  });
  await settled(run.page);
  const hash = await run.page.evaluate(async () => {
    await new Promise((resolve) => setTimeout(resolve, 800));
    return location.hash.slice(1);
  });
  assert.match(hash, /step=33&colour=speed&boxes&contacts&select=17/);
  const other = await open(browser, file, { hash, width: 960, height: 700 });
  assert.deepEqual(await state(other.page), await state());
  const camera = (page) => page.evaluate(() => [...boxstreamViewer.viewport.camera.position.toArray(), ...boxstreamViewer.viewport.controls.target.toArray()]);
  const [mine, theirs] = [await camera(run.page), await camera(other.page)];
  for (const [i, x] of mine.entries()) assert.ok(Math.abs(x - theirs[i]) < 0.01, `${mine} and ${theirs}`);
  assert.deepEqual(other.problems, []);
  await other.close();
  await press("b", "k", "Escape");
});

/** Elements that are seen and stand in each other's way, or reach out of the page. */
const clashes = (page) =>
  page.evaluate(() => {
    const seen = [...document.querySelectorAll("header, #tools, #look, #object, footer, #controls > *, #tools button, #look button, #look select, #look input")].filter((node) => node.getClientRects().length > 0);
    const name = (node) => node.id || node.tagName;
    const boxes = seen.map((node) => ({ node, box: node.getBoundingClientRect() }));
    const out = boxes.filter(({ box }) => box.left < -0.5 || box.top < -0.5 || box.right > innerWidth + 0.5 || box.bottom > innerHeight + 0.5).map(({ node }) => `${name(node)} is cut off`);
    const cut = seen.filter((node) => node.scrollWidth > node.clientWidth + 1 && node.tagName !== "SELECT" && node.tagName !== "INPUT").map((node) => `${name(node)} is too narrow`);
    const meets = (a, b) => a.left < b.right - 0.5 && b.left < a.right - 0.5 && a.top < b.bottom - 0.5 && b.top < a.bottom - 0.5;
    const pairs = boxes.flatMap((a, i) => boxes.slice(i + 1).map((b) => [a, b])).filter(([a, b]) => !a.node.contains(b.node) && !b.node.contains(a.node) && meets(a.box, b.box));
    return [...out, ...cut, ...pairs.map(([a, b]) => `${name(a.node)} and ${name(b.node)} overlap`)];
  });

for (const [width, height] of [[390, 844], [844, 390], [360, 640], [1280, 800]])
  test(`nothing overlaps at ${width} x ${height}`, async () => {
    const phone = await open(browser, file, { hash: "paused&plain&select=17", width, height });
    assert.deepEqual(await clashes(phone.page), []);
    await phone.page.evaluate(() => boxstreamViewer.select(-1));
    const isLookShown = await phone.page.isVisible("#look");
    if (!isLookShown) await phone.page.click("#more");
    await settled(phone.page);
    assert.deepEqual(await clashes(phone.page), []);
    if (width > height) {
      await phone.page.evaluate(() => boxstreamViewer.select(17));
      if (await phone.page.isHidden("#graphs")) await phone.page.click("#curves");
      await settled(phone.page);
      assert.deepEqual(await clashes(phone.page), [], "with curves");
      await phone.page.evaluate(() => boxstreamViewer.select(-1));
    }
    const room = await phone.page.evaluate(() => document.getElementById("scene").getBoundingClientRect().height / innerHeight);
    assert.ok(room > 0.3, `the scene has ${room} of the height`);
    assert.deepEqual(phone.problems, []);
    await phone.close();
  });

test("fingers turn, zoom and tap", async () => {
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, offline: true });
  const page = await context.newPage();
  await page.goto(`file://${file}#step=100&plain`);
  await settled(page);
  const camera = () => page.evaluate(() => [...boxstreamViewer.viewport.camera.position.toArray(), boxstreamViewer.viewport.camera.position.distanceTo(boxstreamViewer.viewport.controls.target)]);
  const session = await context.newCDPSession(page);
  const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const start = await camera();
  await touch("touchStart", [150, 300]);
  await touch("touchMove", [220, 310]);
  await touch("touchEnd");
  await page.waitForTimeout(200);
  const turned = await camera();
  assert.ok(Math.abs(turned[0] - start[0]) > 1e-3, "one finger turns");
  assert.ok(Math.abs(turned[3] / start[3] - 1) < 1e-3);
  await touch("touchStart", [150, 300], [200, 300]);
  await touch("touchMove", [100, 300], [280, 300]);
  await touch("touchEnd");
  await page.waitForTimeout(200);
  assert.ok((await camera())[3] < 0.8 * turned[3], "two fingers zoom");
  assert.equal(await page.evaluate(() => boxstreamViewer.selected), -1, "a pinch is no tap");
  await page.evaluate(() => boxstreamViewer.path.fit(boxstreamViewer.player));
  await settled(page);
  await page.touchscreen.tap(...(await spotOf(page)));
  await settled(page);
  assert.ok((await page.evaluate(() => boxstreamViewer.selected)) >= 0, "a tap selects");
  await context.close();
});

test("was quiet all the time", () => {
  assert.deepEqual(run.problems, []);
});

test("shows two worlds at the same time of theirs", async () => {
  const both = await open(browser, compared, { hash: "paused&plain", width: 960, height: 700 });
  assert.equal((await state(both.page)).colour, "difference");
  const apart = () => both.page.evaluate(() => ({ steps: boxstreamViewer.worlds.map((world) => world.run.frameSteps[Math.floor(world.shown.position)]), most: Math.max(...boxstreamViewer.worlds[0].apart), hint: document.getElementById("hint").textContent }));
  assert.equal((await apart()).most, 0, "they begin alike");
  await both.page.keyboard.press("End");
  await settled(both.page);
  const end = await apart();
  assert.deepEqual(end.steps, [120, 120]);
  assert.match(end.hint, /Apart: median .* Pairs only in boxstream: \d+, only in dbvt: \d+/);
  assert.ok(end.most > 0, "the order of pairs makes them drift apart");
  const names = await both.page.locator("#labels b").allTextContents();
  assert.deepEqual(names, ["boxstream", "dbvt"]);
  assert.deepEqual(both.problems, []);
  await both.close();
});

test("says that it shows some of many bodies, and which", async () => {
  const page = join(directory, "some.html");
  simulate("pile", page, "--scale", "0.05", "--steps", "5", "--view-bodies", "100");
  const some = await open(browser, page, { hash: "paused&plain", width: 960, height: 700 });
  const seen = await some.page.evaluate(() => {
    const { run, objects } = boxstreamViewer.worlds[0];
    const numbers = [...objects.numbers];
    return { numbers, all: objects.count, pairs: run.series.pairs[4], drawn: boxstreamViewer.worlds[0].bodies.groups.reduce((sum, { items }) => sum + new Set(items.map(({ object }) => object)).size, 0) };
  });
  assert.equal(seen.numbers.length, 100);
  assert.equal(seen.drawn, 100);
  assert.match(await some.page.textContent("#facts"), new RegExp(`${seen.all} objects`));
  assert.match(await some.page.textContent("#choice"), new RegExp(`^100 of ${seen.all} objects are shown: .* a sample of .* others. Curves are of all.$`));
  const find = async (words) => {
    await some.page.fill("#wanted", words);
    await some.page.keyboard.press("Enter");
    await settled(some.page);
    return some.page.evaluate(() => boxstreamViewer.selected);
  };
  assert.equal(await find(String(seen.numbers[70])), 70);
  assert.match(await some.page.textContent("#object"), new RegExp(`object${seen.numbers[70]}.*of those shown`));
  const absent = Array.from({ length: seen.all }, (_, i) => i).find((number) => !seen.numbers.includes(number));
  assert.equal(await find(String(absent)), 70);
  assert.equal(await some.page.textContent("#found"), "not shown");
  await find("nothing of this name");
  assert.equal(await some.page.textContent("#found"), "none shown");
  await some.page.waitForFunction((number) => location.hash.includes(`select=${number}`), seen.numbers[70]);
  await some.page.evaluate(() => boxstreamViewer.player.goToStep(5));
  await settled(some.page);
  const shown = await some.page.evaluate(() => boxstreamViewer.worlds[0].shown.frame.pairs.length / 2);
  assert.ok(shown > 0 && shown < seen.pairs, `${shown} of ${seen.pairs} pairs`);
  assert.deepEqual(some.problems, []);
  await some.close();
});

test("opens a pile at once, and small", async () => {
  const page = join(directory, "pile.html");
  simulate("pile", page, "--scale", "0.25", "--steps", "150");
  const start = performance.now();
  const pile = await open(browser, page, { hash: "paused&plain", width: 760, height: 600, timeout: 120_000 });
  const opened = performance.now();
  await pile.page.keyboard.press("End");
  await settled(pile.page, 120_000);
  const { size } = statSync(page);
  const shell = await pile.page.evaluate(() => [...document.querySelectorAll("script:not([type]), style")].reduce((sum, node) => sum + node.textContent.length, 0));
  const each = (size - shell) / (2000 * 151);
  console.log(`pile of 2000, 151 frames: ${(size / 1e6).toFixed(2)} MB, ${each.toFixed(2)} bytes for a body and a frame; first picture after ${Math.round(opened - start)} ms, another frame after ${Math.round(performance.now() - opened)} ms`);
  assert.ok(each < 5, `${each} bytes for a body and a frame`);
  assert.ok((await share(pile.page)) > 0.6);
  assert.deepEqual(pile.problems, []);
  // With WebGL in software, on a busy machine; a graphics card takes a small part of it.
  assert.ok(opened - start < 60_000);
  await pile.close();
});
