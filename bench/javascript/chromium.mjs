// SPDX-License-Identifier: MIT
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import path from "node:path";
import { setTimeout as sleep } from "node:timers/promises";

const flags = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];
const page = `<script>
  onerror = (message) => void fetch("/end", { method: "POST", body: JSON.stringify({ error: String(message) }) });
</script>
<script type="module" src="/page.js"></script>`;

async function bodyOf(request) {
  let text = "";
  for await (const part of request) text += part;
  return JSON.parse(text);
}

function send(response, type, text) {
  response.setHeader("content-type", type).end(text);
}

/** Serves `files`, and gives what is posted to `take(path, body)`. */
async function serve(files, take) {
  const server = createServer(async (request, response) => {
    if (request.method === "POST") {
      take(request.url, await bodyOf(request));
      response.end();
    } else if (request.url === "/") {
      send(response, "text/html", page);
    } else if (request.url in files) {
      send(response, "text/javascript", files[request.url]);
    } else {
      response.writeHead(404).end();
    }
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return server;
}

/** Chromium's helpers outlive it for a moment, and write meanwhile: then files appear where all had been removed. */
async function remove(profile) {
  for (let left = 50; ; --left) {
    try {
      return rmSync(profile, { recursive: true, force: true });
    } catch (error) {
      if (left === 0) throw error;
      await sleep(100);
    }
  }
}

/**
 * Runs the script /page.js of `files`, texts by path, in a page of headless Chromium. It posts results to /result, which
 * `take` gets, and at last to /end, with an `error` if there was one.
 */
export async function inChromium(files, take) {
  const profile = mkdtempSync(path.join(tmpdir(), "boxstream-chromium-"));
  let [finish, fail] = [];
  const end = new Promise((resolve, reject) => ([finish, fail] = [resolve, reject]));
  const server = await serve(files, (where, body) => {
    if (where === "/result") take(body);
    else if (body.error) fail(new Error(body.error));
    else finish();
  });
  const address = `http://127.0.0.1:${server.address().port}/`;
  const browser = spawn("chromium", [...flags, `--user-data-dir=${profile}`, address], { stdio: "ignore" });
  browser.on("error", fail);
  browser.on("exit", () => fail(new Error("Chromium has ended too early")));
  try {
    await end;
  } finally {
    browser.removeAllListeners("exit");
    const gone = new Promise((resolve) => browser.on("exit", resolve));
    browser.kill();
    server.close();
    await gone;
    await remove(profile);
  }
}
