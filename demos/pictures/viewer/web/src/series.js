// SPDX-License-Identifier: MIT
import { notANumber } from "./poses.js";

const leapMark = 255;
const noNumber = 2 ** 28;

/** Reads LEB128 numbers and bytes, one after the other. */
export class Bytes {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++];
      value |= (byte & 0x7f) << shift;
      if (byte < 0x80) return value >>> 0;
    }
  }

  signed() {
    const coded = this.number();
    return (coded >>> 1) ^ -(coded & 1);
  }
}

/** Numbers through time; series.hpp of the recorder says how they are coded. */
export class Series {
  constructor(count, fine, goesOn) {
    this.fine = fine;
    this.goesOn = goesOn;
    this.speeds = new Int32Array(count);
    this.former = null;
  }

  next(bytes) {
    const values = new Int32Array(this.speeds.length);
    if (this.former) this.steps(bytes, this.former, values);
    else for (let i = 0; i < values.length; ++i) values[i] = this.leap(bytes, i, notANumber);
    this.former = values;
    return values;
  }

  steps(bytes, former, values) {
    const { speeds, fine, goesOn } = this;
    const start = bytes.at;
    bytes.at += values.length;
    for (let i = 0; i < values.length; ++i) {
      const coded = bytes.bytes[start + i];
      const goes = goesOn && (speeds[i] >= fine || speeds[i] <= -fine);
      if (coded === 0 && !goes) {
        values[i] = former[i];
        speeds[i] = (speeds[i] / 2) | 0;
      } else if (coded === leapMark) {
        values[i] = this.leap(bytes, i, former[i]);
      } else {
        const step = (coded >>> 1) ^ -(coded & 1);
        values[i] = former[i] + (goes ? speeds[i] : 0) + step * fine;
        speeds[i] += (step * fine) / 2;
      }
    }
  }

  leap(bytes, i, former) {
    const coded = bytes.number();
    const value = coded === noNumber ? notANumber : ((coded >>> 1) ^ -(coded & 1)) * this.fine;
    this.speeds[i] = value === notANumber || former === notANumber ? 0 : value - former;
    return value;
  }
}
