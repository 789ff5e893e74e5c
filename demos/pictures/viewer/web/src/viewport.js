// SPDX-License-Identifier: MIT
import { PCFShadowMap, PerspectiveCamera, Raycaster, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

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

/** Where the corners of `bounds` are from its middle. */
const cornersOf = (half) => Array.from({ length: 8 }, (_, i) => new Vector3(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z));

/** Renderer and camera: one view of each scene, side by side, or one above the other where there is more height. Draws only when something has changed. */
export class Viewport {
  /** `plain`: without shadows and smooth edges, for machines that draw slowly. */
  constructor(canvas, plain) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: !plain });
    this.renderer.setPixelRatio(plain ? 1 : Math.min(window.devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = !plain;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.camera = new PerspectiveCamera(40, 1, 0.1, 1000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener("change", () => this.changed());
    this.stages = [];
    this.rectangles = [];
    this.dirty = true;
    this.drawn = 0;
    this.shown = null;
  }

  add(stage) {
    this.stages.push(stage);
  }
  changed() {
    this.dirty = true;
  }
  moved() {
    this.dirty = this.renderer.shadowMap.needsUpdate = true;
  }

  /** `size`: of what there is to see. */
  reach(size) {
    this.camera.near = size / 1000;
    this.camera.far = size * 14;
    this.controls.maxDistance = size * 6;
    this.camera.updateProjectionMatrix();
  }

  /** How far from the middle of `bounds` the camera must be to have it all in the view, looking from `direction`. */
  distanceTo(bounds, direction) {
    const half = bounds.getSize(new Vector3()).multiplyScalar(0.5);
    const forward = direction.clone().negate();
    const right = new Vector3().crossVectors(forward, new Vector3(0, 1, 0)).normalize();
    const up = new Vector3().crossVectors(right, forward);
    const tanY = Math.tan((this.camera.fov * Math.PI) / 360) * 0.92;
    const tanX = tanY * this.camera.aspect;
    // Every corner must be within both pairs of sides of the view.
    const needed = (corner) => Math.max(Math.abs(corner.dot(right)) / tanX, Math.abs(corner.dot(up)) / tanY) - corner.dot(forward);
    return Math.max(...cornersOf(half).map(needed), this.camera.near * 4);
  }

  get direction() {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** Looks at `bounds` from where it stands, or from `direction`. */
  frame(bounds, direction = this.direction) {
    bounds.getCenter(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, this.distanceTo(bounds, direction));
    this.controls.update();
    this.shown = bounds.clone();
    this.changed();
  }

  /** What was in `shown` has come to be in `bounds`: the camera goes with it, and keeps the angle and the nearness that its user chose. */
  follow(bounds) {
    if (!this.shown || this.shown.equals(bounds)) return;
    const { direction } = this;
    const scale = this.distanceTo(bounds, direction) / this.distanceTo(this.shown, direction);
    const [from, to] = [this.shown, bounds].map((box) => box.getCenter(new Vector3()));
    const target = this.controls.target.clone().sub(from).multiplyScalar(scale).add(to);
    this.camera.position.sub(this.controls.target).multiplyScalar(scale).add(target);
    this.controls.target.copy(target);
    this.controls.update();
    this.shown.copy(bounds);
    this.changed();
  }

  /** Observers of the size report it when they begin, too: one more picture would be drawn for nothing. */
  resize(width, height) {
    if (width === this.width && height === this.height) return;
    Object.assign(this, { width, height });
    this.renderer.setSize(width, height, false);
    const [across, down] = this.stages.length < 2 ? [1, 1] : width > height ? [2, 1] : [1, 2];
    this.rectangles = this.stages.map((_, i) => ({ x: across > 1 ? (i * width) / 2 : 0, y: down > 1 ? (i * height) / 2 : 0, width: width / across, height: height / down }));
    this.camera.aspect = width / across / Math.max(height / down, 1);
    this.camera.updateProjectionMatrix();
    this.changed();
  }

  draw() {
    this.controls.update();
    if (!this.dirty) return;
    this.dirty = false;
    const height = this.canvas.clientHeight;
    const shadows = this.renderer.shadowMap.needsUpdate;
    this.renderer.setScissorTest(true);
    this.rectangles.forEach((place, i) => {
      // The renderer counts from below.
      const rectangle = [place.x, height - place.y - place.height, place.width, place.height];
      this.renderer.setViewport(...rectangle);
      this.renderer.setScissor(...rectangle);
      this.renderer.shadowMap.needsUpdate = shadows;
      this.renderer.render(this.stages[i].scene, this.camera);
    });
    ++this.drawn;
  }
}
