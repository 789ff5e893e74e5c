// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, Mesh, MeshStandardMaterial } from "three";

/** Soft bodies: surfaces whose vertices come with each frame. */
export class SoftBodies {
  constructor(run, scene) {
    this.parts = run.softParts.map((part) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * part.count), 3).setUsage(DynamicDrawUsage));
      geometry.setIndex(part.triangles.flat());
      const mesh = new Mesh(geometry, new MeshStandardMaterial({ roughness: 0.8, side: DoubleSide }));
      mesh.frustumCulled = false;
      mesh.castShadow = mesh.receiveShadow = true;
      mesh.userData.objects = [part.object];
      scene.add(mesh);
      return { mesh, first: 3 * (run.states.length + part.first), object: part.object };
    });
  }

  place(poses) {
    for (const { mesh, first, object } of this.parts) {
      const position = mesh.geometry.getAttribute("position");
      position.array.set(poses.places.subarray(first, first + position.array.length));
      position.needsUpdate = true;
      mesh.geometry.computeVertexNormals();
      mesh.geometry.boundingSphere = null;
      mesh.visible = poses.visible[object] === 1;
    }
  }

  paint(colours) {
    for (const { mesh, object } of this.parts) mesh.material.color = new Color().fromArray(colours, 3 * object);
  }

  meshes() {
    return this.parts.map(({ mesh }) => mesh);
  }
}
