// SPDX-License-Identifier: MIT

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
