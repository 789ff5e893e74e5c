// SPDX-License-Identifier: MIT
import { startWorker } from "./workers.js";

/** The worker of the steps, as the page sees it: asks for one frame at a time, and hands arrays back. */
export class Steps {
  constructor(onFrame, onFailure) {
    this.onFrame = onFrame;
    this.onFailure = onFailure;
    this.run = 0;
    this.spare = null;
    this.restart();
  }

  restart() {
    this.worker?.terminate();
    this.worker = startWorker("steps", (frame) => this.receive(frame));
    this.busy = false;
    this.begin(this.settings);
  }

  /** The next frame is the first of boxes made anew. */
  begin(settings) {
    this.settings = settings;
    this.isNew = true;
  }

  /** Asks for the next frame, unless one is under way. `wish`: {engine, size, selected, snapshot, spoil, overlaps}. */
  ask(wish) {
    if (this.busy) return;
    this.busy = true;
    if (this.isNew) ++this.run;
    const spare = this.isNew ? null : this.spare;
    this.worker.postMessage({ ...wish, run: this.run, settings: this.isNew ? this.settings : null, spare }, spare ? [spare.boxes.buffer, spare.marks.buffer] : []);
    this.isNew = false;
    this.spare = null;
  }

  /** Arrays of a frame that nobody looks at any more. */
  recycle(frame) {
    if (frame) this.spare = { boxes: frame.boxes, marks: frame.marks };
  }

  receive(frame) {
    this.busy = false;
    if (frame.failed) this.onFailure(frame.failed);
    // Boxes that were made before the last change of settings are of no use.
    else if (!this.isNew) this.onFrame(frame);
  }
}
