// SPDX-License-Identifier: MIT
import { BlockReader } from "./block.js";

/** What the page carries in a script element, unpacked. */
export async function unpacked(id) {
  const text = atob(document.getElementById(id).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Frames that are kept unpacked, at most; blocks used longest ago go first.
const memory = 500e6;

/** The frames of a run, unpacked when they are needed. */
export class Frames {
  constructor(run) {
    this.run = run;
    this.count = run.frameSteps.length;
    this.objects = run.states.length;
    this.nodes = run.softParts.reduce((sum, part) => sum + part.count, 0);
    this.blocks = new Map(); // in order of last use
    const bytes = 105 * this.objects + 24 * this.nodes + 8 * run.series.pairs.reduce((most, pairs) => Math.max(most, pairs), 0);
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
      block.ready = unpacked(`frames-${number}`).then((bytes) => {
        block.reader = new BlockReader(bytes, this.objects, this.nodes);
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
