// SPDX-License-Identifier: MIT
// The settings as controls. `live` is told what a person changes.
import { inputs } from "./inputs.js";
import { motions } from "./motions.js";
import { engines, numbers, sizes, views } from "./settings.js";
import { count } from "./words.js";

export const element = (id) => document.getElementById(id);

const groups = { input: inputs, motion: motions, engine: engines, view: views };

/** The place of n among those that the slider offers. */
const notchOf = (n) => numbers.reduce((best, value, i) => (Math.abs(Math.log(value / n)) < Math.abs(Math.log(numbers[best] / n)) ? i : best), 0);

/** The next of a list, round and round. */
const after = (list, value, by = 1) => list[(list.indexOf(value) + by + list.length) % list.length];

export class Panel {
  constructor(live) {
    this.live = live;
    this.sliders();
    for (const [name, choices] of Object.entries(groups)) this.group(name, choices);
  }

  sliders() {
    Object.assign(element("n"), { min: 0, max: numbers.length - 1, step: 1 });
    element("n").addEventListener("input", ({ target }) => this.live.change({ n: numbers[target.value] }));
    Object.assign(element("size"), { min: sizes.least, max: sizes.most, step: sizes.step });
    element("size").addEventListener("input", ({ target }) => this.live.change({ size: Number(target.value) }));
  }

  group(name, choices) {
    for (const [value, { title, about }] of Object.entries(choices)) {
      const button = Object.assign(document.createElement("button"), { textContent: title, title: about });
      button.dataset.value = value;
      button.addEventListener("click", () => this.live.change({ [name]: value }));
      element(name).append(button);
    }
  }

  /** A notch up or down. */
  more(by) {
    const notch = Math.min(Math.max(notchOf(this.live.settings.n) + by, 0), numbers.length - 1);
    this.live.change({ n: numbers[notch] });
  }
  larger(by) {
    const size = Math.min(Math.max(this.live.settings.size + by * sizes.step, sizes.least), sizes.most);
    this.live.change({ size: Number(size.toFixed(3)) });
  }
  another(name) {
    this.live.change({ [name]: after(Object.keys(groups[name]), this.live.settings[name]) });
  }

  /** Shows the settings. */
  update() {
    const { settings } = this.live;
    element("n").value = notchOf(settings.n);
    element("n").setAttribute("aria-valuetext", count(settings.n));
    element("ntext").textContent = count(settings.n);
    element("size").value = settings.size;
    element("sizetext").textContent = `\u00d7 ${settings.size.toFixed(2)}`;
    for (const name of Object.keys(groups)) for (const button of element(name).children) button.setAttribute("aria-pressed", button.dataset.value === settings[name]);
    element("about").textContent = `${settings.input}: ${inputs[settings.input].about}. ${settings.motion}: ${motions[settings.motion].about}.`;
    const { legend } = views[settings.view];
    element("legend").dataset.view = settings.view;
    element("legend").querySelectorAll("span").forEach((span, i) => (span.textContent = legend[i]));
    element("pause").textContent = settings.paused ? "Play" : "Pause";
    element("pause").title = settings.paused ? "Play (space)" : "Pause (space)";
    element("turn").setAttribute("aria-pressed", settings.turn);
  }
}
