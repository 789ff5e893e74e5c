// SPDX-License-Identifier: MIT
// Takes a picture of the first screen of the report: node bench/report/picture.mjs PAGE.html OUT.png
import { launch, open } from "../../demos/pictures/viewer/browser.mjs";

const [file, out] = process.argv.slice(2);
if (!out) {
  console.error("usage: node picture.mjs PAGE.html OUT.png");
  process.exit(2);
}
const browser = await launch();
try {
  const { page, problems } = await open(browser, file, { hash: "", ready: (page) => page.waitForSelector("body[data-complete]") });
  await page.screenshot({ path: out });
  if (problems.length > 0) throw new Error(problems.join("\n"));
} finally {
  await browser.close();
}
