// SPDX-License-Identifier: MIT

/** Numbers that look random, the same ones for the same seed: Marsaglia's xorshift of 32 bits. */
export class Random {
  constructor(seed) {
    this.state = Int32Array.of((seed ^ 0x9e3779b9) | 0 || 1);
    for (let i = 0; i < 8; ++i) this.unit();
  }

  /** In [0, 1). */
  unit() {
    let x = this.state[0];
    x ^= x << 13;
    x ^= x >>> 17;
    x ^= x << 5;
    this.state[0] = x;
    return (x >>> 0) / 4294967296;
  }

  /** In [low, high). */
  real(low, high) {
    return low + (high - low) * this.unit();
  }

  /** Among the whole numbers low .. high. */
  integer(low, high) {
    return low + Math.floor(this.unit() * (high - low + 1));
  }

  /** Shuffles the rows of an array, `width` numbers each. */
  shuffle(rows, width = 1) {
    for (let i = rows.length / width; i > 1; --i) {
      const from = width * (i - 1);
      const to = width * this.integer(0, i - 1);
      for (let k = 0; k < width; ++k) {
        const kept = rows[from + k];
        rows[from + k] = rows[to + k];
        rows[to + k] = kept;
      }
    }
  }
}
