// SPDX-License-Identifier: MIT
// What npm packs, installed into an empty folder, as a user has it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import test, { after, before } from "node:test";
import { gzipSync } from "node:zlib";
import { folder } from "./support.mjs";

const place = mkdtempSync(path.join(tmpdir(), "boxstream-"));
const run = (command, ...given) => execFileSync(command, given, { cwd: place, encoding: "utf8" });
const write = (name, text) => writeFileSync(path.join(place, name), text);
let packed;

before(() => {
  [packed] = JSON.parse(run("npm", "pack", "--json", "--pack-destination", place, path.resolve(folder)));
  write("package.json", '{ "private": true }');
  run("npm", "install", "--offline", "--no-audit", "--no-fund", path.join(place, packed.filename));
});
after(() => rmSync(place, { recursive: true }));

test("contents, size and no dependencies", () => {
  const names = packed.files.map((file) => file.path).sort();
  assert.deepEqual(names, ["LICENSE", "README.md", "index.cjs", "index.d.cts", "index.d.mts", "index.mjs", "package.json", "wasm.js"]);
  const loaded = ["index.mjs", "wasm.js"].map((name) => readFileSync(path.join(folder, name)));
  assert.ok(gzipSync(Buffer.concat(loaded)).length < 195_000);
  assert.ok(statSync(path.join(place, packed.filename)).size < 210_000);
  assert.deepEqual(readdirSync(path.join(place, "node_modules")).filter((name) => !name.startsWith(".")), ["boxstream"]);
});

const use = "console.log(findPairs(Float32Array.of(0, 0, 0, 1, 1, 1, 1, 0, 0, 2, 1, 1)).join())";

test("three lines of an ES module", () => {
  write("three.mjs", `import { findPairs, World } from "boxstream";\nnew World().free();\n${use};\n`);
  assert.equal(run("node", "three.mjs"), "0,1\n");
});

test("three lines of CommonJS", () => {
  write("three.cjs", `const { findPairs, World } = require("boxstream");\nnew World().free();\n${use};\n`);
  assert.equal(run("node", "three.cjs"), "0,1\n");
});

test("a worker", () => {
  write("worker.mjs", `import { Worker } from "node:worker_threads";\nnew Worker(new URL("three.mjs", import.meta.url));\n`);
  assert.equal(run("node", "worker.mjs"), "0,1\n");
});

const program = `import { findPairs, Detector, World, simdTarget, type Hits, type WorldStats } from "boxstream";
const boxes = new Float64Array(12);
const pairs: Uint32Array = findPairs(boxes, { other: boxes, groups: [new Uint32Array(2), undefined] });
const world = new World({ dtype: "float64" });
const ids: Float64Array = world.create(boxes, { users: new Uint32Array(2), invalid: "throw" });
const stats: WorldStats = world.update();
const hits: Hits = world.queryBoxes(boxes);
const enters: Float32Array | Float64Array = world.castRays(boxes, boxes, 5).enters;
world[Symbol.dispose]();
console.log(pairs, ids, stats.begun, hits.ids, enters, new Detector().stats.tests, simdTarget());
`;
const wrong = [
  "findPairs([0, 0, 0, 1, 1, 1]);",
  "findPairs(boxes, { other: new Float32Array(6) });",
  'new World({ dtype: "int32" });',
  "new World().destroy([1]);",
];

for (const name of ["esm.mts", "cjs.cts"]) {
  const compile = () =>
    run("tsc", "--noEmit", "--strict", "--target", "es2022", "--module", "node16", "--moduleResolution", "node16", name);

  test(`TypeScript takes a right program: ${name}`, () => {
    write(name, program);
    compile();
  });

  test(`TypeScript refuses wrong lines: ${name}`, () => {
    write(name, program + wrong.join("\n"));
    const first = program.split("\n").length;
    assert.throws(compile, ({ stdout }) => wrong.every((line, i) => (assert.ok(stdout.includes(`${name}(${first + i},`), line), true)));
  });
}
