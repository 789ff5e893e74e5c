// SPDX-License-Identifier: MIT
import { whole } from "./words.js";

/**
 * Which objects of the world are on the page. All else here calls an object by its place among these; people call it by its
 * number in the world. Wheels follow the objects.
 */
export class Objects {
  constructor({ kept, states }) {
    this.kept = kept;
    this.isAll = !kept.steps;
    const shown = kept.steps?.length ?? kept.inWorld;
    this.count = kept.inWorld + states.length - shown;
    this.numbers = Uint32Array.from(states, (_, place) => kept.inWorld + place - shown);
    let number = 0;
    for (let place = 0; place < shown; ++place) this.numbers[place] = this.isAll ? place : (number += kept.steps[place]);
    this.places = new Map(Array.from(this.numbers, (of, place) => [of, place]));
  }

  numberOf(place) {
    return this.numbers[place];
  }

  /** -1: it is not on the page. */
  placeOf(number) {
    return this.places.get(number) ?? -1;
  }

  /** What is to be added where only objects of the page have been counted. */
  get amongThese() {
    return this.isAll ? "" : " (of those shown)";
  }

  /** Which are shown, for people; nothing where all are. */
  get choice() {
    if (this.isAll) return "";
    const { inWorld, landmarks, nearest, steps } = this.kept;
    const sampled = whole(steps.length - landmarks - nearest);
    const which = `${whole(landmarks)} that are named, fixed or large, the ${whole(nearest)} that are nearest to the camera at first, and a sample of ${sampled} others`;
    return `${whole(steps.length)} of ${whole(inWorld)} objects are shown: ${which}. Curves are of all.`;
  }
}
