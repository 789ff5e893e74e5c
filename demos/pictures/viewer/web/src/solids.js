// SPDX-License-Identifier: MIT
import { BoxGeometry, BufferGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, IcosahedronGeometry, PlaneGeometry, SphereGeometry } from "three";

// Of more than these, each is some pixels, and without a graphics card triangles are what takes time.
const crowd = 30000;

/** A ball, as round as the number of balls allows. */
function ball(count) {
  if (count <= 3000) return new SphereGeometry(1, 28, 18);
  return count <= crowd ? new IcosahedronGeometry(1, count <= 10000 ? 3 : 1) : new SphereGeometry(1, 6, 4);
}

function triangles(form, smooth) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(form.vertices.flat(), 3));
  geometry.setIndex(form.triangles.flat());
  const shaded = smooth ? geometry : geometry.toNonIndexed();
  shaded.computeVertexNormals();
  return shaded;
}

/** The geometry of a form at unit size. `count`: of how many; `smooth`: for terrain, which stands for something curved. */
export function geometryOf(form, count, smooth) {
  const around = count <= 3000 ? 28 : count <= crowd / 3 ? 12 : 6;
  switch (form.kind) {
    case "box":
      return new BoxGeometry(2, 2, 2);
    case "sphere":
      return ball(count);
    case "cylinder":
      return new CylinderGeometry(1, 1, 2, around);
    case "tube":
      return new CylinderGeometry(1, 1, 2, around, 1, true);
    case "cone":
      return new ConeGeometry(1, 2, around);
    case "plane":
      return new PlaneGeometry(2, 2).rotateX(-Math.PI / 2);
    default:
      return triangles(form, smooth);
  }
}
