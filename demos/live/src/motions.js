// SPDX-License-Identifier: MIT
// Boxes in motion, as bench/inputs/motion.hpp has it. Here teleport takes sizes along: a heap into which large strays jump
// has more pairs than memory holds.
import { Random } from "./random.js";

export const motions = {
  brown: { title: "brown", about: "every box moves up to 10 % of its side on each axis" },
  fall: { title: "fall", about: "all fall, each with a start speed of its own, and begin anew after 20 seconds" },
  static5: { title: "static5", about: "the same 5 % of the boxes move like that, the others rest" },
  teleport: { title: "teleport", about: "every box takes the place and size of another one" },
};

const step = 0.1; // of the own side
const fastestStart = 0.05; // typical sides a frame
const acceleration = 0.003; // typical sides a frame, in each frame
const fallFrames = 1200;

/** What falls is measured by: the median, where the bench has the mean, which few large boxes would decide. */
function typicalSide(boxes) {
  const sides = Float64Array.from({ length: boxes.length / 2 }, (_, k) => boxes[6 * Math.floor(k / 3) + 3 + (k % 3)] - boxes[6 * Math.floor(k / 3) + (k % 3)]);
  return sides.sort()[sides.length >> 1];
}

export class MovingBoxes {
  /** `made`: as inputs make them; `size`: a factor to their sides. */
  constructor(made, motion, size, seed) {
    const n = made.length / 6;
    this.made = made;
    this.motion = motion;
    this.random = new Random(seed + 1);
    this.side = typicalSide(made);
    this.offsets = new Float64Array(3 * n);
    this.start = new Float32Array(6 * n);
    this.boxes = new Float32Array(6 * n);
    this.movers = Uint32Array.from({ length: n }, (_, i) => i);
    if (motion === "static5") this.movers = this.movers.filter(() => this.random.unit() < 0.05);
    if (motion === "fall") this.startFall();
    this.resize(size);
  }

  /** How far all have come down together. */
  get drift() {
    return this.motion === "fall" ? -this.fallen : 0;
  }

  resize(size) {
    const { made, start } = this;
    for (let i = 0; i < made.length; i += 6)
      for (let d = 0; d < 3; ++d) {
        const middle = (made[i + d] + made[i + 3 + d]) / 2;
        const half = ((made[i + 3 + d] - made[i + d]) / 2) * size;
        start[i + d] = middle - half;
        start[i + 3 + d] = middle + half;
      }
    for (let box = 0; box < made.length / 6; ++box) this.place(box);
  }

  next() {
    if (this.motion === "fall") this.fall();
    else if (this.motion === "teleport") this.teleport();
    else this.wander();
  }

  // Always from where the box started, so that its size does not change by rounding again and again.
  place(box) {
    const { start, boxes, offsets } = this;
    for (let d = 0, i = 6 * box, k = 3 * box; d < 3; ++d, ++i, ++k) {
      boxes[i] = start[i] + offsets[k];
      boxes[i + 3] = start[i + 3] + offsets[k];
    }
  }

  wander() {
    for (let m = 0; m < this.movers.length; ++m) {
      this.push(this.movers[m]);
      this.place(this.movers[m]);
    }
  }

  push(box) {
    const { start, offsets, random } = this;
    for (let d = 0, i = 6 * box, k = 3 * box; d < 3; ++d, ++i, ++k) offsets[k] += random.real(-step, step) * (start[i + 3] - start[i]);
  }

  startFall() {
    this.frames = 0;
    this.fallen = 0;
    this.speeds = Float64Array.from({ length: this.movers.length }, () => this.random.real(0, fastestStart) * this.side);
    this.offsets.fill(0);
  }

  fall() {
    if (this.frames++ === fallFrames) this.startFall();
    this.fallen += (fastestStart / 2 + acceleration * this.frames) * this.side;
    for (let box = 0; box < this.speeds.length; ++box) {
      this.speeds[box] += acceleration * this.side;
      this.offsets[3 * box + 1] -= this.speeds[box];
      this.place(box);
    }
  }

  // The boxes are in random order, so to go on by a random number is to go anywhere.
  teleport() {
    const { start, boxes, random } = this;
    const shift = 6 * random.integer(1, start.length / 6 - 1);
    boxes.set(start.subarray(shift));
    boxes.set(start.subarray(0, shift), start.length - shift);
  }
}
