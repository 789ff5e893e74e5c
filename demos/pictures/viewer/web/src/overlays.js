// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, CanvasTexture, DynamicDrawUsage, LineBasicMaterial, LineSegments, Points, PointsMaterial } from "three";
import { boxOf } from "./boxes.js";
import { fixed, moods } from "./poses.js";

/** Lines whose number changes: `begin`, `add` each, `end`. */
export class Lines {
  constructor(scene, { colour, opacity = 1, depthTest = true, order = 1 }) {
    const material = new LineBasicMaterial({ color: colour, transparent: true, opacity, depthTest, depthWrite: false });
    this.mesh = new LineSegments(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = order;
    this.room(64);
    scene.add(this.mesh);
  }

  room(lines) {
    const former = this.position?.array;
    this.mesh.geometry.dispose();
    this.position = new BufferAttribute(new Float32Array(6 * lines), 3).setUsage(DynamicDrawUsage);
    if (former) this.position.array.set(former);
    this.mesh.geometry = new BufferGeometry().setAttribute("position", this.position);
  }

  begin() {
    this.count = 0;
  }
  add(from, to) {
    if (6 * this.count === this.position.array.length) this.room(2 * this.count);
    this.position.array.set(from, 6 * this.count);
    this.position.array.set(to, 6 * this.count + 3);
    ++this.count;
  }
  end() {
    this.mesh.geometry.setDrawRange(0, 2 * this.count);
    this.position.needsUpdate = true;
    this.mesh.visible = this.count > 0;
  }
  hide() {
    this.mesh.visible = false;
  }
}

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

function disc() {
  const canvas = Object.assign(document.createElement("canvas"), { width: 32, height: 32 });
  const context = canvas.getContext("2d");
  context.fillStyle = "#ffffff";
  context.arc(16, 16, 14, 0, 2 * Math.PI);
  context.fill();
  return new CanvasTexture(canvas);
}

/** Contact points, and their normals out of the body with the greater number. They go with their bodies. */
export class ContactOverlay {
  constructor(run, scene, reaches) {
    this.quantum = run.contactQuantum * run.unit;
    this.reaches = reaches;
    this.normals = new Lines(scene, { colour: 0xd9480f, opacity: 0.9, depthTest: false, order: 2 });
    const material = new PointsMaterial({ color: 0xffa94d, size: 5 * Math.min(devicePixelRatio, 2), map: disc(), sizeAttenuation: false, depthTest: false, transparent: true });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.renderOrder = 3;
    this.points.visible = false;
    scene.add(this.points);
  }

  /** Of touching pairs for which `isWanted(a, b)`. */
  set(frame, poses, isWanted) {
    const { contacts } = frame;
    const touching = new Set();
    frame.touching.forEach((touches, i) => touches && touching.add(frame.pairs[2 * i] * 2 ** 26 + frame.pairs[2 * i + 1]));
    const places = [];
    this.normals.begin();
    for (let i = 0; i < contacts.anchors.length; ++i) {
      const [a, b] = [contacts.objects[2 * i], contacts.objects[2 * i + 1]];
      if (!isWanted(a, b) || !touching.has(a * 2 ** 26 + b)) continue;
      const anchor = contacts.anchors[i];
      const length = 0.5 * this.reaches[anchor];
      const place = [0, 1, 2].map((d) => poses.places[3 * anchor + d] + this.quantum * contacts.offsets[3 * i + d]);
      this.normals.add(place, place.map((x, d) => x + length * contacts.normals[3 * i + d]));
      places.push(...place);
    }
    this.normals.end();
    this.points.geometry.dispose();
    this.points.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(places), 3).setUsage(DynamicDrawUsage));
    this.points.visible = places.length > 0;
  }

  hide() {
    this.normals.hide();
    this.points.visible = false;
  }
}
