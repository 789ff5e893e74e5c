// SPDX-License-Identifier: MIT
// findPairs and Detector against brute force.
import assert from "node:assert/strict";
import test from "node:test";
import { boxstream, bruteForce, floatTypes, pairSet, randomOf, sameSets, shapes, sizes } from "./support.mjs";

const { Detector, findPairs, World } = boxstream;
const bits = [0, 1, 2, 3, 0x80000000, 0xffffffff];
const draw = (count, random) => Uint32Array.from({ length: count }, () => bits[Math.floor(bits.length * random())]);
const accept = (a, b, i, j) => (a.groups[i] & b.masks[j]) !== 0 && (b.groups[j] & a.masks[i]) !== 0;

for (const Type of floatTypes) {
  for (const [shape, make] of Object.entries(shapes)) {
    const each = (work) => {
      for (const size of sizes)
        for (let seed = 1; seed <= (size < 200 ? 20 : 3); ++seed)
          work(make, size, randomOf(seed + 1000 * size), `${Type.name}, ${shape}, ${size} boxes, seed ${seed}`);
    };

    test(`pairs of one set: ${Type.name}, ${shape}`, () => {
      const detector = new Detector();
      each((make, size, random, where) => {
        const boxes = make(Type, size, random);
        const pairs = findPairs(boxes);
        sameSets(pairSet(pairs), bruteForce(boxes), where);
        assert.deepEqual(detector.findPairs(boxes), pairs, where);
        assert.equal(detector.stats.boxes, size);
        assert.equal(detector.stats.pairs, pairs.length / 2);
      });
      detector.free();
    });

    test(`pairs of two sets, and filters: ${Type.name}, ${shape}`, () => {
      each((make, size, random, where) => {
        const sets = [make(Type, size, random), make(Type, Math.ceil(size / 2), random)];
        const [a, b] = sets.map((set) => ({ groups: draw(set.length / 6, random), masks: draw(set.length / 6, random) }));
        sameSets(pairSet(findPairs(sets[0], { other: sets[1] })), bruteForce(...sets), where);
        sameSets(pairSet(findPairs(sets[0], a)), bruteForce(sets[0], undefined, (i, j) => accept(a, a, i, j)), where);
        const options = { other: sets[1], groups: [a.groups, b.groups], masks: [a.masks, b.masks] };
        sameSets(pairSet(findPairs(sets[0], options)), bruteForce(...sets, (i, j) => accept(a, b, i, j)), where);
      });
    });
  }
}

test("one of groups and masks alone", () => {
  const boxes = new Float32Array(12);
  const ones = Uint32Array.of(1, 1);
  const twos = Uint32Array.of(2, 2);
  assert.equal(findPairs(boxes, { groups: twos }).length, 2);
  assert.equal(findPairs(boxes, { masks: ones }).length, 2);
  assert.equal(findPairs(boxes, { masks: twos }).length, 0);
  assert.equal(findPairs(boxes, { other: boxes, masks: [twos, undefined] }).length, 0);
  assert.equal(findPairs(boxes, { other: boxes, groups: [undefined, twos] }).length, 8);
});

test("large sets, and the same pairs in the same order from each search", () => {
  const random = randomOf(7);
  const boxes = shapes.cubes(Float32Array, 6000, random);
  const pairs = findPairs(boxes);
  sameSets(pairSet(pairs), bruteForce(boxes), "6000 cubes");
  assert.ok(pairs.length > 1000);
  assert.deepEqual(findPairs(boxes), pairs);
});

test("views of parts of larger arrays", () => {
  const whole = new Float32Array(13);
  assert.deepEqual([...findPairs(whole.subarray(1))], [0, 1]);
});

test("more pairs than the memory has room for at first", () => {
  const boxes = new Float64Array(6 * 2000);
  assert.equal(findPairs(boxes).length, 2000 * 1999);
});

test("the SIMD target", () => assert.equal(boxstream.simdTarget(), "WASM"));

test("the hybrid method finds the same, in a Detector and in a World", () => {
  for (const Type of floatTypes)
    for (const cutoff of [0, 12]) {
      const boxes = Object.values(shapes)[0](Type, 600, randomOf(5));
      const detector = new Detector({ method: "hybrid", cutoff });
      const pairs = detector.findPairs(boxes);
      sameSets(pairSet(pairs), bruteForce(boxes), Type.name);
      const world = new World({ dtype: Type === Float32Array ? "float32" : "float64", method: "hybrid", cutoff });
      world.create(boxes);
      assert.equal(world.update().pairs, pairs.length / 2);
      detector.free();
      world.free();
    }
});
