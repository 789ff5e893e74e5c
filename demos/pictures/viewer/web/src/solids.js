// SPDX-License-Identifier: MIT
import { BoxGeometry, BufferGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, IcosahedronGeometry, PlaneGeometry, SphereGeometry } from "three";

/** A ball, as round as the number of balls allows. */
function ball(count) {
  if (count <= 3000) return new SphereGeometry(1, 28, 18);
  return new IcosahedronGeometry(1, count <= 10000 ? 3 : 1);
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
  const around = count <= 3000 ? 28 : 12;
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
