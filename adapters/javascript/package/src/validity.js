// SPDX-License-Identifier: MIT
import { requireOneOf } from "./arguments.js";

const isValid = (boxes, i) => boxes[i] <= boxes[i + 3] && boxes[i + 1] <= boxes[i + 4] && boxes[i + 2] <= boxes[i + 5];

/** With `invalid: "throw"`, a RangeError that counts invalid boxes and names the first. */
export function checkValidity(boxes, name, invalid = "skip") {
  requireOneOf(invalid, "invalid", ["skip", "throw"]);
  if (invalid === "skip") return;
  let count = 0;
  let first = -1;
  for (let i = boxes.length - 6; i >= 0; i -= 6) if (!isValid(boxes, i)) [count, first] = [count + 1, i / 6];
  if (count > 0) {
    throw new RangeError(`${name}: expected none that is invalid (a NaN, or min > max), got ${count} of ${boxes.length / 6}; the first is box ${first}`);
  }
}
