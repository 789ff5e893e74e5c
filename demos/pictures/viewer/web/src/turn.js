// SPDX-License-Identifier: MIT

/** The vector (x, y, z) turned by quaternion number `i` of `q`. */
export function turned(q, i, x, y, z) {
  const [a, b, c, w] = [q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]];
  const cx = 2 * (b * z - c * y);
  const cy = 2 * (c * x - a * z);
  const cz = 2 * (a * y - b * x);
  return [x + w * cx + b * cz - c * cy, y + w * cy + c * cx - a * cz, z + w * cz + a * cy - b * cx];
}
