// SPDX-License-Identifier: MIT
// Pairs of boxes: lists of them, the definition of touching, and what tells two sets apart.

/** Do two of the boxes share a point? */
export function touch(boxes, a, b) {
  for (let d = 0, i = 6 * a, k = 6 * b; d < 3; ++d, ++i, ++k) if (!(boxes[i] <= boxes[k + 3] && boxes[k] <= boxes[i + 3])) return false;
  return true;
}

/** A list of pairs that grows. */
export class PairList {
  constructor() {
    this.numbers = new Uint32Array(1 << 16);
    this.length = 0;
  }
  add(a, b) {
    if (this.length + 2 > this.numbers.length) {
      const larger = new Uint32Array(2 * this.numbers.length);
      larger.set(this.numbers);
      this.numbers = larger;
    }
    this.numbers[this.length++] = a;
    this.numbers[this.length++] = b;
  }
  /** Two indices a pair. */
  taken() {
    return this.numbers.subarray(0, this.length);
  }
}

/** All pairs as one number each, in order. */
function keysOf(pairs, n) {
  const keys = new Float64Array(pairs.length / 2);
  for (let k = 0; k < keys.length; ++k) keys[k] = Math.min(pairs[2 * k], pairs[2 * k + 1]) * n + Math.max(pairs[2 * k], pairs[2 * k + 1]);
  return keys.sort();
}

/** What `found` lacks and what it has too much (a pair given twice, too): {missing, extra}, lists of pairs. */
export function difference(found, wanted, n) {
  const [have, want] = [keysOf(found, n), keysOf(wanted, n)];
  const pairOf = (key) => [Math.floor(key / n), key % n];
  const result = { missing: [], extra: [] };
  for (let i = 0, k = 0; i < have.length || k < want.length; ) {
    if (have[i] === want[k]) {
      ++i;
      ++k;
    } else if (k === want.length || have[i] < want[k]) result.extra.push(pairOf(have[i++]));
    else result.missing.push(pairOf(want[k++]));
  }
  return result;
}

/** Pairs with two faults: the last is missing, and one is there whose boxes do not touch. */
export function spoiled(pairs, boxes) {
  const n = boxes.length / 6;
  let stranger = 1;
  while (stranger < n && touch(boxes, 0, stranger)) ++stranger;
  return Uint32Array.from([...pairs.subarray(0, -2), ...(stranger < n ? [0, stranger] : [])]);
}
