// SPDX-License-Identifier: MIT
// Which boxes pair, in one to three dimensions, against the definition; rows of neighbours; warnings of layouts.
import assert from "node:assert/strict";
import test from "node:test";
import { boxstream, pairSet, randomOf, sameSets } from "./support.mjs";

const { Detector, findNeighbours, findPairs, World } = boxstream;
const types = [Float32Array, Float64Array, Int32Array];

function wholeBoxes(Type, count, dimensions, random) {
  const boxes = new Type(2 * dimensions * count);
  for (let i = 0; i < count; ++i)
    for (let d = 0; d < dimensions; ++d) {
      boxes[2 * dimensions * i + d] = Math.floor(25 * random());
      boxes[2 * dimensions * i + dimensions + d] = boxes[2 * dimensions * i + d] + Math.floor(4 * random());
    }
  return boxes;
}

function expected(boxes, d, closed, tolerance, accepts) {
  const below = (x, y) => (closed ? x <= y + tolerance : x < y + tolerance);
  const pairs = new Set();
  const count = boxes.length / (2 * d);
  for (let i = 0; i < count; ++i)
    for (let j = i + 1; j < count; ++j) {
      const meets = (axis) =>
        below(boxes[2 * d * i + axis], boxes[2 * d * j + d + axis]) && below(boxes[2 * d * j + axis], boxes[2 * d * i + d + axis]);
      if ([...Array(d).keys()].every(meets) && accepts(i, j)) pairs.add(`${i} ${j}`);
    }
  return pairs;
}

for (const Type of types)
  for (const dimensions of [1, 2, 3])
    test(`${Type.name}, ${dimensions} dimensions`, () => {
      for (const count of [0, 1, 30, 240])
        for (const closed of [true, false])
          for (const tolerance of [0, 1]) {
            const random = randomOf(count + 7 * dimensions);
            const boxes = wholeBoxes(Type, count, dimensions, random);
            const ids = Uint32Array.from({ length: count }, () => Math.floor(9 * random()));
            const options = { dimensions, closed, tolerance };
            sameSets(pairSet(findPairs(boxes, options)), expected(boxes, dimensions, closed, tolerance, () => true), "all");
            const others = expected(boxes, dimensions, closed, tolerance, (i, j) => ids[i] !== ids[j]);
            sameSets(pairSet(findPairs(boxes, { ...options, ids })), others, "by ids");
            const two = pairSet(findPairs(boxes, { ...options, other: boxes, idsA: ids, idsB: ids }));
            sameSets(new Set([...two].filter((pair) => Number(pair.split(" ")[0]) < Number(pair.split(" ")[1]))), others, "two sets");
            const { offsets, indices } = findNeighbours(boxes, { ...options, ids, both: false });
            const rows = [];
            for (let i = 0; i < count; ++i) for (const j of indices.subarray(offsets[i], offsets[i + 1])) rows.push(i, j);
            sameSets(pairSet(rows), others, "rows");
          }
    });

test("rows ascend and have each pair twice", () => {
  const boxes = wholeBoxes(Int32Array, 300, 2, randomOf(5));
  const detector = new Detector();
  const { offsets, indices } = detector.findNeighbours(boxes, { dimensions: 2 });
  assert.equal(indices.length, 2 * findPairs(boxes, { dimensions: 2 }).length / 2);
  assert.equal(offsets.length, 301);
  for (let i = 0; i < 300; ++i) {
    const row = [...indices.subarray(offsets[i], offsets[i + 1])];
    assert.deepEqual(row, [...new Set(row)].sort((a, b) => a - b));
    for (const j of row) assert.ok(indices.subarray(offsets[j], offsets[j + 1]).includes(i));
  }
  const between = detector.findNeighbours(boxes, { dimensions: 2, other: boxes.slice(0, 40) });
  assert.equal(between.offsets.at(-1), between.indices.length);
  assert.ok(between.indices.every((j) => j < 10));
  detector.free();
});

function warnings(run) {
  const [said, before] = [[], console.warn];
  console.warn = (text) => said.push(text);
  try {
    run();
  } finally {
    console.warn = before;
  }
  return said;
}

test("layouts are told once", () => {
  const flat = new Float64Array(1200);
  for (let i = 0; i < 300; ++i) flat.set([i, 0, i + 1, 1], 4 * i);
  assert.equal(findPairs(flat, { dimensions: 2 }).length / 2, 299);
  const [text, ...more] = warnings(() => [findPairs(flat), findPairs(flat)]);
  assert.match(text, /boxes are invalid .*they seem to have two dimensions, and take dimensions: 2/);
  assert.deepEqual(more, []);
  const random = randomOf(3);
  const boxes = Float32Array.from({ length: 600 }, () => random());
  const [low, high] = [(i) => Math.min(boxes[i], boxes[i + 3]), (i) => Math.max(boxes[i], boxes[i + 3])];
  const mixed = new Float32Array(600);
  for (let i = 0; i < 600; i += 6) mixed.set([low(i), high(i), low(i + 1), high(i + 1), low(i + 2), high(i + 2)], i);
  assert.match(warnings(() => findPairs(mixed))[0], /min and max seem interleaved/);
  assert.deepEqual(warnings(() => findPairs(mixed.map(() => NaN), { invalid: "skip" })), []);
  assert.match(warnings(() => findPairs(mixed.map(() => NaN)))[0], /100 of 100 boxes are invalid.*many have a NaN/);
});

test("layouts of arrays of other classes are told", () => {
  class Own extends Float64Array {
    constructor() {
      super(18);
    }
  }
  const sizes = new Own();
  for (let i = 0; i < 18; i += 6) sizes.set([3, 4, 5, 1, 7, 2], i);
  assert.match(warnings(() => findPairs(sizes))[0], /3 of 3 boxes are invalid.*maxima seem to be sizes/);
});

test("a World warns of the same", () => {
  const flat = Float32Array.from(Array.from({ length: 300 }, (_, i) => [i, 0, i + 1, 1]).flat());
  const [text, ...more] = warnings(() => [new World().create(flat), new World().create(flat), new World().create(flat, { invalid: "skip" })]);
  assert.match(text, /200 boxes are invalid.*two dimensions, and need a third in a World/);
  assert.deepEqual(more, []);
});
