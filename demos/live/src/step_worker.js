// SPDX-License-Identifier: MIT
// The worker that moves the boxes and finds their pairs: a message in, a frame out. Times are in milliseconds.
import { Detector } from "boxstream";
import { engines } from "./engines.js";
import { makeBoxes } from "./inputs.js";
import { Marks, overlaps } from "./marks.js";
import { MovingBoxes } from "./motions.js";
import { spoiled } from "./pairs.js";

const everyNth = 15; // frames with a World in which findPairs is measured as well

function timed(work) {
  const start = performance.now();
  const result = work();
  return [result, performance.now() - start];
}

class Steps {
  constructor({ n, input, motion, size, engine, seed }) {
    this.moving = new MovingBoxes(makeBoxes(input, n, seed), motion, size, seed);
    this.marks = new Marks(n);
    this.detector = new Detector();
    this.frame = 0;
    this.size = size;
    this.use(engine);
  }

  use(name) {
    this.engine?.free();
    this.name = name;
    this.engine = new engines[name](this.moving);
  }

  free() {
    this.engine.free();
    this.detector.free();
  }

  resize(size) {
    if (size === this.size) return false;
    this.moving.resize((this.size = size));
    return true;
  }

  next(wish) {
    if (wish.engine !== this.name) this.use(wish.engine);
    const resized = this.resize(wish.size);
    const { boxes, movers } = this.moving;
    const [, motion] = timed(() => this.moving.next());
    const [{ pairs, begun }, search] = timed(() => this.engine.step({ boxes, movers, resized }));
    const [partners, marking] = timed(() => this.marks.set(pairs, begun, wish.selected));
    const frame = { frame: ++this.frame, pairs: pairs.length / 2, begun: begun && begun.length / 2, drift: this.moving.drift, partners };
    frame.times = { motion, marking, ...this.searchTimes(search, wish.snapshot) };
    if (wish.snapshot) frame.snapshot = { boxes: boxes.slice(), pairs: wish.spoil ? spoiled(pairs, boxes) : pairs.slice() };
    if (wish.overlaps) frame.overlaps = overlaps(pairs, boxes);
    return this.copied(frame, wish.spare);
  }

  searchTimes(time, snapshot) {
    if (this.name === "search") return { search: time };
    const alsoSearch = snapshot || this.frame % everyNth === 0;
    return { world: time, search: alsoSearch ? timed(() => this.detector.findPairs(this.moving.boxes))[1] : undefined };
  }

  /** The frame with copies of boxes and marks, into arrays that the page has no more use for. */
  copied(frame, spare) {
    const fits = spare?.boxes.length === this.moving.boxes.length;
    frame.boxes = fits ? spare.boxes : new Float32Array(this.moving.boxes.length);
    frame.marks = fits ? spare.marks : new Uint8Array(this.marks.bytes.length);
    frame.boxes.set(this.moving.boxes);
    frame.marks.set(this.marks.bytes);
    return frame;
  }
}

const buffersOf = ({ boxes, marks, overlaps: shared, snapshot }) => [boxes, marks, shared, snapshot?.boxes, snapshot?.pairs].filter(Boolean).map((array) => array.buffer);

export function serveSteps() {
  let steps = null;
  self.onmessage = ({ data }) => {
    try {
      const started = performance.now();
      if (data.settings) {
        steps?.free();
        steps = new Steps(data.settings);
      }
      const frame = steps.next(data);
      frame.run = data.run;
      frame.times.step = performance.now() - started;
      self.postMessage(frame, buffersOf(frame));
    } catch (error) {
      self.postMessage({ failed: String(error?.message ?? error) });
    }
  };
}
