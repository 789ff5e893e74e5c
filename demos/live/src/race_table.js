// SPDX-License-Identifier: MIT
import { element } from "./panel.js";
import { peers } from "./settings.js";
import { duration, figure } from "./words.js";

const own = ["World", "findPairs"];
export const raceNames = [...own, ...peers];

/** The table of who takes how long. A click on a package lets it race, or stops it. */
export class RaceTable {
  constructor(live, history) {
    this.live = live;
    this.history = history;
    this.rows = new Map(raceNames.map((name) => [name, this.row(name)]));
    element("contestants").append(...[...this.rows.values()].map(({ row }) => row));
  }

  row(name) {
    const row = document.createElement("tr");
    const colour = document.createElement("i");
    colour.style.background = `var(--${name})`;
    const label = document.createElement(peers.includes(name) ? "button" : "span");
    label.textContent = name;
    if (peers.includes(name)) label.addEventListener("click", () => this.live.race(name));
    row.insertCell().append(colour, label);
    const [time, ratio] = [row.insertCell(), row.insertCell()];
    time.className = ratio.className = "n";
    return { row, label, time, ratio };
  }

  update() {
    const unit = this.history.typical("findPairs");
    for (const [name, { label, time, ratio }] of this.rows) {
      const typical = this.history.typical(name);
      const racing = this.live.settings.peers.includes(name);
      if (peers.includes(name)) label.setAttribute("aria-pressed", racing);
      time.textContent = this.live.beside.givenUp.has(name) ? "over 5 s" : typical === undefined && racing ? "\u2026" : duration(typical);
      ratio.textContent = typical && unit ? figure(typical / unit) : "";
    }
  }
}
