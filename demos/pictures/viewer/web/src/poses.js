// SPDX-License-Identifier: MIT

// What recorders write for coordinates that are not numbers.
export const notANumber = -(2 ** 31);
export const moods = ["fixed", "kinematic", "moving", "sleeping", "soft", "sensor", "character", "gone", "wheel"];
export const fixed = moods.indexOf("fixed");
const gone = moods.indexOf("gone");

// Speeds are taken over this many frames, so that they are finer than places.
const span = 4;

/** Where everything is at one moment, in the units of the world. */
export class Poses {
  constructor(run, frames) {
    this.unit = run.unit / run.fine;
    this.rotationUnit = run.rotationUnit;
    this.count = frames.objects;
    this.places = new Float32Array(3 * (frames.objects + frames.nodes));
    this.rotations = new Float32Array(4 * frames.objects);
    this.visible = new Uint8Array(frames.objects);
  }

  /** Between frame `a` and the one after it, `b`: `t` in [0, 1). Without `b` it is `a`. */
  set(a, b, t) {
    const { places, unit } = this;
    const blend = b && t > 0 ? t : 0;
    for (let i = 0; i < places.length; ++i) {
      const from = a.places[i];
      places[i] = unit * (blend > 0 ? from + (b.places[i] - from) * blend : from);
    }
    for (let i = 0; i < this.count; ++i) {
      const isSomewhere = a.places[3 * i] !== notANumber && a.places[3 * i + 1] !== notANumber && a.places[3 * i + 2] !== notANumber;
      this.visible[i] = isSomewhere && a.moods[i] !== gone ? 1 : 0;
      this.setRotation(i, a.rotations, blend > 0 ? b.rotations : a.rotations, blend);
    }
  }

  setRotation(i, from, to, t) {
    const out = this.rotations;
    let length = 0;
    for (let k = 4 * i; k < 4 * i + 4; ++k) {
      out[k] = from[k] + (to[k] - from[k]) * t;
      length += out[k] * out[k];
    }
    const scale = length > 0 ? 1 / Math.sqrt(length) : 0;
    for (let k = 4 * i; k < 4 * i + 4; ++k) out[k] *= scale;
  }
}

/** The frame some frames before `frame`, and how many they are; 0 in the first frame of a block. */
function formerOf(frame) {
  let former = frame;
  let count = 0;
  for (; count < span && former.former; ++count) former = former.former;
  return { former, count };
}

/** Velocity of an object in m/s, in the units of `poses`; `seconds` from frame to frame. */
export function velocityOf(frame, object, unit, seconds) {
  const { former, count } = formerOf(frame);
  if (count === 0) return [0, 0, 0];
  return [0, 1, 2].map((d) => ((frame.places[3 * object + d] - former.places[3 * object + d]) * unit) / (count * seconds));
}
