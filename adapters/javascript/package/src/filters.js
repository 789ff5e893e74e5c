// SPDX-License-Identifier: MIT
// Groups and masks as the module takes them: two numbers a box, one after the other.
import { optionalArray, typeOf } from "./arguments.js";

const everything = 0xffffffff;

/** Undefined where both are: then all boxes may pair. `suffix` tells which of two sets it is in errors. */
export function filtersOf(groups, masks, count, suffix = "") {
  const group = optionalArray(groups, `groups${suffix}`, "Uint32Array", count);
  const mask = optionalArray(masks, `masks${suffix}`, "Uint32Array", count);
  if (group === undefined && mask === undefined) return undefined;
  const filters = new Uint32Array(2 * count);
  for (let i = 0; i < count; ++i) {
    filters[2 * i] = group === undefined ? 1 : group[i];
    filters[2 * i + 1] = mask === undefined ? everything : mask[i];
  }
  return filters;
}

/** One thing for each of two sets. */
export function requireTwo(value, name) {
  if (value === undefined || value === null) return [undefined, undefined];
  if (!Array.isArray(value) || value.length !== 2) {
    throw new TypeError(`${name}: expected an array of two, for boxes and for other, got ${typeOf(value)}`);
  }
  return value;
}
