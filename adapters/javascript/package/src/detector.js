// SPDX-License-Identifier: MIT
import { boxTypes, methodOf, optionalArray, requireBoolean, requireBoxes, requireInteger, requireOptions, typeOf } from "./arguments.js";
import { filtersOf, requireTwo } from "./filters.js";
import { call, functions, lend, number, part } from "./module.js";
import { Resource } from "./resource.js";
import { checkValidity, warnOfInvalid } from "./validity.js";

const scalars = { float32: 0, float64: 1, int32: 2 };
const names = ["other", "groups", "masks", "ids", "idsA", "idsB", "closed", "tolerance", "dimensions", "invalid"];

/** Boxes of fewer dimensions, from 0 to 1 in the others: closed or not, all pairs are decided by what was given. */
function inSpace(boxes, dimensions, dtype) {
  if (dimensions === 3) return boxes;
  const all = new boxTypes[dtype]((boxes.length / dimensions) * 3);
  for (let from = 0, to = 0; from < boxes.length; to += 6) {
    for (let d = 0; d < dimensions; ++d) all[to + d] = boxes[from++];
    for (let d = 0; d < 3; ++d) all[to + 3 + d] = d < dimensions ? boxes[from++] : 1;
  }
  return all;
}

function toleranceOf(value) {
  if (typeof value !== "number") throw new TypeError(`tolerance: expected a number, got ${typeOf(value)}`);
  if (!(value >= 0 && value < Infinity)) throw new RangeError(`tolerance: expected a finite number that is not below 0, got ${value}`);
  return value;
}

/** What a search is of, checked: one set of boxes or two, each with filters and ids, and rules. */
function read(boxes, options) {
  const { other, groups, masks, ids, idsA, idsB, closed = true, tolerance = 0, dimensions = 3, invalid = "warn" } = options;
  requireInteger(dimensions, "dimensions", 1);
  if (dimensions > 3) throw new RangeError(`dimensions: expected 1, 2 or 3, got ${dimensions}`);
  requireBoolean(closed, "closed");
  const dtype = requireBoxes(boxes, "boxes", dimensions);
  const set = (given, name, filters, own, ownName) => {
    const all = inSpace(given, dimensions, dtype);
    checkValidity(all, name, invalid);
    const count = all.length / 6;
    return { boxes: all, count, filters: filters(count), ids: optionalArray(own, ownName, "Uint32Array", count) };
  };
  const search = { scalar: scalars[dtype], dimensions, invalid, closed, tolerance: toleranceOf(tolerance) };
  if (other === undefined || other === null) {
    if (idsA !== undefined || idsB !== undefined) throw new TypeError("idsA, idsB: are of two sets of boxes; those of one are ids");
    const a = set(boxes, "boxes", (count) => filtersOf(groups, masks, count), ids, "ids");
    return { ...search, given: [boxes], a, b: { count: 0 }, ofTwo: false };
  }
  if (ids !== undefined) throw new TypeError("ids: are of one set of boxes; those of two are idsA and idsB");
  if ((idsA === undefined) !== (idsB === undefined)) throw new TypeError("idsA, idsB: expected both or neither, got one");
  requireBoxes(other, "other", dimensions, dtype);
  const [group, mask] = [requireTwo(groups, "groups"), requireTwo(masks, "masks")];
  const filters = (i) => (count) => filtersOf(group[i], mask[i], count, `[${i}]`);
  const [a, b] = [set(boxes, "boxes", filters(0), idsA, "idsA"), set(other, "other", filters(1), idsB, "idsB")];
  return { ...search, given: [boxes, other], a, b, ofTwo: true };
}

export class Detector extends Resource {
  #stats = { boxes: 0, invalid: 0, pairs: 0, tests: 0 };

  constructor(options = {}) {
    requireOptions(options, ["method", "cutoff"]);
    super("createDetector", "destroyDetector", ...methodOf(options));
  }

  get stats() {
    Resource.handleOf(this);
    return this.#stats;
  }

  /** Calls the function of that name, and returns what `take` makes of the answer. */
  #search(name, search, more, take) {
    const handle = Resource.handleOf(this);
    const { a, b } = search;
    const found = lend([a.boxes, a.filters, a.ids, b.boxes, b.filters, b.ids], (atA, filtersA, idsA, atB, filtersB, idsB) => {
      const given = [handle, search.scalar, atA, a.count, filtersA, idsA, search.ofTwo, atB, b.count, filtersB, idsB, search.closed, search.tolerance];
      call(name, ...given, ...more);
      this.#stats = { boxes: number(0), invalid: number(1), pairs: number(2), tests: number(3) };
      return take();
    });
    if (search.invalid === "warn") warnOfInvalid(this.#stats, search.given, search.dimensions);
    return found;
  }

  findPairs(boxes, options = {}) {
    requireOptions(options, names);
    return this.#search("findPairs", read(boxes, options), [], () => part(0, Uint32Array, 2));
  }

  findNeighbours(boxes, options = {}) {
    requireOptions(options, [...names, "both"]);
    const { both = true } = options;
    requireBoolean(both, "both");
    const take = () => {
      const rows = { offsets: part(0, Uint32Array), indices: part(1, Uint32Array) };
      functions.forget();
      return rows;
    };
    return this.#search("findNeighbours", read(boxes, options), [both], take);
  }
}

/** A search of its own, so that no memory is kept. */
function once(search) {
  const detector = new Detector();
  try {
    return search(detector);
  } finally {
    detector.free();
  }
}

export const findPairs = (boxes, options) => once((detector) => detector.findPairs(boxes, options));
export const findNeighbours = (boxes, options) => once((detector) => detector.findNeighbours(boxes, options));
