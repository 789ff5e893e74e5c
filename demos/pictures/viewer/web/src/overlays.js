// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, LineBasicMaterial, LineSegments, ShaderMaterial } from "three";

// Boxes that reach this far, in units, have no end there.
const endless = 2 ** 29;

/** Box of an object in a frame, in the units of the world; false if there is none, or no end to it. */
export function boxOf(frame, object, unit, min, max) {
  for (let d = 0; d < 3; ++d) {
    const place = frame.places[3 * object + d];
    const low = place + frame.corners[6 * object + d];
    const high = place + frame.corners[6 * object + 3 + d];
    if (low > high || Math.abs(low) >= endless || Math.abs(high) >= endless) return false;
    min[d] = unit * low;
    max[d] = unit * high;
  }
  return true;
}

const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, (i >> 1) & 1, i >> 2]);
const edges = [];
for (let a = 0; a < 8; ++a) for (const bit of [1, 2, 4]) if (!(a & bit)) edges.push(...corners[a], ...corners[a | bit]);

/** The boxes that the broad-phase was given. */
export class BoxOverlay {
  constructor(count, scene, hex, opacity) {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(edges), 3));
    this.min = new InstancedBufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    this.max = new InstancedBufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute("boxMin", this.min);
    geometry.setAttribute("boxMax", this.max);
    geometry.instanceCount = count;
    const material = new ShaderMaterial({
      transparent: true,
      depthWrite: false,
      uniforms: { colour: { value: new Color(hex) }, opacity: { value: opacity } },
      vertexShader: `attribute vec3 boxMin; attribute vec3 boxMax;
        void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(mix(boxMin, boxMax, position), 1.0); }`,
      fragmentShader: `uniform vec3 colour; uniform float opacity;
        void main() {
          gl_FragColor = vec4(colour, opacity);
          #include <colorspace_fragment>
        }`,
    });
    this.lines = new LineSegments(geometry, material);
    this.lines.frustumCulled = false;
    this.lines.visible = false;
    scene.add(this.lines);
  }

  /** Box `i` shows what `objects(i)` has. */
  set(frame, unit, objects = (i) => i) {
    const min = [0, 0, 0];
    const max = [0, 0, 0];
    const count = this.min.count;
    for (let i = 0; i < count; ++i) {
      const there = boxOf(frame, objects(i), unit, min, max);
      this.min.array.set(there ? min : [0, 0, 0], 3 * i);
      this.max.array.set(there ? max : [0, 0, 0], 3 * i);
    }
    this.min.needsUpdate = this.max.needsUpdate = true;
  }
}

// Lines are as clear as they can be up to this many numbers.
const faint = 25000;

/** Lines between the bodies of candidate pairs; to scenery, which is large, the shortest one to its box. */
export class PairOverlay {
  constructor(scene, hex) {
    const material = new LineBasicMaterial({ color: hex, transparent: true, depthTest: false, depthWrite: false });
    this.lines = new LineSegments(new BufferGeometry(), material);
    this.lines.frustumCulled = false;
    this.lines.visible = false;
    this.lines.renderOrder = 1;
    scene.add(this.lines);
  }

  /** Pairs of `only`, or all of them if it is negative. */
  set(frame, poses, unit, only = -1) {
    const { pairs } = frame;
    let position = this.lines.geometry.getAttribute("position");
    if (!position || position.count < pairs.length) {
      this.lines.geometry.dispose();
      position = new BufferAttribute(new Float32Array(3 * Math.ceil(1.3 * pairs.length) + 6), 3).setUsage(DynamicDrawUsage);
      this.lines.geometry = new BufferGeometry().setAttribute("position", position);
    }
    let to = 0;
    for (let i = 0; i < pairs.length; i += 2) {
      const a = pairs[i];
      const b = pairs[i + 1];
      if (only >= 0 && a !== only && b !== only) continue;
      const ends = [this.end(frame, poses, unit, a, b), this.end(frame, poses, unit, b, a)];
      if (!ends[0] || !ends[1]) continue;
      position.array.set(ends[0], to);
      position.array.set(ends[1], to + 3);
      to += 6;
    }
    this.lines.geometry.setDrawRange(0, to / 3);
    // Each line is one of many, or many would be a blot.
    this.lines.material.opacity = Math.min(Math.max(faint / to, 0.05), 0.8);
    position.needsUpdate = true;
  }

  /** Where a line ends at `object`, coming from `other`. */
  end(frame, poses, unit, object, other) {
    const soft = frame.moods[object] === 4;
    if (frame.moods[object] !== 0 && !soft) return poses.places.subarray(3 * object, 3 * object + 3);
    const min = [0, 0, 0];
    const max = [0, 0, 0];
    if (!boxOf(frame, object, unit, min, max)) return null;
    if (soft) return min.map((low, d) => (low + max[d]) / 2);
    return min.map((low, d) => Math.min(Math.max(poses.places[3 * other + d], low), max[d]));
  }
}
