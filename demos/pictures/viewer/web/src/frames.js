// SPDX-License-Identifier: MIT
import { BlockReader } from "./block.js";
import { unpacked } from "./text.js";

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
