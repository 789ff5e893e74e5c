// SPDX-License-Identifier: MIT
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
