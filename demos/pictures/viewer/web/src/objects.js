// SPDX-License-Identifier: MIT
import { moods, velocityOf } from "./poses.js";
import { distance, figure, vector, whole } from "./words.js";

/**
 * Which objects of the world are on the page. All else here calls an object by its place among these; people call it by its
 * number in the world. Wheels follow the objects.
 */
export class Objects {
  constructor({ kept, states }) {
    this.kept = kept;
    this.isAll = !kept.steps;
    const shown = kept.steps?.length ?? kept.inWorld;
    this.count = kept.inWorld + states.length - shown;
    this.numbers = Uint32Array.from(states, (_, place) => kept.inWorld + place - shown);
    let number = 0;
    for (let place = 0; place < shown; ++place) this.numbers[place] = this.isAll ? place : (number += kept.steps[place]);
    this.places = new Map(Array.from(this.numbers, (of, place) => [of, place]));
  }

  numberOf(place) {
    return this.numbers[place];
  }

  /** -1: it is not on the page. */
  placeOf(number) {
    return this.places.get(number) ?? -1;
  }

  /** What is to be added where only objects of the page have been counted. */
  get amongThese() {
    return this.isAll ? "" : " (of those shown)";
  }

  /** Which are shown, for people; nothing where all are. */
  get choice() {
    if (this.isAll) return "";
    const { inWorld, landmarks, nearest, steps } = this.kept;
    const sampled = whole(steps.length - landmarks - nearest);
    const which = `${whole(landmarks)} that are named, fixed or large, the ${whole(nearest)} that are nearest to the camera at first, and a sample of ${sampled} others`;
    return `${whole(steps.length)} of ${whole(inWorld)} objects are shown: ${which}. Curves are of all.`;
  }
}

const degrees = 180 / Math.PI;

/** An axis and an angle, which people can imagine. */
function turnText([x, y, z, w]) {
  const sine = Math.hypot(x, y, z);
  const sign = w < 0 ? -1 : 1;
  if (sine < 1e-3) return "none";
  return `${Math.round(2 * Math.atan2(sine, Math.abs(w)) * degrees)}\u00b0 about ${vector([x, y, z].map((part) => (sign * part) / sine))}`;
}

function sizeText(run, object) {
  const parts = run.parts.filter((part) => part[0] === object);
  if (parts.length !== 1) return parts.length > 1 ? `${parts.length} parts` : "";
  const [, number, scale] = parts[0];
  const { kind, ratio } = run.forms[number];
  if (kind === "sphere") return `radius ${figure(scale[0])} m`;
  if (kind === "capsule") return `radius ${figure(scale[0])} m, ${figure(2 * scale[0] * (1 + ratio))} m long`;
  if (kind === "cylinder" || kind === "cone") return `radius ${figure(scale[0])} m, height ${figure(2 * scale[1])} m`;
  return kind === "box" ? `${scale.map((half) => figure(2 * half)).join(" \u00d7 ")} m` : "";
}

function boxText(world, object) {
  const box = world.boxIn(world.shown.frame, object);
  return box ? `${box[0].map((low, d) => figure(box[1][d] - low)).join(" \u00d7 ")} m` : "";
}

/** Rows of [what, value] about an object of a world, those with a value. */
export function aboutObject(world, object, isCompared) {
  const { colours, objects, poses, run } = world;
  const { frame } = world.shown;
  const island = frame.islands[object];
  const velocity = velocityOf(frame, object, poses.unit, world.frameSeconds);
  const moves = run.states[object] !== 0;
  return [
    ["kind", `${colours.kinds[object]}, ${moods[frame.moods[object]]}`],
    ["place", `${vector([...poses.places.subarray(3 * object, 3 * object + 3)])} m`],
    ["turned", colours.kinds[object] === "sphere" ? "" : turnText(poses.rotations.subarray(4 * object, 4 * object + 4))],
    ["velocity", moves ? `${vector(velocity)} m/s` : ""],
    ["speed", moves ? `${figure(Math.hypot(...velocity))} m/s` : ""],
    ["size", sizeText(run, object)],
    ["box", boxText(world, object)],
    ["pairs", `${whole(colours.pairsOf[object])}, ${whole(colours.touchesOf[object])} of them touch${objects.amongThese}`],
    ["island", island < 0 ? "" : `${whole(colours.islandSize[island])} objects${objects.amongThese}`],
    ["apart", isCompared ? `${distance(world.apart[object])} from itself in the other run` : ""],
  ].filter(([, value]) => value);
}
