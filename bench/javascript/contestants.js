// SPDX-License-Identifier: MIT
// Ways to all pairs of boxes. Each gets the boxes in the form that it takes best, made before the clock starts, and
// returns its pairs in one flat array.
import boxIntersect from "box-intersect";
import Flatbush from "flatbush";
import RBush from "rbush";

const rows = (boxes) => Array.from({ length: boxes.length / 6 }, (_, i) => Array.from(boxes.subarray(6 * i, 6 * i + 6)));

/** In two dimensions, as is what both trees take; the third axis is tested for what they find. */
const meetsInZ = (boxes, i, j) => boxes[6 * i + 2] <= boxes[6 * j + 5] && boxes[6 * j + 2] <= boxes[6 * i + 5];

function byBoxIntersect(input) {
  const pairs = [];
  boxIntersect(input, (i, j) => {
    pairs.push(i, j);
  });
  return pairs;
}

function byFlatbush(boxes) {
  const n = boxes.length / 6;
  const pairs = [];
  const tree = new Flatbush(n, 16, Float32Array);
  for (let i = 0; i < 6 * n; i += 6) tree.add(boxes[i], boxes[i + 1], boxes[i + 3], boxes[i + 4]);
  tree.finish();
  for (let i = 0; i < n; ++i) {
    tree.search(boxes[6 * i], boxes[6 * i + 1], boxes[6 * i + 3], boxes[6 * i + 4], (j) => {
      if (i < j && meetsInZ(boxes, i, j)) pairs.push(i, j);
      return false;
    });
  }
  return pairs;
}

function itemsOf(boxes) {
  const items = [];
  for (let i = 0, at = 0; at < boxes.length; ++i, at += 6) {
    items.push({ minX: boxes[at], minY: boxes[at + 1], maxX: boxes[at + 3], maxY: boxes[at + 4], i });
  }
  return { boxes, items };
}

function byRBush({ boxes, items }) {
  const pairs = [];
  const tree = new RBush().load(items);
  for (const item of items) {
    for (const { i } of tree.search(item)) if (item.i < i && meetsInZ(boxes, item.i, i)) pairs.push(item.i, i);
  }
  return pairs;
}

/** `boxstream` is the module under test. */
export function contestantsOf(boxstream) {
  const detector = new boxstream.Detector();
  return [
    { name: "`findPairs`", prepare: (boxes) => boxes, find: (boxes) => boxstream.findPairs(boxes) },
    { name: "`Detector`", prepare: (boxes) => boxes, find: (boxes) => detector.findPairs(boxes) },
    { name: "`box-intersect`", prepare: rows, find: byBoxIntersect },
    { name: "`flatbush`", prepare: (boxes) => boxes, find: byFlatbush },
    { name: "`rbush`", prepare: itemsOf, find: byRBush },
  ];
}
