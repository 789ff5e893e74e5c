// SPDX-License-Identifier: MIT
// The same candidate has the same colour and symbol everywhere.

// Distinguishable with colour vision deficiency: Okabe and Ito, 2008.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b58900", "#56b4e9", "#444444", "#8c6d1f", "#7b3fa0", "#a8325e"];
const symbols = ["circle", "rect", "triangle", "diamond", "roundRect", "pin"];
const dashes = ["solid", "dashed", "dotted"];

/** Styles by name; `groups` are names that are drawn together and so must differ. */
export function styles(groups) {
  const found = new Map();
  const all = symbols.length * palette.length;
  for (const names of groups) {
    const taken = new Set(names.filter((name) => found.has(name)).map((name) => found.get(name)));
    for (const name of names) {
      if (found.has(name)) continue;
      let place = 0;
      const clashes = (at, strict) => [...taken].some((other) => other === at || (strict && other % palette.length === at % palette.length));
      while (place < palette.length && clashes(place, true)) ++place;
      if (place === palette.length) while (place < all && clashes(place, false)) ++place;
      taken.add(place);
      found.set(name, place);
    }
  }
  return new Map([...found].map(([name, place]) => [name, styleAt(place)]));
}

function styleAt(place) {
  const round = Math.floor(place / palette.length);
  return { color: palette[place % palette.length], symbol: symbols[(place + round) % symbols.length], dash: dashes[round % dashes.length] };
}

export const plainStyle = styleAt(0);
export const partColours = palette;
