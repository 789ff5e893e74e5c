// SPDX-License-Identifier: MIT
import { Raycaster, Vector2 } from "three";

const furthest = 6; // pixels that a click may move

/** The box that a ray meets first, or -1. */
function firstOn({ origin, direction }, boxes) {
  const from = [origin.x, origin.y, origin.z];
  const step = [1 / direction.x, 1 / direction.y, 1 / direction.z];
  let best = -1;
  let nearest = Infinity;
  for (let i = 0; i < boxes.length; i += 6) {
    let enter = 0;
    let leave = nearest;
    for (let d = 0; d < 3; ++d) {
      const low = (boxes[i + d] - from[d]) * step[d];
      const high = (boxes[i + 3 + d] - from[d]) * step[d];
      enter = Math.max(enter, Math.min(low, high));
      leave = Math.min(leave, Math.max(low, high));
    }
    if (enter < leave) [best, nearest] = [i / 6, enter];
  }
  return best;
}

/** Calls `onPick` with the box that was clicked or tapped, or -1. */
export function watchClicks(canvas, lens, boxes, onPick) {
  let down = null;
  canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
  canvas.addEventListener("pointerup", (event) => {
    if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > furthest) return;
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height), lens);
    onPick(firstOn(caster.ray, boxes()));
  });
}
