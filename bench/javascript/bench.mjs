#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Times the npm package beside others that find pairs of boxes, in Node and in headless Chromium, and prints a table for
// docs/javascript.md. ./dev bench javascript runs it. In Node it is the time of the processor, in Chromium elapsed time.
import { readFileSync } from "node:fs";
import os from "node:os";
import { parseArgs } from "node:util";
import { contest } from "./contest.js";
import { inChromium } from "./chromium.mjs";
import * as boxstream from "boxstream";

const { values: given } = parseArgs({
  options: {
    hosts: { type: "string", default: "node,chromium" },
    data: { type: "string", default: "atlas,labels,parts,U" },
    sizes: { type: "string", default: "1000,10000,100000" },
    seconds: { type: "string", default: "10" },
    page: { type: "string" },
    help: { type: "boolean" },
  },
});
if (given.help) {
  console.log("usage: ./dev bench javascript [--hosts node,chromium] [--data atlas,labels,parts,U] [--sizes 1000,10000,100000] [--seconds 10]");
  process.exit();
}
const wanted = { data: given.data.split(","), sizes: given.sizes.split(",").map(Number), seconds: Number(given.seconds) };

function processorTime() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
}

function print(host, { data, n, pairs, rows }) {
  const [ours] = rows;
  for (const { name, ms } of rows) {
    const ratio = name === ours.name ? "" : (ms / ours.ms).toFixed(ms > 99 * ours.ms ? 0 : 2);
    console.log(`| ${host} | ${data} | ${n} | ${pairs} | ${name} | ${ms.toPrecision(4)} | ${ratio} |`);
  }
}

console.log(`${os.cpus()[0].model}; Node ${process.versions.node}; ${new Date().toISOString().slice(0, 10)}\n`);
console.log("| host | boxes | n | pairs | | ms | by `findPairs` |\n|---|---|--:|--:|---|--:|--:|");
if (given.hosts.includes("node")) 
  for (const name of wanted.data) for (const n of wanted.sizes) print("Node", contest(boxstream, name, n, wanted.seconds, processorTime));
if (given.hosts.includes("chromium")) {
  const files = { "/page.js": readFileSync(given.page, "utf8"), "/wanted.json": JSON.stringify(wanted) };
  await inChromium(files, (result) => print("Chromium", result));
}
