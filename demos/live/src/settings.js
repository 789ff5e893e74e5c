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
  pairs: { title: "pairs", about: "colours tell how many others a box touches", legend: ["touches none", "one", "eight or more"] },
  begun: { title: "new", about: "boxes flash when a pair begins; a World tells", legend: ["no new pair", "some time ago", "just now"] },
  overlaps: { title: "overlaps", about: "what the two boxes of each pair share", legend: ["boxes", "", "shared by two"] },
};
export const themes = ["auto", "light", "dark"];

export const numbers = [100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000, 200_000, 500_000, 1_000_000];
export const sizes = { least: 0.2, most: 3, step: 0.05 };

/** Whoever asks the system for less motion gets boxes that stand still until told to play. */
const still = globalThis.matchMedia?.("(prefers-reduced-motion: reduce)").matches ?? false;

export const defaults = { n: 100_000, size: 1, input: "U", motion: "brown", engine: "world", view: "pairs", peers: [], seed: 1, theme: "auto", paused: still, turn: !still };

/** Nothing for what is no number. */
const between = (low, high, number = Number) => (text) => (text.trim() === "" || Number.isNaN(Number(text)) ? undefined : number(Math.min(Math.max(Number(text), low), high)));
const among = (choices) => (text) => (choices.includes(text) ? text : undefined);
const readers = {
  n: between(numbers[0], numbers.at(-1), Math.round),
  size: between(sizes.least, sizes.most),
  input: among(Object.keys(inputs)),
  motion: among(Object.keys(motions)),
  engine: among(Object.keys(engines)),
  view: among(Object.keys(views)),
  peers: (text) => peers.filter((peer) => text.split(",").includes(peer)),
  seed: between(1, 2 ** 31, Math.round),
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
