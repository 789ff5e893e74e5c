// SPDX-License-Identifier: MIT
// Markers as legends show them: the shape that the plot draws, on a piece of its line.

const paths = {
  circle: '<circle cx="13" cy="6" r="4"/>',
  rect: '<rect x="9.5" y="2.5" width="7" height="7"/>',
  roundRect: '<rect x="9" y="2" width="8" height="8" rx="2.5"/>',
  triangle: '<path d="M13 1.5L17.5 10H8.5Z"/>',
  diamond: '<path d="M13 .5L18 6L13 11.5L8 6Z"/>',
  pin: '<path d="M13 12C9 7 9 1 13 1S17 7 13 12Z"/>',
  none: "",
};

const dashes = { solid: "", dashed: "5 3", dotted: "2 2" };

/** An <svg> of 26 x 12 pixels, in the colour `--mark` of the element around it. */
export function swatch({ symbol = "none", dash = "solid", line = true, hollow = false }) {
  const holder = document.createElement("span");
  holder.className = "swatch";
  const stroke = line ? `<path d="M0 6H26" fill="none" stroke="currentColor" stroke-width="1.6" stroke-dasharray="${dashes[dash] ?? ""}"/>` : "";
  holder.innerHTML = `<svg width="26" height="12" viewBox="0 0 26 12" aria-hidden="true"><g fill="${hollow ? "none" : "currentColor"}" stroke="${hollow ? "currentColor" : "none"}" stroke-width="1.8">${stroke}${paths[symbol] ?? paths.circle}</g></svg>`;
  return holder;
}
