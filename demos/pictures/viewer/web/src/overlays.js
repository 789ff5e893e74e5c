// SPDX-License-Identifier: MIT
import { boxOf } from "./boxes.js";
import { Lines } from "./lines.js";
import { fixed, moods } from "./poses.js";

const soft = moods.indexOf("soft");
const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, (i >> 1) & 1, i >> 2]);
const edges = corners.flatMap((corner, a) => [1, 2, 4].filter((bit) => !(a & bit)).map((bit) => [corner, corners[a | bit]]));

/** Boxes that the broad-phase was given. */
export class BoxOverlay {
  constructor(run, scene, look) {
    this.run = run;
    this.lines = new Lines(scene, look);
  }

  /** Those of `objects`. */
  set(frame, objects) {
    const min = [0, 0, 0];
    const max = [0, 0, 0];
    this.lines.begin();
    for (const object of objects) {
      if (!boxOf(frame, object, this.run, min, max)) continue;
      const at = (corner) => corner.map((side, d) => (side ? max[d] : min[d]));
      for (const [from, to] of edges) this.lines.add(at(from), at(to));
    }
    this.lines.end();
  }
}

/** Where a line of a pair ends at `object`, coming from `other`: at its place, of scenery, which is large, at the nearest point of its box. */
function pairEnd(frame, poses, run, object, other) {
  const mood = frame.moods[object];
  if (mood !== fixed && mood !== soft) return poses.places.subarray(3 * object, 3 * object + 3);
  const min = [0, 0, 0];
  const max = [0, 0, 0];
  if (!boxOf(frame, object, run, min, max)) return null;
  if (mood === soft) return min.map((low, d) => (low + max[d]) / 2);
  return min.map((low, d) => Math.min(Math.max(poses.places[3 * other + d], low), max[d]));
}

/** Lines between the bodies of candidate pairs: of those that touch, of those that do not, and of those that the other world lacks. */
export class PairOverlay {
  constructor(run, scene) {
    this.run = run;
    this.kinds = [0xd6336c, 0xf2a33a, 0x8f3fe0].map((colour) => new Lines(scene, { colour, opacity: 0.85, depthTest: false }));
  }

  /** Pairs for which `isWanted(a, b)`; `isShared(a, b)`: the other world has it too. */
  set(frame, poses, isWanted, isShared) {
    const { pairs, touching } = frame;
    this.kinds.forEach((lines) => lines.begin());
    for (let i = 0; i < pairs.length; i += 2) {
      const [a, b] = [pairs[i], pairs[i + 1]];
      if (!isWanted(a, b)) continue;
      const [from, to] = [pairEnd(frame, poses, this.run, a, b), pairEnd(frame, poses, this.run, b, a)];
      if (from && to) this.kinds[!isShared(a, b) ? 2 : touching[i / 2] ? 0 : 1].add(from, to);
    }
    this.kinds.forEach((lines) => lines.end());
  }

  hide() {
    this.kinds.forEach((lines) => lines.hide());
  }
}

/** Joints: from body to pivot to body. A gap at the pivot is the joint's error. */
export class JointOverlay {
  constructor(run, scene) {
    this.joints = run.joints;
    this.lines = new Lines(scene, { colour: 0x12b886, depthTest: false });
  }

  set(poses, isWanted, turned) {
    const { places, rotations, visible } = poses;
    const placeOf = (object) => [...places.subarray(3 * object, 3 * object + 3)];
    const pivotOf = (object, pivot) => turned(rotations, object, ...pivot).map((x, d) => x + places[3 * object + d]);
    this.lines.begin();
    for (const [a, b, inA, inB] of this.joints) {
      if (!visible[a] || (b >= 0 && !visible[b]) || !isWanted(a, b)) continue;
      this.lines.add(placeOf(a), pivotOf(a, inA));
      this.lines.add(pivotOf(a, inA), b < 0 ? inB : pivotOf(b, inB));
      if (b >= 0) this.lines.add(pivotOf(b, inB), placeOf(b));
    }
    this.lines.end();
  }
}
