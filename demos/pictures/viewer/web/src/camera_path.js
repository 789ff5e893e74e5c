// SPDX-License-Identifier: MIT
import { Box3, Vector3 } from "three";

/** Where the camera looks while the run goes on: at the crowd, at one body, or where its user has left it. */
export class CameraPath {
  constructor(viewport, worlds) {
    this.viewport = viewport;
    this.worlds = worlds;
    this.following = true;
    this.chased = -1; // an object
  }

  /** The bounds of what moves, in all worlds, without the outermost 1 %. */
  crowd(player) {
    const all = new Box3();
    for (const world of this.worlds) {
      const [min, max] = world.run.crowds[Math.floor(world.positionOf(player))];
      all.union(new Box3(new Vector3(...min), new Vector3(...max)));
    }
    return all;
  }

  /** Around the chased body and its neighbourhood. */
  neighbourhood() {
    const { poses, size } = this.worlds[0];
    const place = new Vector3().fromArray(poses.places, 3 * this.chased);
    const reach = Math.max(4 * this.worlds[0].reachOf(this.chased), size / 1000);
    return new Box3(place.clone().subScalar(reach), place.clone().addScalar(reach));
  }

  home(player) {
    return this.chased >= 0 ? this.neighbourhood() : this.crowd(player);
  }

  open(player) {
    this.viewport.frame(this.crowd(player), new Vector3(...this.worlds[0].run.firstDirection).normalize());
  }

  fit(player) {
    this.viewport.frame(this.home(player));
  }

  chase(object, player) {
    this.chased = object;
    if (object >= 0) this.fit(player);
    else this.viewport.shown = this.crowd(player);
  }

  /** The scene shows what `player` says. */
  advance(player) {
    if (this.chased >= 0 || this.following) this.viewport.follow(this.home(player));
    else this.viewport.shown = this.crowd(player);
  }
}
