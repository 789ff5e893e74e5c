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

/** The vector (x, y, z) turned by quaternion number `i` of `q`. */
export function turned(q, i, x, y, z) {
  const [a, b, c, w] = [q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]];
  const cx = 2 * (b * z - c * y);
  const cy = 2 * (c * x - a * z);
  const cz = 2 * (a * y - b * x);
  return [x + w * cx + b * cz - c * cy, y + w * cy + c * cx - a * cz, z + w * cz + a * cy - b * cx];
}

const noRotation = [0, 0, 0, 1];
const sphere = { kind: "sphere" };
const tube = { kind: "tube" };

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

/**
 * What to draw of a run, in groups that share a geometry: {form, items}, each item {object, scale, place, rotation}.
 * Capsules come as a tube and two balls, because no scale makes one capsule of another.
 */
export function groupsOf(run) {
  const groups = new Map();
  const put = (form, item) => {
    if (!groups.has(form)) groups.set(form, []);
    groups.get(form).push(item);
  };
  for (const [object, number, scale, place = [0, 0, 0], rotation = noRotation] of run.parts) {
    const form = run.forms[number];
    if (form.kind === "capsule") {
      const half = form.ratio * scale[0];
      put(tube, { object, scale: [scale[0], half, scale[0]], place, rotation });
      for (const end of [-half, half]) put(sphere, { object, scale, place: add(place, turned(rotation, 0, 0, end, 0)), rotation });
    } else {
      put(form.kind === "sphere" ? sphere : form, { object, scale, place, rotation });
    }
  }
  return [...groups].map(([form, items]) => ({ form, items }));
}
