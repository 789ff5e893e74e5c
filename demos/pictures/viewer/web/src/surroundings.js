// SPDX-License-Identifier: MIT
import { Box3, Vector3 } from "three";
import { boxOf } from "./boxes.js";

/** In `run.states`: what never moves. */
export const fixedState = 0;

/** Around all scenery that has an end, and where the crowd is at first. */
export function boundsOf(run, first) {
  const [min, max] = [[0, 0, 0], [0, 0, 0]];
  const [low, high] = run.crowds[0];
  const all = new Box3(new Vector3(...low), new Vector3(...high));
  run.states.forEach((state, object) => {
    if (state === fixedState && boxOf(first, object, run, min, max)) all.union(new Box3(new Vector3(...min), new Vector3(...max)));
  });
  return all;
}

/** Heights of the planes that things can stand on. */
export function floorsOf({ forms, parts, unit, fine, rotationUnit }, first) {
  const upright = ([x, , z]) => Math.abs(x) < 1e-3 && Math.abs(z) < 1e-3;
  const rotationOf = (object) => [...first.rotations.subarray(4 * object, 4 * object + 3)].map((x) => (x * rotationUnit) / fine);
  const isFloor = ([object, form, , , rotation = [0, 0, 0, 1]]) => forms[form].kind === "plane" && upright(rotation) && upright(rotationOf(object));
  return parts.filter(isFloor).map(([object, , , place = [0, 0, 0]]) => (unit * first.places[3 * object + 1]) / fine + place[1]);
}
