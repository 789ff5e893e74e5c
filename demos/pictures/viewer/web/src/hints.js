// SPDX-License-Identifier: MIT
import { distance, whole } from "./words.js";

/** What a picture of many bodies leaves out. */
export function leftOut({ overlays, selected, worlds }) {
  const isCrowded = (overlays.boxes || overlays.pairs || overlays.contacts) && !worlds[0].focus.isAll;
  if (!isCrowded) return "";
  return selected >= 0 ? "Of the selected body and its pairs." : "Of the nearest bodies only. Select one, or come nearer.";
}

/** How far two worlds have come apart. */
export function differences([a, b]) {
  const ways = a.movers.map((object) => a.apart[object]).filter((way) => Number.isFinite(way)).sort((x, y) => x - y);
  if (ways.length === 0) return "";
  const apart = `Apart: median ${distance(ways[ways.length >> 1])}, at most ${distance(ways.at(-1))}.`;
  return `${apart} Pairs only in ${a.run.label}: ${whole(a.pairsWithout(b))}, only in ${b.run.label}: ${whole(b.pairsWithout(a))}.`;
}
