// SPDX-License-Identifier: MIT
import { methodOf, requireFloats, requireOptions } from "./arguments.js";
import { filtersOf, requireTwo } from "./filters.js";
import { call, lend, number, part } from "./module.js";
import { Resource } from "./resource.js";
import { checkValidity } from "./validity.js";

const scalars = { float32: 0, float64: 1 };

function oneSet(boxes, dtype, { groups, masks }) {
  return [[boxes, filtersOf(groups, masks, boxes.length / 6)], undefined];
}

function twoSets(boxes, dtype, { other, groups, masks, invalid }) {
  requireFloats(other, "other", 6, dtype, "as boxes are");
  checkValidity(other, "other", invalid);
  const [group, mask] = [requireTwo(groups, "groups"), requireTwo(masks, "masks")];
  const filters = [boxes, other].map((set, i) => filtersOf(group[i], mask[i], set.length / 6, `[${i}]`));
  return [[boxes, filters[0]], [other, filters[1]]];
}

export class Detector extends Resource {
  #stats = { boxes: 0, invalid: 0, pairs: 0, tests: 0 };

  constructor(options = {}) {
    requireOptions(options, ["method", "cutoff"]);
    super("createDetector", "destroyDetector", ...methodOf(options));
  }

  get stats() {
    return this.#stats;
  }

  findPairs(boxes, options = {}) {
    const handle = Resource.handleOf(this);
    requireOptions(options, ["other", "groups", "masks", "invalid"]);
    const dtype = requireFloats(boxes, "boxes", 6);
    checkValidity(boxes, "boxes", options.invalid);
    const isOne = options.other === undefined || options.other === null;
    const [a, b = []] = (isOne ? oneSet : twoSets)(boxes, dtype, options);
    return lend([...a, ...b], (at, filters, otherAt = 0, otherFilters = 0) => {
      call("findPairs", handle, scalars[dtype], at, boxes.length / 6, filters, !isOne, otherAt, (b[0]?.length ?? 0) / 6, otherFilters);
      this.#stats = { boxes: number(0), invalid: number(1), pairs: number(2), tests: number(3) };
      return part(0, Uint32Array, 2);
    });
  }
}

/** A search of its own, so that no memory is kept. */
export function findPairs(boxes, options) {
  const detector = new Detector();
  try {
    return detector.findPairs(boxes, options);
  } finally {
    detector.free();
  }
}
