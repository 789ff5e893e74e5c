// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, CanvasTexture, DynamicDrawUsage, Points, PointsMaterial } from "three";
import { Lines } from "./lines.js";

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
