// SPDX-License-Identifier: MIT
import { Box3, Vector3 } from "three";
import { notANumber } from "./poses.js";

// Boxes that reach this far, in units, have no end there.
const endless = 2 ** 24;

/** The box of an object in a frame, in the units of the world; false if there is none, or no end to it. */
export function boxOf(frame, object, run, min, max) {
  const { boxes } = frame;
  const from = (frame.former ?? frame).places;
  for (let d = 0; d < 3; ++d) {
    if (boxes[6 * object + d] === notANumber) return false;
    const place = from[3 * object + d];
    const middle = 2 * boxes[6 * object + d] + (place === notANumber ? 0 : place);
    const half = Math.max(boxes[6 * object + 3 + d], 0);
    if (Math.abs(middle) + half >= endless * run.fine) return false;
    min[d] = ((middle - half) * run.unit) / run.fine;
    max[d] = ((middle + half) * run.unit) / run.fine;
  }
  return true;
}

function reachOfForm({ kind, ratio, vertices }, scale) {
  if (kind === "plane") return 0;
  if (kind === "triangles") return Math.max(...vertices.map((vertex) => Math.hypot(...vertex.map((x, d) => x * scale[d]))));
  return kind === "capsule" ? scale[0] * (1 + ratio) : kind === "sphere" ? scale[0] : Math.hypot(...scale);
}

/** How far each object reaches from its place, at most. */
export function reaches(run) {
  const all = new Float32Array(run.states.length);
  for (const [object, form, scale, place = [0, 0, 0]] of run.parts) all[object] = Math.max(all[object], Math.hypot(...place) + reachOfForm(run.forms[form], scale));
  return all;
}

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
