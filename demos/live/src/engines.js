// SPDX-License-Identifier: MIT
// The two ways to the pairs of boxes that move. Each makes itself of the boxes, and steps to where they are now.
import { World, findPairs } from "boxstream";

/** A search of all boxes, frame by frame. */
class Search {
  step({ boxes }) {
    return { pairs: findPairs(boxes), begun: null };
  }
  close() {}
}

/** A World, which is told what moves and holds the pairs. */
class Held {
  constructor({ boxes, movers }) {
    this.world = new World();
    this.ids = this.world.create(boxes);
    this.moving = movers.length < this.ids.length ? { ids: movers.map((i) => this.ids[i]), boxes: new Float32Array(6 * movers.length) } : null;
  }

  step({ boxes, movers, resized }) {
    if (this.moving && !resized) {
      movers.forEach((box, k) => this.moving.boxes.set(boxes.subarray(6 * box, 6 * box + 6), 6 * k));
      this.world.move(this.moving.ids, this.moving.boxes);
    } else this.world.move(this.ids, boxes);
    this.world.update();
    return { pairs: this.world.pairs, begun: this.world.begun };
  }

  close() {
    this.world.destroy(this.ids);
  }
}

export const engines = {
  world: { title: "World", about: "holds boxes and pairs from frame to frame; says which begin and end", Engine: Held },
  search: { title: "findPairs", about: "finds all pairs anew in each frame", Engine: Search },
};
