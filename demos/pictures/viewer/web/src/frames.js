// SPDX-License-Identifier: MIT
import { nextPairs, noPairs } from "./pairs.js";
import { fixed } from "./poses.js";
import { Bytes, Series } from "./series.js";

/** The bytes of the element `id`, which the page carries deflated, in base64. */
export async function unpacked(id) {
  const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

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

// Frames that are kept unpacked, at most; blocks used longest ago go first.
const memory = 500e6;

/** The frames of a world, unpacked when they are needed. */
export class Frames {
  /** `number` of the world on the page. */
  constructor(run, number) {
    this.run = run;
    this.number = number;
    this.count = run.frameSteps.length;
    this.objects = run.states.length;
    this.nodes = run.softParts.reduce((sum, part) => sum + part.count, 0);
    this.blocks = new Map(); // in order of last use
    const bytes = 90 * this.objects + 12 * this.nodes + 9 * run.series.pairs.reduce((most, pairs) => Math.max(most, pairs), 0);
    this.mostBlocks = Math.max(3, Math.floor(memory / (bytes * run.framesInBlock)));
    this.onLoad = () => {};
  }

  /** Frame `index` if it is there; if not, null, and it is on its way: `onLoad` will be called. */
  get(index) {
    const number = Math.floor(index / this.run.framesInBlock);
    const block = this.block(number);
    if (!block.reader) return null;
    const place = index - number * this.run.framesInBlock;
    while (block.frames.length <= place) block.frames.push(block.reader.next());
    return block.frames[place];
  }

  /** Frame `index`, however long it takes. */
  async load(index) {
    await this.block(Math.floor(index / this.run.framesInBlock)).ready;
    return this.get(index);
  }

  /** Has the block after that of `index` unpacked. */
  foresee(index) {
    const next = Math.floor(index / this.run.framesInBlock) + 1;
    if (next < this.run.blocks) this.block(next);
  }

  block(number) {
    let block = this.blocks.get(number);
    if (block) {
      this.blocks.delete(number);
    } else {
      block = { reader: null, frames: [] };
      block.ready = unpacked(`frames-${this.number}-${number}`).then((bytes) => {
        block.reader = new BlockReader(bytes, this.run, this.nodes);
        this.onLoad();
      });
    }
    this.blocks.set(number, block);
    for (const old of this.blocks.keys()) {
      if (this.blocks.size <= this.mostBlocks) break;
      this.blocks.delete(old);
    }
    return block;
  }
}
