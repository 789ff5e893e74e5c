// SPDX-License-Identifier: MIT
import { Vector3 } from "three";

// A wall that covers less than this share of what there is to see is part of the view.
const tolerated = 0.04;
const mostSights = 150;

/** Large boxes that never move can stand between the viewer and everything. Those are hidden. */
export class Walls {
  constructor(bodies, poses) {
    this.walls = bodies.walls;
    this.poses = poses;
    this.hidden = "";
  }

  /** `sights`: objects to be seen. Returns true if something came or went. */
  cutAway(eye, objects) {
    if (this.walls.length === 0) return false;
    const stride = Math.ceil(objects.length / mostSights) || 1;
    const sights = objects.filter((_, i) => i % stride === 0).map((object) => new Vector3().fromArray(this.poses.places, 3 * object));
    for (const group of this.walls) {
      const inverse = group.mesh.instanceMatrix.array;
      const covered = sights.filter((sight) => covers(inverse, eye, sight)).length;
      group.mesh.visible = covered <= tolerated * sights.length;
    }
    const hidden = this.walls.map((group) => (group.mesh.visible ? "." : "x")).join("");
    if (hidden === this.hidden) return false;
    this.hidden = hidden;
    return true;
  }
}

/** Does the line of sight enter the box before its end, and end outside of it? `m`: of the cube from -1 to 1 to the box. */
function covers(m, eye, sight) {
  let enter = 0;
  let leave = 1;
  for (let column = 0; column < 3; ++column) {
    const axis = new Vector3(m[4 * column], m[4 * column + 1], m[4 * column + 2]);
    const half = axis.lengthSq();
    const from = (eye.x - m[12]) * axis.x + (eye.y - m[13]) * axis.y + (eye.z - m[14]) * axis.z;
    const step = axis.dot(sight) - axis.dot(eye);
    if (Math.abs(step) < 1e-12) {
      if (Math.abs(from) > half) return false;
      continue;
    }
    const a = (-half - from) / step;
    const b = (half - from) / step;
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return enter < leave && leave < 1;
}
