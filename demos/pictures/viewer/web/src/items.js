// SPDX-License-Identifier: MIT

const noRotation = [0, 0, 0, 1];
const sphere = { kind: "sphere" };
const tube = { kind: "tube" };

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

/** `v` turned by the quaternion `q`. */
function turned(q, v) {
  const [x, y, z, w] = q;
  const cx = y * v[2] - z * v[1] + w * v[0];
  const cy = z * v[0] - x * v[2] + w * v[1];
  const cz = x * v[1] - y * v[0] + w * v[2];
  return [v[0] + 2 * (y * cz - z * cy), v[1] + 2 * (z * cx - x * cz), v[2] + 2 * (x * cy - y * cx)];
}

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
      for (const end of [-half, half]) put(sphere, { object, scale, place: add(place, turned(rotation, [0, end, 0])), rotation });
    } else {
      put(form.kind === "sphere" ? sphere : form, { object, scale, place, rotation });
    }
  }
  return [...groups].map(([form, items]) => ({ form, items }));
}
