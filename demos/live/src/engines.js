// SPDX-License-Identifier: MIT
// The two ways to the pairs of boxes that move. Each makes itself of the boxes, and steps to where they are now.
import { Detector, World } from "boxstream";

/** A search of all boxes, frame by frame. */
class Search {
  detector = new Detector();

  step({ boxes }) {
    return { pairs: this.detector.findPairs(boxes), begun: null };
  }
  free() {
    this.detector.free();
  }
}

/** Of boxes that were created first and all at once: their ids are 1, 2, 3, ... */
function indicesOf(ids) {
  const indices = new Uint32Array(ids.length);
  for (let i = 0; i < ids.length; ++i) indices[i] = ids[i] - 1;
  return indices;
}

/** A World, which is told what moves and holds the pairs. */
class Held {
  constructor({ boxes, movers }) {
    this.world = new World();
    this.ids = this.world.create(boxes);
    this.moving = movers.length < this.ids.length ? { ids: Float64Array.from(movers, (i) => this.ids[i]), boxes: new Float32Array(6 * movers.length) } : null;
  }

  step(moved) {
    const { world } = this;
    this.move(moved);
    world.update();
    return { pairs: indicesOf(world.pairs), begun: indicesOf(world.begun) };
  }

  move({ boxes, movers, resized }) {
    if (!this.moving || resized) return this.world.move(this.ids, boxes);
    movers.forEach((box, k) => this.moving.boxes.set(boxes.subarray(6 * box, 6 * box + 6), 6 * k));
    return this.world.move(this.moving.ids, this.moving.boxes);
  }

  free() {
    this.world.free();
  }
}

export const engines = { world: Held, search: Search };
