// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineBasicMaterial, LineSegments } from "three";

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
