// SPDX-License-Identifier: MIT
// Rays and nearest boxes against the definition.
import assert from "node:assert/strict";
import test from "node:test";
import { boxstream, floatTypes, randomOf, shapes } from "./support.mjs";

const count = 1000;
const length = 0.7;

function filled(Type) {
  const random = randomOf(11);
  const boxes = shapes.sticks(Type, count, random);
  const world = new boxstream.World({ dtype: Type === Float32Array ? "float32" : "float64" });
  world.create(boxes);
  const points = (scale, shift) => Type.from({ length: 3 * 50 }, () => scale * random() + shift);
  return { world, boxes, points };
}

/** Where a ray comes in and leaves; its direction has no zeros. */
function slab(boxes, i, origins, directions, ray) {
  let [enter, leave] = [0, Infinity];
  for (let d = 0; d < 3; ++d) {
    const ends = [boxes[6 * i + d], boxes[6 * i + 3 + d]].map((x) => (x - origins[3 * ray + d]) / directions[3 * ray + d]);
    [enter, leave] = [Math.max(enter, Math.min(...ends)), Math.min(leave, Math.max(...ends))];
  }
  return [enter, leave];
}

for (const Type of floatTypes) {
  test(`rays: ${Type.name}`, () => {
    const { world, boxes, points } = filled(Type);
    const [origins, directions] = [points(1.5, 0), points(2, -1)];
    const { queries, ids, enters } = world.queryRays(origins, directions, length);
    const first = world.castRays(origins, directions, new Type(50).fill(length));
    const tolerance = Type === Float32Array ? 1e-4 : 1e-11;
    for (let ray = 0; ray < 50; ++ray) {
      const hits = new Map([...ids].map((id, k) => [id, enters[k]]).filter((_, k) => queries[k] === ray));
      for (let i = 0; i < count; ++i) {
        const [enter, leave] = slab(boxes, i, origins, directions, ray);
        if (enter < Math.min(leave, length) - tolerance) assert.ok(hits.has(i + 1), `ray ${ray} misses box ${i}`);
        if (enter > Math.min(leave, length) + tolerance) assert.ok(!hits.has(i + 1), `ray ${ray} hits box ${i}`);
        if (hits.has(i + 1)) assert.ok(Math.abs(hits.get(i + 1) - enter) < 10 * tolerance, `ray ${ray}, box ${i}`);
      }
      assert.equal(first.enters[ray], Math.min(Infinity, ...hits.values()));
      assert.equal(first.ids[ray] === 0 ? undefined : hits.get(first.ids[ray]), hits.size ? first.enters[ray] : undefined);
    }
    assert.ok(ids.length > 50 && first.ids.includes(0), `${ids.length} hits`);
  });

  test(`nearest: ${Type.name}`, () => {
    const { world, boxes, points } = filled(Type);
    const asked = points(2, -0.5);
    const found = world.queryNearest(asked, 5);
    for (let p = 0; p < 50; ++p) {
      const distance = (i) => {
        let sum = 0;
        for (let d = 0; d < 3; ++d) {
          const x = asked[3 * p + d];
          sum += Math.max(0, boxes[6 * i + d] - x, x - boxes[6 * i + 3 + d]) ** 2;
        }
        return sum;
      };
      const least = Array.from({ length: count }, (_, i) => distance(i)).sort((a, b) => a - b).slice(0, 5);
      [...found.subarray(5 * p, 5 * p + 5)].forEach((id, k) => assert.ok(Math.abs(distance(id - 1) - least[k]) < 1e-12));
    }
  });
}

test("rays without a length have no end", () => {
  const world = new boxstream.World();
  world.create(Float32Array.of(1e9, -1, -1, 2e9, 1, 1));
  const [origin, direction] = [new Float32Array(3), Float32Array.of(1, 0, 0)];
  assert.deepEqual(world.castRays(origin, direction), { ids: Float64Array.of(1), enters: Float32Array.of(1e9) });
  assert.deepEqual(world.castRays(origin, direction, 5), { ids: Float64Array.of(0), enters: Float32Array.of(Infinity) });
});

test("rays of a negative length meet nothing, also where it is -0 as a float", () => {
  const world = new boxstream.World();
  world.create(Float32Array.of(-1, -1, -1, 1, 1, 1));
  const meets = (length) => world.castRays(new Float32Array(3), Float32Array.of(1, 0, 0), length).ids[0] === 1;
  for (const length of [-Infinity, -1, -1e-45, -1e-50, -5e-324]) assert.ok(!meets(length), `${length}`);
  for (const length of [0, -0, 1e-50]) assert.ok(meets(length), `${length}`);
});

test("fewer boxes than asked for", () => {
  const world = new boxstream.World({ dtype: "float64" });
  world.create(Float64Array.of(0, 0, 0, 1, 1, 1, 5, 5, 5, 6, 6, 6, NaN, NaN, NaN, NaN, NaN, NaN));
  assert.deepEqual([...world.queryNearest(Float64Array.of(7, 7, 7), 4)], [2, 1, 0, 0]);
  for (const count of [4, 2 ** 31 + 5]) assert.equal(world.queryNearest(new Float64Array(0), count).length, 0);
  assert.equal(world.queryNearest(new Float64Array(6), 0).length, 0);
});
