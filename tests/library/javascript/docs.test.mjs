// SPDX-License-Identifier: MIT
// The examples of docs/javascript.md print what it says.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import test, { after } from "node:test";
import { folder } from "./support.mjs";

const text = readFileSync(new URL("../../../docs/javascript.md", import.meta.url), "utf8");
const examples = [...text.matchAll(/```js\n(.*?)```\n\n```text\n(.*?)```/gs)];
const place = mkdtempSync(path.join(tmpdir(), "boxstream-"));
mkdirSync(path.join(place, "node_modules"));
symlinkSync(path.resolve(folder), path.join(place, "node_modules/boxstream"));
after(() => rmSync(place, { recursive: true }));

test("each example has its output", () => assert.ok(examples.length > 0 && examples.length === text.split("```js").length - 1));

examples.forEach(([, code, output], i) => {
  test(`example ${i + 1}`, () => {
    const printed = execFileSync("node", ["--input-type=module", "-e", code], { cwd: place, encoding: "utf8" });
    assert.equal(printed, output);
  });
});
