// SPDX-License-Identifier: MIT
// Wrong arguments have one clear exception, and leave objects as they were.
import assert from "node:assert/strict";
import test from "node:test";
import vm from "node:vm";
import { boxstream } from "./support.mjs";

const { Detector, findPairs, World } = boxstream;
const boxes = new Float32Array(24);
const doubles = new Float64Array(24);
const numbers = "expected a Float32Array or Float64Array or Int32Array";

const cases = [
  [() => new Detector({ method: "best" }), RangeError, 'method: expected "planned" or "hybrid", got "best"'],
  [() => new Detector({ method: 7 }), TypeError, 'method: expected "planned" or "hybrid", got number'],
  [() => new World({ dtype: 64n }), TypeError, 'dtype: expected "float32" or "float64", got bigint'],
  [() => new World().create(boxes, { invalid: null }), TypeError, 'invalid: expected "warn" or "skip" or "throw", got null'],
  [() => new World({ cutoff: -1 }), RangeError, "cutoff: expected an integer of at least 0, got -1"],
  [() => new Detector({ cutoff: 2 ** 32 }), RangeError, "cutoff: expected an integer below 2^32, got 4294967296"],
  [() => findPairs(), TypeError, `boxes: ${numbers}, got undefined`],
  [() => findPairs(null), TypeError, `boxes: ${numbers}, got null`],
  [() => findPairs([0, 0, 0, 1, 1, 1]), TypeError, `boxes: ${numbers}, got Array; Float64Array.from(numbers) makes one`],
  [() => findPairs([[0, 0, 1, 1]]), TypeError, `boxes: ${numbers}, got Array; Float64Array.from(rows.flat()) makes one`],
  [() => findPairs([{ minX: 0, minY: 0, maxX: 1, maxY: 1 }], { dimensions: 2 }), TypeError, `boxes: ${numbers}, got Array; Float64Array.from(objects.flatMap((o) => [o.minX, o.minY, o.maxX, o.maxY])) makes one`],
  [() => findPairs(boxes, boxes), TypeError, "options: expected an object, got Float32Array; a second set of boxes is { other: boxes }"],
  [() => new World([]), TypeError, "options: expected an object, got Array"],
  [() => findPairs("boxes"), TypeError, `boxes: ${numbers}, got string`],
  [() => findPairs(new Uint32Array(6)), TypeError, `boxes: ${numbers}, got Uint32Array; Float64Array.from(numbers) makes one`],
  [() => findPairs(new ArrayBuffer(24)), TypeError, `boxes: ${numbers}, got ArrayBuffer`],
  [() => findPairs(new DataView(new ArrayBuffer(24))), TypeError, `boxes: ${numbers}, got DataView`],
  [() => findPairs(new Float32Array(8)), RangeError, "boxes: expected a length that is a multiple of 6, got 8; boxes of two dimensions take dimensions: 2"],
  [() => findPairs(boxes, { dimensions: 4 }), RangeError, "dimensions: expected 1, 2 or 3, got 4"],
  [() => findPairs(boxes, { closed: 0 }), TypeError, "closed: expected true or false, got number"],
  [() => findPairs(boxes, { tolerance: -1 }), RangeError, "tolerance: expected a finite number that is not below 0, got -1"],
  [() => findPairs(boxes, { tolerance: "1" }), TypeError, "tolerance: expected a number, got string"],
  [() => findPairs(boxes, { ids: new Uint32Array(3) }), RangeError, "ids: expected 4 elements, got 3"],
  [() => findPairs(boxes, { idsA: new Uint32Array(4) }), TypeError, "idsA, idsB: are of two sets of boxes; those of one are ids"],
  [() => findPairs(boxes, { other: boxes, ids: new Uint32Array(4) }), TypeError, "ids: are of one set of boxes; those of two are idsA and idsB"],
  [() => findPairs(boxes, { other: boxes, idsB: new Uint32Array(4) }), TypeError, "idsA, idsB: expected both or neither, got one"],
  [() => new Detector().findNeighbours(boxes, { both: 1 }), TypeError, "both: expected true or false, got number"],
  [() => findPairs(new Float32Array(7)), RangeError, "boxes: expected a length that is a multiple of 6, got 7"],
  [() => findPairs(boxes, { other: doubles }), TypeError, "other: expected a Float32Array, as boxes are, got Float64Array; Float32Array.from(numbers) makes one, rounded"],
  [() => findPairs(boxes, { other: new Float32Array(3) }), RangeError, "other: expected a length that is a multiple of 6, got 3"],
  [() => findPairs(boxes, { groups: [1, 2, 3, 4] }), TypeError, "groups: expected a Uint32Array, got Array; Uint32Array.from(numbers) makes one"],
  [() => findPairs(boxes, { groups: new Int32Array(4) }), TypeError, "groups: expected a Uint32Array, got Int32Array; Uint32Array.from(numbers) makes one"],
  [() => findPairs(boxes, { masks: new Uint32Array(5) }), RangeError, "masks: expected 4 elements, got 5"],
  [() => findPairs(boxes, { other: boxes, groups: new Uint32Array(4) }), TypeError, "groups: expected an array of two, for boxes and for other, got Uint32Array"],
  [() => findPairs(boxes, { other: boxes, masks: [undefined, new Uint32Array(3)] }), RangeError, "masks[1]: expected 4 elements, got 3"],
  [() => findPairs(boxes, { invalid: "raise" }), RangeError, 'invalid: expected "warn" or "skip" or "throw", got "raise"'],
  [() => findPairs(boxes, "skip"), TypeError, "options: expected an object, got string"],
  [() => findPairs(boxes, { group: new Uint32Array(4) }), TypeError, "options: expected of other, groups, masks, ids, idsA, idsB, closed, tolerance, dimensions, invalid, got group"],
  [() => new World().create(boxes, { user: 1 }), TypeError, "options: expected of groups, masks, users, invalid, got user"],
  [() => new World().move(new Float64Array(4), boxes, { invalids: "throw" }), TypeError, "options: expected of invalid, got invalids"],
  [() => new World().move(new Float64Array(4), boxes, "throw"), TypeError, "options: expected an object, got string"],
  [() => new World().setFilters(new Float64Array(1), { mask: new Uint32Array(1) }), TypeError, "options: expected of groups, masks, got mask"],
  [() => new World().setFilters(new Float64Array(1), new Uint32Array(1)), TypeError, "options: expected an object, got Uint32Array"],
  [() => new World({ stickyFilters: "false" }), TypeError, "stickyFilters: expected true or false, got string"],
  [() => new World({ stickyFilters: 0 }), TypeError, "stickyFilters: expected true or false, got number"],
  [() => new World("float64"), TypeError, "options: expected an object, got string"],
  [() => new World({ dtype: "int32" }), RangeError, 'dtype: expected "float32" or "float64", got "int32"'],
  [() => new World().create(doubles), TypeError, "boxes: expected a Float32Array, as the World has, got Float64Array; Float32Array.from(numbers) makes one, rounded"],
  [() => new World({ dtype: "float64" }).create(boxes), TypeError, "boxes: expected a Float64Array, as the World has, got Float32Array; Float64Array.from(numbers) makes one"],
  [() => new World().create(boxes, { users: new Float64Array(4) }), TypeError, "users: expected a Uint32Array, got Float64Array; Uint32Array.from(numbers) makes one"],
  [() => new World().create(boxes, { users: new Uint32Array(3) }), RangeError, "users: expected 4 elements, got 3"],
  [() => new World().move(new Float64Array(3), boxes), RangeError, "boxes: expected one for each of 3 ids, got 4"],
  [() => new World().move([1], boxes), TypeError, "ids: expected a Float64Array, got Array; Float64Array.from(numbers) makes one"],
  [() => new World().destroy(1), TypeError, "ids: expected a Float64Array, got number"],
  [() => new World().setFilters(new Float64Array(1), { masks: new Uint32Array(2) }), RangeError, "masks: expected 1 elements, got 2"],
  [() => new World().boxes(new Float64Array(1)), RangeError, "ids: expected ids of live proxies, got a stale or null one at ids[0]"],
  [() => new World().users(Float64Array.of(7)), RangeError, "ids: expected ids of live proxies, got a stale or null one at ids[0]"],
  [() => new World().queryRays(new Float32Array(3), new Float32Array(6)), RangeError, "directions: expected one for each of 1 origins, got 2"],
  [() => new World().queryRays(new Float64Array(3), new Float64Array(3)), TypeError, "origins: expected a Float32Array, as the World has, got Float64Array; Float32Array.from(numbers) makes one, rounded"],
  [() => new World().castRays(new Float32Array(3), new Float32Array(3), new Float32Array(2)), RangeError, "lengths: expected one for each of 1 origins, got 2"],
  [() => new World().castRays(new Float32Array(3), new Float32Array(3), "far"), TypeError, "lengths: expected a Float32Array, as the World has, got string"],
  [() => new World().queryNearest(new Float32Array(2)), RangeError, "points: expected a length that is a multiple of 3, got 2"],
  [() => new World().queryNearest(new Float32Array(3), -1), RangeError, "count: expected an integer of at least 0, got -1"],
  [() => new World().queryNearest(new Float32Array(3), 1.5), RangeError, "count: expected an integer of at least 0, got 1.5"],
  [() => new World().queryNearest(new Float32Array(3), "1"), TypeError, "count: expected an integer, got string"],
  [() => new World().queryNearest(new Float32Array(3), 2 ** 40), RangeError, `count: too many for 1 points, got ${2 ** 40}`],
];

for (const [call, type, message] of cases) {
  test(message, () => assert.throws(call, (error) => error.constructor === type && (assert.equal(error.message, message), true)));
}

test("invalid boxes can be an error", () => {
  const some = Float64Array.of(0, 0, 0, 1, 1, 1, 0, 0, 0, NaN, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0, 0, Infinity, 1, 1);
  const message = "expected none that is invalid (a NaN, or min > max), got 2 of 4; the first is box 1";
  assert.deepEqual([...findPairs(some)], [0, 3]);
  assert.throws(() => findPairs(some, { invalid: "throw" }), { name: "RangeError", message: `boxes: ${message}` });
  const valid = some.slice(0, 6);
  assert.throws(() => findPairs(valid, { other: some, invalid: "throw" }), { message: `other: ${message}` });
  const world = new World({ dtype: "float64" });
  assert.throws(() => world.create(some, { invalid: "throw" }), { message: `boxes: ${message}` });
  assert.equal(world.size, 0);
  const ids = world.create(some);
  assert.equal(world.update().invalid, 2);
  assert.throws(() => world.move(ids, some, { invalid: "throw" }), { message: `boxes: ${message}` });
  assert.deepEqual([...findPairs(valid, { invalid: "throw" })], []);
});

test("a Detector counts invalid boxes", () => {
  const detector = new Detector();
  detector.findPairs(Float32Array.of(0, 0, 0, 1, NaN, 1, 0, 0, 0, 1, 1, 1));
  assert.equal(detector.stats.invalid, 1);
});

test("an error leaves a World as it was", () => {
  const world = new World();
  const ids = world.create(boxes);
  world.update();
  for (const call of [() => world.create(doubles), () => world.move(ids, doubles), () => world.boxes(new Float64Array(2))])
    assert.throws(call);
  assert.equal(world.size, 4);
  assert.equal(world.pairs.length, 12);
});

test("arrays of another realm are taken", () => {
  const foreign = vm.runInNewContext("Float32Array.of(0, 0, 0, 1, 1, 1, 1, 0, 0, 2, 1, 1)");
  assert.ok(!(foreign instanceof Float32Array));
  assert.deepEqual([...findPairs(foreign)], [0, 1]);
});

/** Arrays whose class makes others than it is asked for. */
function ownClassOf(Type) {
  class Own extends Type {
    constructor() {
      super(12);
    }
  }
  const own = new Own();
  own.set([0, 0, 0, 2, 2, 2, 1, 1, 1, 3, 3, 3]);
  return own;
}

test("arrays of classes that extend typed arrays are taken", () => {
  for (const Type of [Float32Array, Float64Array, Int32Array]) {
    const own = ownClassOf(Type);
    assert.deepEqual([...findPairs(own)], [0, 1]);
    for (const options of [{ dimensions: 2, invalid: "skip" }, { dimensions: 1 }])
      assert.deepEqual([...findPairs(own, options)], [...findPairs(Type.from(own), options)]);
  }
  const world = new World();
  const own = ownClassOf(Float32Array);
  assert.deepEqual(world.boxes(world.create(own)), Float32Array.from(own));
});

test("arrays in shared memory are taken", () => {
  const shared = new Float32Array(new SharedArrayBuffer(48));
  assert.deepEqual([...findPairs(shared)], [0, 1]);
});
