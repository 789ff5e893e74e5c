// SPDX-License-Identifier: MIT
import { Raycaster, Vector2 } from "three";

// A pointer that went further than this, in pixels, has turned the camera; fingers are less exact.
const stillness = { mouse: 4, pen: 6, touch: 12 };

/** Calls `onPick` with the object under a click or a tap, or -1. `meshes()`: those of each view of `viewport`. */
export function watchClicks(viewport, meshes, onPick) {
  const { canvas, camera } = viewport;
  const down = new Map();
  let several = false; // fingers are or were down: that is a pinch
  canvas.addEventListener("pointerdown", (event) => {
    several = down.size > 0;
    down.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener("pointercancel", (event) => down.delete(event.pointerId));
  canvas.addEventListener("pointerup", (event) => {
    const start = down.get(event.pointerId);
    down.delete(event.pointerId);
    if (!start || several || event.button !== 0 || Math.hypot(event.clientX - start[0], event.clientY - start[1]) > (stillness[event.pointerType] ?? 4)) return;
    const { left, top } = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - left, event.clientY - top];
    const view = viewport.rectangles.findIndex((place) => x >= place.x && x < place.x + place.width && y >= place.y && y < place.y + place.height);
    if (view < 0) return;
    const place = viewport.rectangles[view];
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * (x - place.x)) / place.width - 1, 1 - (2 * (y - place.y)) / place.height), camera);
    const [hit] = ray.intersectObjects(meshes()[view], false);
    onPick(hit ? hit.object.userData.objects[hit.instanceId ?? 0] : -1);
  });
}
