// SPDX-License-Identifier: MIT
// Memory is given back, and when it runs out that is an exception. Runs with --expose-gc, and with a module whose memory
// is limited: see CMakeLists.txt.
import assert from "node:assert/strict";
import { setTimeout as sleep } from "node:timers/promises";
import test from "node:test";
import { boxstream, randomOf, shapes } from "./support.mjs";

const { Detector, findPairs, World } = boxstream;
const crowd = (count) => new Float32Array(6 * count);
const outOfMemory = { name: "RangeError", message: "boxstream: out of memory" };

/** Fails by the limit of memory if what `make` makes stays. */
function manyTimes(make) {
  for (let i = 0; i < 40; ++i) make();
}

test("searches keep nothing", () => manyTimes(() => findPairs(crowd(1000))));

test("free gives a World back", () => {
  manyTimes(() => {
    const world = new World();
    world.create(crowd(1000));
    world.update();
    world.free();
  });
});

test("Symbol.dispose gives back too, and free may be called twice", () => {
  const dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");
  manyTimes(() => {
    const detector = new Detector();
    detector.findPairs(crowd(1000));
    detector[dispose]();
    detector.free();
  });
});

test("what is out of reach is given back", async () => {
  for (let round = 0; round < 30; ++round) {
    for (let i = 0; i < 10; ++i) new World().create(crowd(10_000));
    globalThis.gc();
    await sleep(0);
  }
});

test("a freed object says so", () => {
  const [world, detector] = [new World(), new Detector()];
  world.create(crowd(2));
  world.update();
  assert.equal(world.pairs.length + world.begun.length + world.ended.length, 4); // which it keeps for the next that ask
  world.free();
  detector.free();
  for (const use of [() => world.update(), () => world.create(crowd(1)), () => world.pairs, () => world.begun, () => world.ended, () => world.dtype])
    assert.throws(use, { name: "Error", message: "this World has been freed" });
  for (const use of [() => detector.findPairs(crowd(1)), () => detector.stats])
    assert.throws(use, { name: "Error", message: "this Detector has been freed" });
});

test("out of memory in a search, which works afterwards", () => {
  const detector = new Detector();
  const boxes = shapes.cubes(Float32Array, 500, randomOf(1));
  const pairs = detector.findPairs(boxes);
  for (let i = 0; i < 5; ++i) {
    assert.throws(() => detector.findPairs(crowd(8000)), outOfMemory);
    assert.throws(() => findPairs(crowd(8000)), outOfMemory);
    assert.throws(() => findPairs(crowd(4_000_000)), outOfMemory);
    assert.deepEqual(detector.findPairs(boxes), pairs);
  }
});

test("out of memory in a World, which stays as it was", () => {
  const world = new World();
  const boxes = shapes.cubes(Float32Array, 500, randomOf(1));
  const ids = world.create(boxes);
  world.update();
  const pairs = world.pairs;
  for (let i = 0; i < 5; ++i) {
    assert.throws(() => world.create(crowd(3_000_000)), outOfMemory);
    assert.equal(world.size, 500);
    const more = world.create(crowd(8000));
    assert.throws(() => world.update(), outOfMemory);
    assert.deepEqual(world.pairs, pairs);
    world.destroy(more);
    assert.equal(world.update().pairs, pairs.length / 2);
    assert.deepEqual(world.boxes(ids), boxes);
  }
});
