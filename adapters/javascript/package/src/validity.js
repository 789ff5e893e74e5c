// SPDX-License-Identifier: MIT
// Invalid boxes, and what boxes of which many are invalid probably are.
import { requireOneOf } from "./arguments.js";

const isValid = (boxes, i) => boxes[i] <= boxes[i + 3] && boxes[i + 1] <= boxes[i + 4] && boxes[i + 2] <= boxes[i + 5];

/** With `invalid: "throw"`, a RangeError that counts invalid boxes and names the first. */
export function checkValidity(boxes, name, invalid = "warn") {
  requireOneOf(invalid, "invalid", ["warn", "skip", "throw"]);
  if (invalid !== "throw") return;
  let count = 0;
  let first = -1;
  for (let i = boxes.length - 6; i >= 0; i -= 6) if (!isValid(boxes, i)) [count, first] = [count + 1, i / 6];
  if (count > 0) {
    throw new RangeError(`${name}: expected none that is invalid (a NaN, or min > max), got ${count} of ${boxes.length / 6}; the first is box ${first}`);
  }
}

/** The share of rows of `columns` numbers for which `holds(row)`. */
function share(boxes, columns, holds) {
  let count = 0;
  for (let i = 0; i + columns <= boxes.length; i += columns) if (holds(Array.prototype.slice.call(boxes, i, i + columns))) ++count;
  return count / Math.floor(boxes.length / columns);
}

/** Of boxes as they were given; "" for a layout that is not known. */
function likelyLayout(boxes, dimensions, inWorld) {
  const d = dimensions;
  const axes = [...Array(d).keys()];
  const all = (test) => share(boxes, 2 * d, (row) => axes.every((axis) => test(row, axis))) > 0.9;
  if (share(boxes, 2 * d, (row) => row.some(Number.isNaN)) > 0.1) return "many have a NaN";
  if (d === 3 && boxes.length % 4 === 0 && share(boxes, 4, ([a, b, c, e]) => a <= c && b <= e) > 0.9) {
    return `they seem to have two dimensions, ${inWorld ? "and need a third in a World, from 0 to 1" : "and take dimensions: 2"}`;
  }
  if (d > 1 && all((row, axis) => row[2 * axis] <= row[2 * axis + 1])) return "min and max seem interleaved, axis by axis";
  if (all((row, axis) => row[d + axis] <= row[axis])) return "maxima seem to come first, or to be sizes";
  if (all((row, axis) => row[d + axis] >= 0)) return "maxima seem to be sizes";
  return "";
}

const said = new Set();

/** Says once for each layout that more than a tenth of the boxes are invalid. */
export function warnOfInvalid({ invalid, boxes: count }, sets, dimensions, inWorld = false) {
  if (invalid <= count / 10) return;
  const layout = sets.map((set) => likelyLayout(set, dimensions, inWorld)).find((text) => text !== "") ?? "";
  if (said.has(layout)) return;
  said.add(layout);
  const why = layout === "" ? "" : `; ${layout}`;
  console.warn(`boxstream: ${invalid} of ${count} boxes are invalid (a NaN, or min > max) and pair with nothing${why}. invalid: "skip" says nothing of that, invalid: "throw" names the first.`);
}

/** The same of boxes that a World takes. */
export function warnInWorld(boxes, invalid = "warn") {
  if (invalid !== "warn") return;
  let count = 0;
  for (let i = 0; i < boxes.length; i += 6) if (!isValid(boxes, i)) ++count;
  warnOfInvalid({ invalid: count, boxes: boxes.length / 6 }, [boxes], 3, true);
}
