// SPDX-License-Identifier: MIT

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
