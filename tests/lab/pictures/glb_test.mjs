// SPDX-License-Identifier: MIT
// What --record makes is valid glTF for the Khronos validator, down to its hints.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { requirePackage } from "../../../demos/pictures/viewer/browser.mjs";

const { validateBytes } = requirePackage("gltf-validator");
const tool = process.env.BOXSTREAM_TOOL;
const directory = mkdtempSync(join(tmpdir(), "boxstream-glb-"));
after(() => rmSync(directory, { recursive: true, force: true }));

for (const [scene, steps] of [[process.env.BOXSTREAM_MIXED_SCENE, 60], ["cloth", 30], ["terrain", 10], ["ragdolls", 10], ["character", 20]]) {
  test(`${scene} is valid`, async () => {
    const file = join(directory, "run.glb");
    execFileSync(tool, ["simulate", scene, "--steps", String(steps), "--record", file], { stdio: "pipe" });
    const report = await validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 20, writeTimestamp: false });
    const { numErrors, numWarnings } = report.issues;
    assert.deepEqual({ numErrors, numWarnings }, { numErrors: 0, numWarnings: 0 }, JSON.stringify(report.issues.messages, null, 1));
    assert.ok(report.info.animationCount === 1 && report.info.drawCallCount > 0);
  });
}
