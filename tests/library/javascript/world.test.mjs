// SPDX-License-Identifier: MIT
// World against a map of boxes and brute force.
import assert from "node:assert/strict";
import test from "node:test";
import { boxstream, bruteForce, floatTypes, pairSet, randomOf, sameSets, shapes } from "./support.mjs";

const { World } = boxstream;
const dtypeOf = (Type) => (Type === Float32Array ? "float32" : "float64");

/** A World and what it has to contain: box, group and mask by id, in order of creation. */
class History {
  constructor(Type, shape, seed) {
    this.Type = Type;
    this.make = shapes[shape];
    this.random = randomOf(seed);
    this.world = new World({ dtype: dtypeOf(Type) });
    this.model = new Map();
    this.gone = [];
    this.held = new Set();
    this.where = `${Type.name}, ${shape}, seed ${seed}`;
  }

  some(ids) {
    return ids.filter(() => this.random() < 0.3);
  }

  bits(count) {
    return Uint32Array.from({ length: count }, () => (this.random() < 0.8 ? 0xffffffff : Math.floor(4 * this.random())));
  }

  create() {
    const boxes = this.make(this.Type, Math.floor(9 * this.random()), this.random);
    const [groups, masks] = [this.bits(boxes.length / 6), this.bits(boxes.length / 6)];
    const ids = this.world.create(boxes, { groups, masks });
    assert.equal(ids.length, boxes.length / 6);
    ids.forEach((id, i) => {
      assert.ok(id > 0 && Number.isSafeInteger(id) && !this.model.has(id) && !this.gone.includes(id), this.where);
      this.model.set(id, { box: boxes.slice(6 * i, 6 * i + 6), group: groups[i], mask: masks[i] });
    });
  }

  move() {
    const ids = [...this.some([...this.model.keys()]), ...this.some(this.gone)];
    const boxes = this.make(this.Type, ids.length, this.random);
    let live = 0;
    ids.forEach((id, i) => {
      if (!this.model.has(id)) return;
      this.model.get(id).box = boxes.slice(6 * i, 6 * i + 6);
      live += 1;
    });
    assert.equal(this.world.move(Float64Array.from(ids), boxes), live, this.where);
  }

  destroy() {
    const live = this.some([...this.model.keys()]);
    assert.equal(this.world.destroy(Float64Array.from([...live, ...this.some(this.gone)])), live.length, this.where);
    for (const id of live) this.model.delete(id);
    this.gone.push(...live);
  }

  setFilters() {
    const ids = this.some([...this.model.keys()]);
    const masks = this.bits(ids.length);
    assert.equal(this.world.setFilters(Float64Array.from(ids), { masks }), ids.length);
    ids.forEach((id, i) => Object.assign(this.model.get(id), { group: 1, mask: masks[i] }));
  }

  boxes() {
    return this.Type.from([...this.model.values()].flatMap(({ box }) => [...box]));
  }

  expected() {
    const all = [...this.model.values()];
    const ids = [...this.model.keys()];
    const meet = (i, j) => (all[i].group & all[j].mask) !== 0 && (all[j].group & all[i].mask) !== 0;
    return [...bruteForce(this.boxes(), undefined, meet)].map((pair) => pair.split(" ").map((i) => ids[i]).join(" "));
  }

  update() {
    const stats = this.world.update();
    const expected = this.expected();
    const pairs = pairSet(this.world.pairs);
    assert.deepEqual([...pairs], expected, this.where);
    sameSets(pairSet(this.world.begun), new Set(expected.filter((pair) => !this.held.has(pair))), `${this.where}, begun`);
    sameSets(pairSet(this.world.ended), new Set([...this.held].filter((pair) => !pairs.has(pair))), `${this.where}, ended`);
    assert.equal(stats.pairs, pairs.size);
    assert.equal(stats.begun, this.world.begun.length / 2);
    assert.equal(stats.ended, this.world.ended.length / 2);
    assert.equal(stats.proxies, this.model.size);
    this.held = pairs;
  }

  query() {
    const asked = this.make(this.Type, 3, this.random);
    const { queries, ids } = this.world.queryBoxes(asked);
    const order = [...this.model.keys()];
    const found = new Set([...queries].map((query, i) => `${query} ${order.indexOf(ids[i])}`));
    sameSets(found, bruteForce(asked, this.boxes()), `${this.where}, queryBoxes`);
    assert.ok(queries.every((query, i) => i === 0 || queries[i - 1] <= query));
  }

  check() {
    const ids = Float64Array.from(this.model.keys());
    assert.equal(this.world.size, ids.length);
    assert.ok(this.world.contains(ids).every((live) => live === 1));
    assert.ok(this.world.contains(Float64Array.from([...this.gone, 0, -1, 1.5, NaN, Infinity, 2 ** 60])).every((live) => live === 0));
    assert.deepEqual(this.world.boxes(ids), this.boxes(), this.where);
  }
}

for (const Type of floatTypes) {
  for (const shape of ["lattice", "special", "cubes"]) {
    test(`any history: ${Type.name}, ${shape}`, () => {
      for (let seed = 1; seed <= 25; ++seed) {
        const history = new History(Type, shape, seed);
        const steps = ["create", "create", "move", "destroy", "setFilters", "update", "update", "query"];
        for (let step = 0; step < 60; ++step) {
          history[steps[Math.floor(steps.length * history.random())]]();
          history.check();
        }
        history.update();
        history.world.free();
      }
    });
  }
}

test("many boxes move", () => {
  const random = randomOf(3);
  const boxes = shapes.cubes(Float32Array, 3000, random);
  const world = new World();
  const ids = world.create(boxes, { users: Uint32Array.from({ length: 3000 }, (_, i) => 10 * i) });
  for (let step = 0; step < 4; ++step) {
    assert.equal(world.move(ids, boxes), 3000);
    world.update();
    const tens = world.users(world.pairs).map((user) => user / 10);
    sameSets(pairSet(tens), bruteForce(boxes), `step ${step}`);
    for (let i = 0; i < boxes.length; i += 12) [boxes[i], boxes[i + 3]] = [boxes[i] + 0.01, boxes[i + 3] + 0.01];
  }
});

test("ids start at 1, are stale after destroy, and start again after clear", () => {
  const world = new World();
  const boxes = new Float32Array(18);
  const first = world.create(boxes);
  assert.deepEqual([...first], [1, 2, 3]);
  world.destroy(first.subarray(1, 2));
  const [again] = world.create(boxes.subarray(6, 12));
  assert.ok(again > 2 ** 32);
  assert.deepEqual([...world.contains(Float64Array.of(1, 2, 3, again))], [1, 0, 1, 1]);
  world.clear();
  assert.equal(world.size, 0);
  assert.deepEqual([...world.contains(Float64Array.of(1, 2, 3, again))], [0, 0, 0, 0]);
  assert.deepEqual([...world.create(boxes)], [1, 2, 3]);
});

test("a new proxy takes no longer where there are many", () => {
  const world = new World();
  const box = new Float32Array(6);
  const microseconds = () => {
    const begin = process.cpuUsage();
    for (let i = 0; i < 20_000; ++i) world.create(box);
    const { user, system } = process.cpuUsage(begin);
    return user + system;
  };
  const leastOfThree = () => Math.min(microseconds(), microseconds(), microseconds());
  const first = leastOfThree(); // the first of which is compiled meanwhile
  world.create(new Float32Array(6 * 1_000_000));
  const later = leastOfThree();
  // With a copy of what is known of all for each of them it takes 24 times as long.
  assert.ok(later < 8 * first, `${first} us, later ${later} us`);
});

test("an id stays stale through many uses of its place", () => {
  const world = new World();
  const box = new Float32Array(6);
  const [first] = world.create(box);
  let last = Float64Array.of(first);
  for (let i = 0; i < 10000; ++i) {
    world.destroy(last);
    last = world.create(box);
    assert.deepEqual([...world.contains(Float64Array.of(first, last[0]))], [0, 1]);
  }
});

test("bounds, dtype and sticky filters", () => {
  const world = new World({ dtype: "float64", stickyFilters: true });
  assert.equal(world.dtype, "float64");
  assert.ok(world.bounds[0] > world.bounds[3]);
  const ids = world.create(Float64Array.of(0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2));
  assert.deepEqual(world.bounds, Float64Array.of(0, 0, 0, 2, 2, 2));
  assert.equal(world.update().begun, 1);
  world.setFilters(ids, { masks: new Uint32Array(2) });
  assert.equal(world.update().pairs, 1);
});

test("pairs and events are one array until the next update, which leaves it as it is", () => {
  const world = new World();
  const ids = world.create(new Float32Array(18));
  world.update();
  const { begun, ended, pairs } = world;
  world.destroy(ids);
  assert.equal(world.begun, begun);
  assert.equal(world.ended, ended);
  assert.equal(world.pairs, pairs);
  pairs[0] = 7;
  assert.equal(world.pairs[0], 7);
  pairs[0] = 1;
  world.update();
  assert.deepEqual([...begun], [1, 2, 1, 3, 2, 3]);
  assert.deepEqual(pairs, begun);
  assert.deepEqual(world.ended, begun);
  assert.equal(world.begun.length, 0);
  world.clear();
  assert.equal(world.ended.length, 0);
});
