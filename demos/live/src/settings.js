// SPDX-License-Identifier: MIT
// What a person chooses, and how the address of the page holds it behind its "#".
import { inputs } from "./inputs.js";
import { motions } from "./motions.js";

export const engines = {
  world: { title: "World", about: "holds boxes and pairs from frame to frame; says which begin and end" },
  search: { title: "findPairs", about: "finds all pairs anew in each frame" },
};
export const peers = ["box-intersect", "flatbush", "rbush"];
export const views = {
  pairs: { title: "pairs", about: "colours tell how many others a box touches" },
  begun: { title: "new", about: "boxes flash when a pair begins; a World tells" },
  overlaps: { title: "overlaps", about: "what the two boxes of each pair share" },
};
export const themes = ["auto", "light", "dark"];

export const numbers = [100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000, 200_000, 500_000, 1_000_000];
export const sizes = { least: 0.2, most: 3, step: 0.05 };

export const defaults = { n: 100_000, size: 1, input: "U", motion: "brown", engine: "world", view: "pairs", peers: [], seed: 1, theme: "auto", paused: false, turn: true };

const between = (low, high) => (text) => Math.min(Math.max(Number(text) || low, low), high);
const among = (choices) => (text) => (choices.includes(text) ? text : undefined);
const readers = {
  n: (text) => Math.round(between(numbers[0], numbers.at(-1))(text)),
  size: between(sizes.least, sizes.most),
  input: among(Object.keys(inputs)),
  motion: among(Object.keys(motions)),
  engine: among(Object.keys(engines)),
  view: among(Object.keys(views)),
  peers: (text) => peers.filter((peer) => text.split(",").includes(peer)),
  seed: (text) => Math.round(between(1, 2 ** 31)(text)),
  theme: among(themes),
  paused: (text) => text !== "no",
  turn: (text) => text !== "no",
};

/** Settings of a fragment such as "#n=1000&input=S&peers=rbush"; what it does not name or misnames is as usual. */
export function settingsOf(fragment) {
  const asked = new URLSearchParams(fragment.replace(/^#/, ""));
  const known = [...asked].filter(([key]) => key in readers).map(([key, text]) => [key, readers[key](text)]);
  return { ...defaults, ...Object.fromEntries(known.filter(([, value]) => value !== undefined)) };
}

/** The other way round. */
export function fragmentOf(settings) {
  const text = (value) => (typeof value === "boolean" ? (value ? "yes" : "no") : String(value));
  const differing = Object.keys(readers).filter((key) => text(settings[key]) !== text(defaults[key]));
  return differing.length > 0 ? `#${differing.map((key) => `${key}=${text(settings[key])}`).join("&")}` : "#";
}
