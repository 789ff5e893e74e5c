// SPDX-License-Identifier: MIT
import {
  Box3, CanvasTexture, CircleGeometry, Color, DirectionalLight, Fog, Group, HemisphereLight, Mesh, MeshBasicMaterial, MeshStandardMaterial,
  PCFShadowMap, PerspectiveCamera, RepeatWrapping, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const sky = 0xe9edf2;

/** Renderer, camera and light. Draws only when something has changed. */
export class Viewport {
  /** `plain`: without shadows and smooth edges, for machines that draw slowly. */
  constructor(canvas, plain) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !plain });
    this.renderer.setPixelRatio(plain ? 1 : Math.min(window.devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = !plain;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.scene = new Scene();
    this.scene.background = new Color(sky);
    this.camera = new PerspectiveCamera(40, 1, 0.1, 1000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener("change", () => this.changed());
    this.sun = new DirectionalLight(0xfff4e5, 2.4);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0006;
    this.scene.add(new HemisphereLight(0xf4f8ff, 0xa39c90, 1.7), this.sun, this.sun.target);
    this.dirty = true;
    this.drawn = 0;
  }

  changed() {
    this.dirty = true;
  }
  moved() {
    this.dirty = this.renderer.shadowMap.needsUpdate = true;
  }

  /** `bounds`: of what there is to see; `floor`: the height to stand on; `isDrawn`: something in the scene is that floor. */
  dress(bounds, floor, isDrawn) {
    const size = bounds.getSize(new Vector3()).length();
    const middle = bounds.getCenter(new Vector3());
    this.size = size;
    this.camera.near = size / 400;
    this.camera.far = size * 12;
    this.controls.maxDistance = size * 5;
    this.scene.fog = new Fog(sky, size * 2.2, size * 6);
    this.sun.position.copy(middle).addScaledVector(new Vector3(0.45, 1, 0.3).normalize(), size);
    this.sun.target.position.copy(middle);
    const shadow = this.sun.shadow.camera;
    shadow.left = shadow.bottom = -size * 0.6;
    shadow.right = shadow.top = size * 0.6;
    shadow.near = size * 0.1;
    shadow.far = size * 2.2;
    shadow.updateProjectionMatrix();
    this.sun.shadow.normalBias = size / 2500;
    this.scene.add(this.ground(size * 6, middle, floor, isDrawn));
  }

  ground(radius, middle, height, isDrawn) {
    const group = new Group();
    const disc = new Mesh(new CircleGeometry(radius, 64).rotateX(-Math.PI / 2), new MeshStandardMaterial({ color: 0xe6e9ec, roughness: 1 }));
    disc.receiveShadow = true;
    disc.visible = !isDrawn;
    const cell = 10 ** Math.floor(Math.log10(this.size / 6));
    const lines = new MeshBasicMaterial({ color: 0x9aa3ae, opacity: 0.4, alphaMap: this.grid((2 * radius) / cell), transparent: true, depthWrite: false });
    const grid = new Mesh(disc.geometry, lines);
    grid.position.y = radius / 20000;
    group.add(disc, grid);
    group.position.set(Math.round(middle.x / cell) * cell, height - (isDrawn ? 0 : radius / 20000), Math.round(middle.z / cell) * cell);
    return group;
  }

  /** A number of squares from side to side: a texture, since lines are no wider near than far. */
  grid(cells) {
    const size = 256;
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = size;
    const context = canvas.getContext("2d");
    context.fillRect(0, 0, size, size);
    context.strokeStyle = "#ffffff";
    context.lineWidth = 4;
    context.strokeRect(0, 0, size, size);
    const texture = new CanvasTexture(canvas);
    texture.wrapS = texture.wrapT = RepeatWrapping;
    texture.repeat.set(cells, cells);
    texture.anisotropy = 8;
    return texture;
  }

  /** Looks at `bounds` from the corner where it stands, or from where most pictures are taken. */
  frame(bounds, fromScratch) {
    const middle = bounds.getCenter(new Vector3());
    const half = bounds.getSize(new Vector3()).multiplyScalar(0.5);
    const from = fromScratch ? new Vector3(0.62, 0.5, 0.85) : this.camera.position.clone().sub(this.controls.target);
    from.normalize();
    const forward = from.clone().negate();
    const right = new Vector3().crossVectors(forward, new Vector3(0, 1, 0)).normalize();
    const up = new Vector3().crossVectors(right, forward);
    const tanY = Math.tan((this.camera.fov * Math.PI) / 360) * 0.9;
    const tanX = tanY * this.camera.aspect;
    // Every corner must be within both pairs of sides of the view.
    let distance = 0;
    for (let i = 0; i < 8; ++i) {
      const corner = new Vector3(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
      const across = Math.max(Math.abs(corner.dot(right)) / tanX, Math.abs(corner.dot(up)) / tanY);
      distance = Math.max(distance, across - corner.dot(forward));
    }
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(from, Math.max(distance, this.camera.near * 4));
    this.controls.update();
    this.changed();
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.changed();
  }

  draw() {
    this.controls.update();
    if (!this.dirty) return;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
    ++this.drawn;
  }
}

/** Around the boxes of what moves, but for the few that have gone astray; null if nothing does. */
export function crowd(boxes) {
  if (boxes.length === 0) return null;
  const result = new Box3();
  for (const axis of ["x", "y", "z"]) {
    const low = boxes.map((box) => box.min[axis]).sort((a, b) => a - b);
    const high = boxes.map((box) => box.max[axis]).sort((a, b) => a - b);
    const astray = Math.floor(boxes.length * 0.01);
    result.min[axis] = low[astray];
    result.max[axis] = high[boxes.length - 1 - astray];
  }
  return result;
}
