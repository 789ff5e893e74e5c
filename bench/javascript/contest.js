// SPDX-License-Identifier: MIT
import { contestantsOf } from "./contestants.js";
import { uniformBoxes } from "./inputs.js";

/** What a set of pairs of `n` boxes is, in whatever order they come. */
function keysOf(pairs, n) {
  const keys = new Float64Array(pairs.length / 2);
  for (let k = 0; k < keys.length; ++k) {
    keys[k] = Math.min(pairs[2 * k], pairs[2 * k + 1]) * n + Math.max(pairs[2 * k], pairs[2 * k + 1]);
  }
  return keys.sort();
}

function requireEqual(first, other, n, name) {
  const [a, b] = [keysOf(first, n), keysOf(other, n)];
  const at = a.findIndex((key, k) => key !== b[k]);
  if (at >= 0 || a.length !== b.length) throw new Error(`${n} boxes: ${name} finds other pairs`);
}

function median(values) {
  const sorted = Float64Array.from(values).sort();
  return sorted[sorted.length >> 1];
}

/** Milliseconds of one call, of `calls` in a row, since clocks may be coarse. */
function time(clock, call, calls) {
  const begin = clock();
  for (let i = 0; i < calls; ++i) call();
  return (clock() - begin) / calls;
}

/** Runs in turns, at least five, for `seconds`, after some to warm up. `clock` is in milliseconds. */
export function contest(boxstream, n, seconds, clock) {
  const boxes = uniformBoxes(n);
  const runs = contestantsOf(boxstream).map(({ name, prepare, find }) => {
    const input = prepare(boxes);
    return { name, find: () => find(input), times: [] };
  });
  const pairs = runs.map(({ find }) => find());
  runs.forEach(({ name }, i) => requireEqual(pairs[0], pairs[i], n, name));
  const calls = Math.max(1, Math.round(20_000 / n));
  for (const { find } of runs) time(clock, find, 3 * calls);
  const end = performance.now() + 1000 * seconds;
  while (runs[0].times.length < 5 || performance.now() < end) for (const run of runs) run.times.push(time(clock, run.find, calls));
  return { n, pairs: pairs[0].length / 2, rows: runs.map(({ name, times }) => ({ name, ms: median(times) })) };
}
