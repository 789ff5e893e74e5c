// SPDX-License-Identifier: MIT
import { Raycaster, Vector2 } from "three";

// A pointer that went further than this, in pixels, has turned the camera.
const stillness = 4;

/** Calls `onPick` with the object under a click, or -1. */
export function watchClicks(canvas, camera, meshes, onPick) {
  let start = null;
  canvas.addEventListener("pointerdown", (event) => (start = [event.clientX, event.clientY]));
  canvas.addEventListener("pointerup", (event) => {
    if (!start || Math.hypot(event.clientX - start[0], event.clientY - start[1]) > stillness) return;
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const at = new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, camera);
    const [hit] = ray.intersectObjects(meshes(), false);
    onPick(hit ? hit.object.userData.objects[hit.instanceId ?? 0] : -1);
  });
}
