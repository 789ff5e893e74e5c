// SPDX-License-Identifier: MIT
// Boxes as users have them, and the random ones of the live page: of so many dimensions, numbers of a box as the package
// takes them.
import { makeBoxes } from "./live/inputs.js";
import { Random } from "./live/random.js";

/** Sprites of an atlas in whole pixels, shelf by shelf, side by side: most touch their neighbours. */
function atlas(n, random) {
  const boxes = new Int32Array(4 * n);
  const width = Math.ceil(Math.sqrt(n) * 48);
  let x = 0;
  let y = 0;
  let shelf = 0;
  for (let i = 0; i < 4 * n; i += 4) {
    const w = 8 * random.integer(2, 10);
    const h = 8 * random.integer(2, 10);
    if (x + w > width) {
      x = 0;
      y += shelf;
      shelf = 0;
    }
    boxes.set([x, y, x + w, y + h], i);
    x += w;
    shelf = Math.max(shelf, h);
  }
  return boxes;
}

/** Labels of a map, in metres of a projection: towns crowd, and so do their names. */
function labels(n, random) {
  const boxes = new Float64Array(4 * n);
  const towns = Array.from({ length: Math.max(1, Math.round(n / 50)) }, () => [random.real(-2e7, 2e7), random.real(-2e7, 2e7), random.real(2e4, 4e5)]);
  const height = 4e7 / Math.sqrt(n) / 40;
  for (let i = 0; i < 4 * n; i += 4) {
    const [x, y, reach] = towns[random.integer(0, towns.length - 1)];
    const low = [x + random.real(-reach, reach), y + random.real(-reach, reach)];
    boxes.set([...low, low[0] + height * random.real(3, 12), low[1] + height], i);
  }
  return boxes;
}

/** Parts of a machine in millimetres, as doubles: many small ones, some that reach through it. */
function parts(n, random) {
  const boxes = new Float64Array(6 * n);
  const room = 40 * Math.cbrt(n);
  for (let i = 0; i < 6 * n; i += 6)
    for (let d = 0; d < 3; ++d) {
      boxes[i + d] = random.real(0, room);
      boxes[i + 3 + d] = boxes[i + d] + (random.integer(0, 99) === 0 ? random.real(0, room / 8) : random.real(0.1, 30));
    }
  return boxes;
}

const of = (dimensions, kind, make) => ({ dimensions, kind, make: (n) => make(n, new Random(1)) });

export const data = {
  atlas: of(2, "`Int32Array`", atlas),
  labels: of(2, "`Float64Array`", labels),
  parts: of(3, "`Float64Array`", parts),
  U: of(3, "`Float32Array`", (n) => Float32Array.from(makeBoxes("U", n, 1))),
};
