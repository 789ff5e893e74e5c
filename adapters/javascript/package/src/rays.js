// SPDX-License-Identifier: MIT
import { requireAsMany, requireFloats } from "./arguments.js";

/** The arrays to lend, how many rays they are, and the length of all where there is no array of lengths. */
export function raysOf(origins, directions, lengths = Infinity, dtype) {
  requireFloats(origins, "origins", 3, dtype);
  requireFloats(directions, "directions", 3, dtype);
  const count = origins.length / 3;
  requireAsMany(directions.length / 3, "directions", count, "origins");
  if (typeof lengths === "number") return { arrays: [origins, directions, undefined], count, length: lengths };
  requireFloats(lengths, "lengths", 1, dtype);
  requireAsMany(lengths.length, "lengths", count, "origins");
  return { arrays: [origins, directions, lengths], count, length: 0 };
}
