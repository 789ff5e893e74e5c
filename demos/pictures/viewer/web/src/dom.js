// SPDX-License-Identifier: MIT

export const element = (id) => document.getElementById(id);

export function make(tag, text = "", properties = {}) {
  const node = document.createElement(tag);
  node.textContent = text;
  return Object.assign(node, properties);
}

/** Terms and what they stand for, for a <dl>. */
export const rows = (list) => list.flatMap(([term, text]) => [make("dt", term), make("dd", text)]);

const prefersDark = matchMedia("(prefers-color-scheme: dark)");

/** Light or dark: as the browser prefers, until somebody says otherwise. The colours are those of the style sheet. */
export class Theme {
  constructor() {
    this.chosen = null; // "light", "dark" or neither
    this.onChange = () => {};
    prefersDark.addEventListener("change", () => this.apply());
    this.apply();
  }

  get dark() {
    return this.chosen ? this.chosen === "dark" : prefersDark.matches;
  }

  choose(name) {
    this.chosen = name;
    this.apply();
  }

  apply() {
    document.documentElement.classList.toggle("dark", this.dark);
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(`--${name}`).trim();
    this.colours = { dark: this.dark, ...Object.fromEntries(["sky", "ground", "grid", "ink", "quiet", "line", "paper", "accent"].map((name) => [name, colour(name)])) };
    this.onChange();
  }
}
