// SPDX-License-Identifier: MIT
// What a box looks like: four bytes each, for the shader.

const decay = 0.9; // of the glow of pairs that began, in a frame

/** Bytes of a box: partners, glow of a pair that began, 1 for partners of the selected box and 2 for itself, nothing. */
export class Marks {
  constructor(n) {
    this.bytes = new Uint8Array(4 * n);
  }

  /** Marks what the pairs tell. Returns the partners of box `selected`. */
  set(pairs, begun, selected) {
    const { bytes } = this;
    for (let i = 0; i < bytes.length; i += 4) {
      bytes[i] = bytes[i + 2] = 0;
      bytes[i + 1] *= decay;
    }
    for (const box of pairs) if (bytes[4 * box] < 255) ++bytes[4 * box];
    for (const box of begun ?? []) bytes[4 * box + 1] = 255;
    return selected < 0 ? [] : this.select(pairs, selected);
  }

  select(pairs, selected) {
    const partners = [];
    for (let k = 0; k < pairs.length; k += 2) {
      if (pairs[k] === selected) partners.push(pairs[k + 1]);
      if (pairs[k + 1] === selected) partners.push(pairs[k]);
    }
    for (const box of partners) this.bytes[4 * box + 2] = 1;
    this.bytes[4 * selected + 2] = 2;
    return partners;
  }
}

/** What the two boxes of each pair share, as boxes. */
export function overlaps(pairs, boxes) {
  const shared = new Float32Array(3 * pairs.length);
  for (let k = 0, out = 0; k < pairs.length; k += 2, out += 6)
    for (let d = 0, a = 6 * pairs[k], b = 6 * pairs[k + 1]; d < 3; ++d) {
      shared[out + d] = Math.max(boxes[a + d], boxes[b + d]);
      shared[out + 3 + d] = Math.min(boxes[a + 3 + d], boxes[b + 3 + d]);
    }
  return shared;
}
