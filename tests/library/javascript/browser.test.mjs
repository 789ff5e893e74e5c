// SPDX-License-Identifier: MIT
// The package on the main thread of a page and in a worker, in headless Chromium: the same pairs as in Node.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import test from "node:test";
import { inChromium } from "../../../bench/javascript/chromium.mjs";
import { boxstream, folder, randomOf, shapes } from "./support.mjs";

const boxes = shapes.cubes(Float32Array, 3000, randomOf(9));

const search = `import { findPairs } from "/index.mjs";
const search = () => [...findPairs(Float32Array.of(${boxes.join()}))];
`;

const script = `${search}
const post = (where, body) => fetch(where, { method: "POST", body: JSON.stringify(body) });
const worker = new Worker("/worker.js", { type: "module" });
worker.onmessage = async ({ data }) => {
  await post("/result", search());
  await post("/result", data);
  await post("/end", {});
};
worker.onerror = ({ message }) => post("/end", { error: "worker: " + message });
`;

test("a page and a worker", { timeout: 120_000 }, async () => {
  const results = [];
  const files = {
    "/page.js": script,
    "/worker.js": `${search}postMessage(search());`,
    "/index.mjs": readFileSync(path.join(folder, "index.mjs"), "utf8"),
    "/wasm.js": readFileSync(path.join(folder, "wasm.js"), "utf8"),
  };
  await inChromium(files, (pairs) => results.push(pairs));
  const pairs = [...boxstream.findPairs(boxes)];
  assert.ok(pairs.length > 500);
  assert.deepEqual(results, [pairs, pairs]);
});
