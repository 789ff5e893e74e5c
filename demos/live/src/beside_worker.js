// SPDX-License-Identifier: MIT
// The worker beside: finds the pairs of a frame once more, by another method, and compares. One job after the other,
// so that no method disturbs the time of another.
import { contestants } from "./contestants.js";
import { difference } from "./pairs.js";

function compared({ name, boxes, pairs }) {
  const { prepare, run } = contestants[name];
  const prepared = prepare(boxes);
  const start = performance.now();
  const wanted = run(prepared);
  const time = performance.now() - start;
  const { missing, extra } = difference(pairs, wanted, boxes.length / 6);
  return { name, time, pairs: wanted.length / 2, missing: missing.length, extra: extra.length, first: missing[0] ?? extra[0] };
}

export function serveBeside() {
  self.onmessage = ({ data }) => self.postMessage(compared(data));
}
