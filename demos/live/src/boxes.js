// SPDX-License-Identifier: MIT
import { Color, DoubleSide, DynamicDrawUsage, Float32BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh, ShaderMaterial } from "three";

// The three sides of a box that face the camera are all that can be seen of it. `position` is a corner of a side, and
// `normal` its axis: there a corner is at the end that is nearer to the camera.
const vertexShader = `
attribute vec3 low, high;
attribute vec4 mark;
uniform vec3 touching[3], idle, fog, chosen;
uniform float reach, glowing, dimmed, shared;
varying vec3 colour;
varying vec2 place;
varying float ghost;

vec3 paint() {
  if (shared > 0.5) return touching[1];
  float many = clamp(log2(max(mark.x, 1.0)) / 3.0, 0.0, 1.0);
  vec3 crowded = many < 0.5 ? mix(touching[0], touching[1], 2.0 * many) : mix(touching[1], touching[2], 2.0 * many - 1.0);
  vec3 plain = mark.x < 0.5 ? idle : crowded;
  if (glowing > 0.5) plain = mix(mix(idle, plain, 0.25), touching[2], mark.y / 255.0);
  if (mark.z > 1.5) return chosen;
  return dimmed > 0.5 ? (mark.z > 0.5 ? touching[1] : mix(plain, fog, 0.8)) : plain;
}

void main() {
  vec3 nearer = step(0.5 * (low + high), cameraPosition);
  vec3 corner = mix(position, nearer, normal);
  vec4 seen = viewMatrix * vec4(mix(low, high, corner), 1.0);
  float light = dot(normal, mix(vec3(0.62, 0.5, 0.74), vec3(0.8, 1.0, 0.68), nearer));
  float far = clamp(0.6 * (-seen.z / reach - 0.75), 0.0, 0.65);
  colour = mix(paint() * light, fog, far);
  place = normal.x > 0.5 ? position.yz : normal.y > 0.5 ? position.xz : position.xy;
  ghost = dimmed * step(mark.z, 0.5);
  gl_Position = projectionMatrix * seen;
  if (ghost > 0.5) gl_Position.z = 0.99999 * gl_Position.w;
}`;

// Thin dark edges, where a side is large enough to have some. Of ghosts, boxes that are not the matter, a dot here and
// there is left, behind all others.
const fragmentShader = `
uniform float edges;
varying vec3 colour;
varying vec2 place;
varying float ghost;

void main() {
  if (ghost > 0.5 && mod(floor(gl_FragCoord.x), 4.0) + mod(floor(gl_FragCoord.y), 4.0) > 0.5) discard;
  vec2 width = fwidth(place);
  vec2 inside = min(place, 1.0 - place) / width;
  float edge = clamp(min(inside.x, inside.y), 0.0, 1.0);
  float size = clamp(0.12 / max(max(width.x, width.y), 1e-6) - 0.5, 0.0, 1.0);
  gl_FragColor = vec4(colour * mix(1.0, mix(0.62, 1.0, edge), edges * size), 1.0);
  #include <colorspace_fragment>
}`;

/** Sides as position and normal, and their triangles. */
function sides() {
  const position = [];
  const normal = [];
  const index = [];
  for (let axis = 0; axis < 3; ++axis) {
    const first = position.length / 3;
    for (const [u, v] of [[0, 0], [1, 0], [0, 1], [1, 1]]) {
      position.push(...[0, 1, 2].map((d) => (d === axis ? 0 : d === (axis === 0 ? 1 : 0) ? u : v)));
      normal.push(...[0, 1, 2].map((d) => (d === axis ? 1 : 0)));
    }
    index.push(first, first + 1, first + 2, first + 2, first + 1, first + 3);
  }
  return { position, normal, index };
}

/** Any number of boxes, drawn at once. */
export class Boxes {
  constructor(scene) {
    const plain = () => ({ value: 0 });
    this.uniforms = { touching: { value: [new Color(), new Color(), new Color()] }, idle: { value: new Color() }, fog: { value: new Color() }, chosen: { value: new Color() }, reach: { value: 1 }, glowing: plain(), dimmed: plain(), shared: plain(), edges: { value: 1 } };
    this.mesh = new Mesh(new InstancedBufferGeometry(), new ShaderMaterial({ vertexShader, fragmentShader, uniforms: this.uniforms, side: DoubleSide }));
    this.mesh.frustumCulled = false;
    this.capacity = -1;
    scene.add(this.mesh);
  }

  /** `boxes`: six numbers each; `marks`: four bytes each, or nothing. */
  set(boxes, marks) {
    const n = boxes.length / 6;
    if (n > this.capacity || n < this.capacity / 4) this.reserve(n);
    this.fill(this.ends, boxes);
    if (marks) this.fill(this.marks, marks);
    this.mesh.geometry.instanceCount = n;
  }

  fill(buffer, values) {
    buffer.array.set(values);
    buffer.clearUpdateRanges();
    buffer.addUpdateRange(0, values.length);
    buffer.needsUpdate = true;
  }

  reserve(n) {
    this.mesh.geometry.dispose();
    const { position, normal, index } = sides();
    const geometry = (this.mesh.geometry = new InstancedBufferGeometry());
    geometry.setIndex(index);
    geometry.setAttribute("position", new Float32BufferAttribute(position, 3));
    geometry.setAttribute("normal", new Float32BufferAttribute(normal, 3));
    this.ends = new InstancedInterleavedBuffer(new Float32Array(6 * n), 6).setUsage(DynamicDrawUsage);
    this.marks = new InstancedBufferAttribute(new Uint8Array(4 * n), 4).setUsage(DynamicDrawUsage);
    geometry.setAttribute("low", new InterleavedBufferAttribute(this.ends, 3, 0));
    geometry.setAttribute("high", new InterleavedBufferAttribute(this.ends, 3, 3));
    geometry.setAttribute("mark", this.marks);
    this.capacity = n;
  }

  /** `colours`: of CSS. */
  paint({ touching, idle, fog, chosen }) {
    touching.forEach((colour, i) => this.uniforms.touching.value[i].set(colour));
    this.uniforms.idle.value.set(idle);
    this.uniforms.fog.value.set(fog);
    this.uniforms.chosen.value.set(chosen);
  }
}
