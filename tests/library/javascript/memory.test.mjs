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

test("a freed World does not give what it has handed out before", () => {
  const world = new World();
  world.create(crowd(2));
  world.update();
  assert.equal(world.pairs.length + world.begun.length + world.ended.length, 4);
  world.free();
  for (const use of [() => world.pairs, () => world.begun, () => world.ended])
    assert.throws(use, { name: "Error", message: "this World has been freed" });
});

/** What is asked of each class. */
const uses = new Map([
  [Detector, { findPairs: (detector) => detector.findPairs(crowd(1)), findNeighbours: (detector) => detector.findNeighbours(crowd(1)), stats: (detector) => detector.stats }],
  [World, {
    size: (world) => world.size,
    dtype: (world) => world.dtype,
    create: (world) => world.create(crowd(1)),
    move: (world) => world.move(new Float64Array(1), crowd(1)),
    destroy: (world) => world.destroy(new Float64Array(1)),
    setFilters: (world) => world.setFilters(new Float64Array(1), { masks: new Uint32Array(1) }),
    clear: (world) => world.clear(),
    update: (world) => world.update(),
    contains: (world) => world.contains(new Float64Array(1)),
    boxes: (world) => world.boxes(new Float64Array(1)),
    users: (world) => world.users(new Float64Array(1)),
    bounds: (world) => world.bounds,
    begun: (world) => world.begun,
    ended: (world) => world.ended,
    pairs: (world) => world.pairs,
    queryBoxes: (world) => world.queryBoxes(crowd(1)),
    queryRays: (world) => world.queryRays(new Float32Array(3), Float32Array.of(1, 0, 0)),
    castRays: (world) => world.castRays(new Float32Array(3), Float32Array.of(1, 0, 0)),
    queryNearest: (world) => world.queryNearest(new Float32Array(3)),
  }],
]);

for (const [Class, methods] of uses)
  test(`a freed ${Class.name} says so, whatever it is asked`, () => {
    const names = Object.getOwnPropertyNames(Class.prototype).filter((name) => name !== "constructor");
    assert.deepEqual(Object.keys(methods).sort(), names.sort());
    const freed = new Class();
    freed.free();
    for (const [name, use] of Object.entries(methods))
      assert.throws(() => use(freed), { name: "Error", message: `this ${Class.name} has been freed` }, name);
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
