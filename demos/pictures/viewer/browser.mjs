// SPDX-License-Identifier: MIT
// Opens pages of `boxstream simulate --view` in Chromium, without a window.
import { createRequire } from "node:module";
import { existsSync } from "node:fs";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const packages = resolve(process.env.BOXSTREAM_WEB_PACKAGES ?? fileURLToPath(new URL("../../../build/release/demos/pictures/viewer/web", import.meta.url)));
const chromium = process.env.CHROMIUM ?? "/usr/bin/chromium";

/** A module of the packages that the build has installed. */
export function requirePackage(name) {
  return createRequire(join(packages, "package.json"))(name);
}

/** Chromium in a fresh profile; WebGL in software, so that pictures do not depend on the machine. */
export async function launch() {
  if (!existsSync(chromium)) throw new Error(`${chromium} is not there; CHROMIUM=/path/to/it says where it is`);
  return requirePackage("playwright-core").chromium.launch({
    executablePath: chromium,
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}

/** Waits until the scene shows what it is to show. */
export async function settled(page, timeout = 60_000) {
  await page.waitForFunction(() => window.boxstreamViewer?.isSettled, null, { timeout, polling: 50 });
}

/**
 * Opens a page at `hash`, light or dark by `scheme`, and waits until it is `ready`: for its first picture. What it writes to the console as an
 * error, what it throws and what it asks the network for goes into `problems`.
 */
export async function open(browser, file, { hash = "paused", width = 1280, height = 800, scale = 1, timeout = 60_000, ready = settled, scheme = "light", motion = "no-preference" } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, deviceScaleFactor: scale, colorScheme: scheme, reducedMotion: motion, offline: true });
  const page = await context.newPage();
  page.setDefaultTimeout(timeout);
  const problems = [];
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("request", (request) => /^(https?|wss?):/.test(request.url()) && problems.push(`asked for ${request.url()}`));
  await page.goto(`${pathToFileURL(resolve(file))}#${hash}`, { timeout });
  await ready(page, timeout);
  return { page, problems, close: () => context.close() };
}
