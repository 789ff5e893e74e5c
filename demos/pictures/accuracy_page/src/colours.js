// SPDX-License-Identifier: MIT
import { unique, valueOf } from "./data.js";
import { figure } from "./words.js";

// Colours of the cells of a map, and what they say.

/** An orange or a green, the deeper the larger the part of one. */
const deep = (tone, part) => `rgba(${tone}, ${(0.15 + 0.6 * part).toFixed(3)})`;
const orange = "224, 124, 32";
const green = "38, 148, 92";

/** The value that a map calls right. */
function rightValue(experiment, spec) {
  const wanted = unique(experiment.expect.filter((entry) => entry.op === "==" && entry.metric === spec.y).map((entry) => entry.value));
  return wanted.length === 1 ? wanted[0] : 0;
}

/**
 * Value -> colour. Beside a neutral value what is better is green and what is worse orange; else what is right is pale
 * green and all else orange. The further, the deeper.
 */
export function shades(experiment, spec) {
  const values = experiment.table.points.map((point) => valueOf(point, spec.y)).filter((value) => value !== null);
  const worse = (value) => (spec.better === "high" ? -value : value);
  const partOf = (distance, most) => Math.log1p(distance) / Math.log1p(most);
  if (spec.neutral !== undefined) {
    const beside = (value) => worse(value) - worse(spec.neutral);
    const most = Math.max(...values.map((value) => Math.abs(beside(value))));
    return (value) => (figure(value) === figure(spec.neutral) ? inks.neutral : deep(beside(value) < 0 ? green : orange, partOf(Math.abs(beside(value)), most)));
  }
  const right = rightValue(experiment, spec);
  // Where more is better what is wrong begins at the most of it.
  const start = spec.better === "high" ? Math.max(...values) : right;
  const most = Math.max(...values.map((value) => Math.abs(value - start)));
  return (value) => (value === right ? inks.right : deep(orange, most > 0 ? partOf(Math.abs(value - start), most) : 1));
}

/** What the colours of a map say. */
export function shadesNote({ experiment }, spec) {
  if (spec.neutral === undefined) return `Green: as it should be (${figure(rightValue(experiment, spec))}). The deeper the orange, the worse.`;
  const [less, more] = spec.better === "high" ? ["more", "less"] : ["less", "more"];
  return `Green: ${less} than ${figure(spec.neutral)}, which is better. Orange: ${more}, which is worse. The deeper, the further from ${figure(spec.neutral)}.`;
}

// The same candidate has the same colour and symbol everywhere.

// Distinguishable with colour vision deficiency: Okabe and Ito, 2008.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b58900", "#56b4e9", "#444444", "#8c6d1f", "#7b3fa0", "#a8325e"];
const symbols = ["circle", "rect", "triangle", "diamond", "roundRect", "pin"];
const dashes = ["solid", "dashed", "dotted"];

/** Styles by name; `groups` are names that are drawn together and so must differ, in colour where there are enough. */
export function styles(groups) {
  const neighbours = new Map();
  for (const names of groups) for (const name of names) neighbours.set(name, new Set([...(neighbours.get(name) ?? []), ...names]));
  const places = new Map();
  // Those with the most neighbours have the least choice, and choose first.
  for (const [name, others] of [...neighbours].sort((a, b) => b[1].size - a[1].size)) {
    const taken = [...others].filter((other) => places.has(other)).map((other) => places.get(other));
    const ofColour = (place) => taken.filter((other) => other % palette.length === place % palette.length).length;
    const free = Array.from({ length: symbols.length * palette.length }, (_, place) => place).filter((place) => !taken.includes(place));
    places.set(name, free.reduce((best, place) => (ofColour(place) < ofColour(best) ? place : best), free[0] ?? 0));
  }
  return new Map([...places].map(([name, place]) => [name, styleAt(place)]));
}

function styleAt(place) {
  const round = Math.floor(place / palette.length);
  return { color: palette[place % palette.length], symbol: symbols[(place + round) % symbols.length], dash: dashes[round % dashes.length] };
}

export const plainStyle = styleAt(0);
export const partColours = palette;

/** What plots draw without a series: text, lines, cells. */
export const inks = { text: "#1b1d1f", soft: "#555b60", line: "#8a9096", grid: "#e3e6e9", paper: "#ffffff", card: "#fafbfb", pale: "#b9bfc5", failed: "#dcdcdc", neutral: "#f1f1f1", right: "#d9efe2" };

// On a dark ground the same hues are lighter, and fills of cells darker, so that text on them can be read.
const onDark = new Map(Object.entries({
  "#0072b2": "#5aaee8", "#d55e00": "#f08a3c", "#009e73": "#35c493", "#cc79a7": "#e29ac3", "#b58900": "#dcb23c", "#56b4e9": "#8fd3f7", "#444444": "#b4bac0", "#8c6d1f": "#c7a55a", "#7b3fa0": "#bb8be0", "#a8325e": "#ec7fa6",
  [inks.text]: "#e4e8ed", [inks.soft]: "#a9b2bc", [inks.line]: "#7c8792", [inks.grid]: "#2c343d", [inks.paper]: "#14181d", [inks.card]: "#1a2027", [inks.pale]: "#56606b", [inks.failed]: "#3c444d", [inks.neutral]: "#2a323c", [inks.right]: "#1d4030",
}));
const darkCells = { "rgba(224, 124, 32,": "rgba(168, 86, 12,", "rgba(38, 148, 92,": "rgba(24, 104, 64," };

let dark = false;

/** Whether what is drawn from now on is on a dark ground. */
export const setGround = (isDark) => (dark = isDark);

/** The colour for the ground that it is drawn on. */
export function tint(colour) {
  if (!dark) return colour;
  const cell = Object.keys(darkCells).find((start) => colour.startsWith(start));
  return onDark.get(colour) ?? (cell ? darkCells[cell] + colour.slice(cell.length) : colour);
}

/** The same for all colours in a plot's options, at any depth; functions stay as they are. */
export function tinted(option) {
  if (typeof option === "string") return tint(option);
  if (Array.isArray(option)) return option.map(tinted);
  if (option === null || typeof option !== "object") return option;
  return Object.fromEntries(Object.entries(option).map(([key, value]) => [key, tinted(value)]));
}
