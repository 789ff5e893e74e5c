// SPDX-License-Identifier: MIT
// Others who find the same pairs. `prepare` brings the boxes into the form that the package takes and is not timed;
// `run` is all that it takes to have the pairs of boxes that have moved.
import boxIntersect from "box-intersect";
import Flatbush from "flatbush";
import RBush from "rbush";
import { PairList, touch } from "./pairs.js";

const rows = (boxes) => Array.from({ length: boxes.length / 6 }, (_, i) => Array.from(boxes.subarray(6 * i, 6 * i + 6)));

function withBoxIntersect(list) {
  const pairs = new PairList();
  boxIntersect(list, (a, b) => pairs.add(a, b));
  return pairs.taken();
}

const overlapInZ = (boxes, a, b) => boxes[6 * a + 2] <= boxes[6 * b + 5] && boxes[6 * b + 2] <= boxes[6 * a + 5];

/** A tree of rectangles in numbers of the boxes' kind, so the third axis is compared outside of it. */
function withFlatbush(boxes) {
  const n = boxes.length / 6;
  const tree = new Flatbush(n, 16, boxes.constructor);
  for (let i = 0; i < 6 * n; i += 6) tree.add(boxes[i], boxes[i + 1], boxes[i + 3], boxes[i + 4]);
  tree.finish();
  const pairs = new PairList();
  for (let a = 0; a < n; ++a)
    tree.search(boxes[6 * a], boxes[6 * a + 1], boxes[6 * a + 3], boxes[6 * a + 4], (b) => {
      if (a < b && overlapInZ(boxes, a, b)) pairs.add(a, b);
      return false;
    });
  return pairs.taken();
}

const rectangles = (boxes) => ({
  boxes,
  items: Array.from({ length: boxes.length / 6 }, (_, i) => ({ minX: boxes[6 * i], minY: boxes[6 * i + 1], maxX: boxes[6 * i + 3], maxY: boxes[6 * i + 4], i })),
});

function withRBush({ boxes, items }) {
  const tree = new RBush().load(items);
  const pairs = new PairList();
  for (const item of items) for (const { i } of tree.search(item)) if (item.i < i && overlapInZ(boxes, item.i, i)) pairs.add(item.i, i);
  return pairs.taken();
}

function byBruteForce(boxes) {
  const pairs = new PairList();
  for (let a = 0; a < boxes.length / 6; ++a) for (let b = 0; b < a; ++b) if (touch(boxes, a, b)) pairs.add(b, a);
  return pairs.taken();
}

const asTheyAre = (boxes) => boxes;

export const contestants = {
  "brute force": { prepare: asTheyAre, run: byBruteForce },
  "box-intersect": { prepare: rows, run: withBoxIntersect },
  flatbush: { prepare: asTheyAre, run: withFlatbush },
  rbush: { prepare: rectangles, run: withRBush },
};
