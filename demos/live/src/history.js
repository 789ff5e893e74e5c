// SPDX-License-Identifier: MIT
import { median } from "./words.js";

export const span = 15_000; // ms that are kept
const mostForMedian = 31;

/** Times of all contestants over the last seconds: lists of [when, milliseconds]. */
export class History {
  constructor(names) {
    this.series = new Map(names.map((name) => [name, []]));
  }

  add(name, when, time) {
    const list = this.series.get(name);
    list.push([when, time]);
    while (list[0][0] < when - span) list.shift();
  }

  /** Of other boxes; the plot has a gap there. */
  clear() {
    for (const list of this.series.values()) list.length = 0;
  }

  /** Of the last frames; what was measured first was compiled while it ran. */
  typical(name) {
    const list = this.series.get(name);
    return median(list.slice(list.length > 2 ? 1 : 0).slice(-mostForMedian).map(([, time]) => time));
  }
}
