// SPDX-License-Identifier: MIT
// As live/contestants.js, of rectangles: four numbers each, which all of these packages are made for.
import boxIntersect from "box-intersect";
import Flatbush from "flatbush";
import RBush from "rbush";
import { PairList } from "./live/pairs.js";

const each = (boxes, use) => Array.from({ length: boxes.length / 4 }, (_, i) => use(...boxes.subarray(4 * i, 4 * i + 4), i));

function withBoxIntersect(rows) {
  const pairs = new PairList();
  boxIntersect(rows, (a, b) => pairs.add(a, b));
  return pairs.taken();
}

function withFlatbush(boxes) {
  const n = boxes.length / 4;
  const tree = new Flatbush(n, 16, boxes.constructor);
  for (let i = 0; i < 4 * n; i += 4) tree.add(boxes[i], boxes[i + 1], boxes[i + 2], boxes[i + 3]);
  tree.finish();
  const pairs = new PairList();
  for (let a = 0; a < n; ++a)
    tree.search(boxes[4 * a], boxes[4 * a + 1], boxes[4 * a + 2], boxes[4 * a + 3], (b) => {
      if (a < b) pairs.add(a, b);
      return false;
    });
  return pairs.taken();
}

function withRBush(items) {
  const tree = new RBush().load(items);
  const pairs = new PairList();
  for (const item of items) for (const { i } of tree.search(item)) if (item.i < i) pairs.add(item.i, i);
  return pairs.taken();
}

export const contestants = {
  "box-intersect": { prepare: (boxes) => each(boxes, (...row) => row.slice(0, 4)), run: withBoxIntersect },
  flatbush: { prepare: (boxes) => boxes, run: withFlatbush },
  rbush: { prepare: (boxes) => each(boxes, (minX, minY, maxX, maxY, i) => ({ minX, minY, maxX, maxY, i })), run: withRBush },
};
