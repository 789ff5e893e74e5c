// SPDX-License-Identifier: MIT
// The package under test, what searches have to find by the definition alone, and inputs to find it in.
import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";

export const folder = process.env.BOXSTREAM_JAVASCRIPT;
export const boxstream = await import(pathToFileURL(`${folder}/index.mjs`));

export const floatTypes = [Float32Array, Float64Array];

/** Numbers in [0, 1) that a seed decides. */
export function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let bits = Math.imul(state ^ (state >>> 15), state | 1);
    bits ^= bits + Math.imul(bits ^ (bits >>> 7), bits | 61);
    return ((bits ^ (bits >>> 14)) >>> 0) / 2 ** 32;
  };
}

const boxesOf = (Type, count, draw) => Type.from(Array.from({ length: count }, draw).flat());

const boxAt = (at, size) => {
  const low = [at(), at(), at()];
  return [...low, ...low.map((x) => x + size())];
};

const special = {
  Float32Array: [NaN, Infinity, -Infinity, 0, -0, 2 ** -149, -(2 ** -149), 2 ** -126, 1, -1, 1 + 2 ** -23, 2 ** 127 * (2 - 2 ** -23)],
  Float64Array: [NaN, Infinity, -Infinity, 0, -0, 2 ** -1074, -(2 ** -1074), 2 ** -1022, 1, -1, 1 + 2 ** -52, Number.MAX_VALUE],
};

/** Each makes `count` boxes; by name. */
export const shapes = {
  cubes: (Type, count, random) => boxesOf(Type, count, () => boxAt(random, () => 0.6 * random() / Math.cbrt(count))),
  sticks: (Type, count, random) =>
    boxesOf(Type, count, () => boxAt(random, () => (random() < 0.3 ? random() : 0.1 * random()))),
  lattice: (Type, count, random) =>
    boxesOf(Type, count, () => boxAt(() => Math.floor(9 * random()), () => Math.floor(2 * random()))),
  flat: (Type, count, random) =>
    boxesOf(Type, count, () => boxAt(() => Math.round(4 * random()) / 4, () => 0)),
  crowd: (Type, count, random) => boxesOf(Type, count, () => boxAt(random, () => 1)),
  special: (Type, count, random) => {
    const values = special[Type.name];
    const draw = () => values[Math.floor(values.length * random())];
    const upper = (x) => (random() < 0.9 ? Math.max(x, draw()) : draw());
    return boxesOf(Type, count, () => {
      const low = [draw(), draw(), draw()];
      return [...low, ...low.map(upper)];
    });
  },
};

export const sizes = [0, 1, 2, 3, 7, 8, 9, 63, 64, 65, 130, 500];

const valid = (boxes, i) => [0, 1, 2].every((d) => boxes[6 * i + d] <= boxes[6 * i + 3 + d]);

function touch(a, i, b, j) {
  for (let d = 0; d < 3; ++d) if (!(a[6 * i + d] <= b[6 * j + 3 + d] && b[6 * j + d] <= a[6 * i + 3 + d])) return false;
  return true;
}

/** Pairs as strings, of one set or of two; `accepts(i, j)` may refuse. */
export function bruteForce(a, b, accepts = () => true) {
  const pairs = new Set();
  const other = b ?? a;
  for (let i = 0; i < a.length / 6; ++i) {
    if (!valid(a, i)) continue;
    for (let j = b ? 0 : i + 1; j < other.length / 6; ++j)
      if (valid(other, j) && touch(a, i, other, j) && accepts(i, j)) pairs.add(`${i} ${j}`);
  }
  return pairs;
}

export function pairSet(pairs) {
  const all = new Set();
  for (let k = 0; k < pairs.length; k += 2) all.add(`${pairs[k]} ${pairs[k + 1]}`);
  assert.equal(all.size, pairs.length / 2, "a pair is there twice");
  return all;
}

/** Fails with the first pair that one of the two has alone. */
export function sameSets(found, expected, where) {
  for (const pair of expected) assert.ok(found.has(pair), `${where}: pair ${pair} is missing`);
  for (const pair of found) assert.ok(expected.has(pair), `${where}: pair ${pair} is wrong`);
}
