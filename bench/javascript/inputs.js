// SPDX-License-Identifier: MIT

/** Numbers in [0, 1) that a seed decides. */
function randomOf(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let bits = Math.imul(state ^ (state >>> 15), state | 1);
    bits ^= bits + Math.imul(bits ^ (bits >>> 7), bits | 61);
    return ((bits ^ (bits >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Boxes in the unit cube, each side uniform up to a bound at which about one pair comes on two boxes. */
export function uniformBoxes(n, seed = 1) {
  const random = randomOf(seed);
  const boxes = new Float32Array(6 * n);
  for (let i = 0; i < 6 * n; i += 6) {
    for (let d = 0; d < 3; ++d) {
      boxes[i + d] = random();
      boxes[i + 3 + d] = boxes[i + d] + random() / Math.cbrt(n);
    }
  }
  return boxes;
}
