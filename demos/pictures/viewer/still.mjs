// SPDX-License-Identifier: MIT
// Takes a picture of a page that `boxstream simulate --view` made, and says when its first one was there:
//   node demos/pictures/viewer/still.mjs RUN.html OUT.png [HASH [WIDTHxHEIGHT]]
// HASH is what the address of the page may have behind its "#", for example "step=300&colour=pairs&boxes".
// docs/pictures/viewer.png: see docs/viewing.md.
import { launch, open } from "./browser.mjs";

const [file, out, hash = "paused", size = "1280x800"] = process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
if (!out || !(width > 0 && height > 0)) {
  console.error("usage: node still.mjs RUN.html OUT.png [HASH [WIDTHxHEIGHT]]");
  process.exit(2);
}
const browser = await launch();
try {
  const { page, problems } = await open(browser, file, { hash, width, height, timeout: 300_000 });
  const [first] = await page.evaluate(() => performance.getEntriesByName("first picture").map((mark) => mark.startTime));
  console.log(`first picture after ${Math.round(first)} ms`);
  await page.screenshot({ path: out, timeout: 300_000 });
  if (problems.length > 0) throw new Error(problems.join("\n"));
} finally {
  await browser.close();
}
