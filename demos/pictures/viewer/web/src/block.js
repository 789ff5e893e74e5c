// SPDX-License-Identifier: MIT
import { nextPairs, noPairs } from "./pairs.js";
import { fixed } from "./poses.js";
import { Bytes, Series } from "./series.js";

/** Objects whose rotations are kept: all but those that are one ball. */
function turning(run) {
  const turns = new Uint8Array(run.states.length);
  for (const [object, form, , place] of run.parts) if (run.forms[form].kind !== "sphere" || place?.some((x) => x !== 0)) turns[object] = 1;
  return [...turns.keys()].filter((object) => turns[object]);
}

/**
 * Reads the frames of one block, which can only be read in order; frames.hpp of the recorder has their layout. A frame is
 * {former, places, rotations, boxes, islands, moods, pairs, touching, contacts}: places in sixteenths of a unit, boxes in
 * eighths, `former` the frame before in the block.
 */
export class BlockReader {
  constructor(bytes, run, nodes) {
    const objects = run.states.length;
    this.bytes = new Bytes(bytes);
    this.objects = objects;
    this.fine = run.fine;
    this.turning = turning(run);
    const series = (count, goesOn) => new Series(count, run.fine, goesOn);
    this.series = {
      places: series(3 * (objects + nodes), true),
      turns: series(4 * this.turning.length, true),
      boxes: series(6 * objects, true),
      islands: series(objects, false),
      moods: series(objects, false),
    };
    this.former = null;
  }

  next() {
    const { bytes, fine } = this;
    const read = Object.fromEntries(Object.entries(this.series).map(([name, series]) => [name, series.next(bytes)]));
    const frame = {
      former: this.former,
      places: read.places,
      rotations: this.rotations(read.turns),
      boxes: read.boxes,
      islands: read.islands.map((island) => island / fine),
      moods: Uint8Array.from(read.moods, (mood) => mood / fine),
    };
    Object.assign(frame, nextPairs(bytes, this.former ?? noPairs, (object) => frame.moods[object] === fixed));
    this.former = frame;
    return frame;
  }

  /** Of all objects. */
  rotations(turns) {
    const all = new Int32Array(4 * this.objects);
    for (let i = 3; i < all.length; i += 4) all[i] = 1;
    this.turning.forEach((object, i) => {
      for (let k = 0; k < 4; ++k) all[4 * object + k] = turns[4 * i + k];
    });
    return all;
  }
}
