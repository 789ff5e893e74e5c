// SPDX-License-Identifier: MIT
import { data } from "./data.js";
import { contestants as ofBoxes } from "./live/contestants.js";
import { difference } from "./live/pairs.js";
import { contestants as ofRectangles } from "./rectangles.js";

/** The package under test and the others: how each brings boxes into the form that it takes best, which is not timed,
 * and how it finds their pairs. */
function allContestants(boxstream, dimensions) {
  const detector = new boxstream.Detector();
  const { "brute force": _, ...others } = dimensions === 2 ? ofRectangles : ofBoxes;
  const named = (entries) => Object.entries(entries).map(([name, contestant]) => ({ name: `\`${name}\``, ...contestant }));
  const prepare = (boxes) => boxes;
  return named({
    findPairs: { prepare, run: (boxes) => boxstream.findPairs(boxes, { dimensions }) },
    Detector: { prepare, run: (boxes) => detector.findPairs(boxes, { dimensions }) },
    ...others,
  });
}

function requireEqual(found, wanted, n, name) {
  const { missing, extra } = difference(found, wanted, n);
  if (missing.length + extra.length > 0) throw new Error(`${n} boxes: ${name} finds other pairs`);
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
export function contest(boxstream, name, n, seconds, clock) {
  const { dimensions, kind, make } = data[name];
  const boxes = make(n);
  const runs = allContestants(boxstream, dimensions).map(({ name, prepare, run }) => {
    const input = prepare(boxes);
    return { name, find: () => run(input), times: [] };
  });
  const pairs = runs.map(({ find }) => find());
  runs.forEach(({ name }, i) => requireEqual(pairs[i], pairs[0], n, name));
  const calls = Math.max(1, Math.round(20_000 / n));
  for (const { find } of runs) time(clock, find, 3 * calls);
  const end = performance.now() + 1000 * seconds;
  while (runs[0].times.length < 5 || performance.now() < end) for (const run of runs) run.times.push(time(clock, run.find, calls));
  return { data: `${name}: ${dimensions}-D, ${kind}`, n, pairs: pairs[0].length / 2, rows: runs.map(({ name, times }) => ({ name, ms: median(times) })) };
}
