// SPDX-License-Identifier: MIT
import { speeds } from "./player.js";

const element = (id) => document.getElementById(id);
const number = (value) => value.toLocaleString("en");

/** Everything around the scene: texts, buttons and keys. `viewer` does what they say. */
export class Panel {
  constructor(run, viewer) {
    this.run = run;
    this.viewer = viewer;
    this.player = viewer.player;
    document.title = `${run.title} \u2013 boxstream`;
    element("title").textContent = run.title;
    element("about").textContent = run.about;
    const objects = `${number(run.states.length)} objects`;
    const every = run.frameSteps.length > 1 ? run.frameSteps[1] : 1;
    const kept = every > 1 ? ` \u00b7 one in ${every} steps is shown` : "";
    element("facts").textContent = `Broad-phase ${run.broadphase} \u00b7 ${objects} \u00b7 ${number(run.series.step.length)} steps of ${(1000 * run.dt).toFixed(1)} ms${kept}`;
    element("versions").textContent = run.versions;
    this.slider = element("scrubber");
    this.slider.max = this.player.last;
    this.slider.addEventListener("input", () => this.player.go(Number(this.slider.value)));
    for (const speed of speeds) element("speed").add(new Option(`${speed} \u00d7`, speed, speed === 1, speed === 1));
    element("speed").addEventListener("change", (event) => {
      this.player.speed = Number(event.target.value);
      event.target.blur();
    });
    this.modes();
    this.buttons();
    document.addEventListener("keydown", (event) => this.key(event));
  }

  modes() {
    for (const [name, mode] of Object.entries(this.viewer.colours.modes)) {
      const button = document.createElement("button");
      button.textContent = mode.title;
      button.dataset.mode = name;
      button.addEventListener("click", () => this.viewer.setColour(name));
      element("modes").append(button);
    }
  }

  buttons() {
    const { player, viewer } = this;
    const actions = {
      play: () => player.toggle(),
      back: () => player.move(-1),
      on: () => player.move(1),
      first: () => player.move(-Infinity),
      last: () => player.move(Infinity),
      loop: () => {
        player.loop = !player.loop;
        player.onChange();
      },
      boxes: () => viewer.setOverlay("boxes", !viewer.overlays.boxes),
      pairs: () => viewer.setOverlay("pairs", !viewer.overlays.pairs),
      frame: () => viewer.frameAll(),
      help: () => this.help(element("helptext").hidden),
      closehelp: () => this.help(false),
    };
    this.actions = actions;
    for (const [id, action] of Object.entries(actions)) {
      element(id).addEventListener("click", () => {
        action();
        element(id).blur(); // or the space bar would press it again
      });
    }
  }

  help(shown) {
    element("helptext").hidden = !shown;
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const by = event.shiftKey ? 10 : 1;
    const { player, viewer, actions } = this;
    const keys = {
      " ": actions.play,
      ArrowLeft: () => player.move(-by),
      ArrowRight: () => player.move(by),
      Home: actions.first,
      End: actions.last,
      ArrowUp: () => player.faster(1),
      ArrowDown: () => player.faster(-1),
      l: actions.loop,
      b: actions.boxes,
      p: actions.pairs,
      f: actions.frame,
      h: actions.help,
      "?": actions.help,
      Escape: () => {
        this.help(false);
        viewer.select(-1);
      },
    };
    Object.keys(viewer.colours.modes).forEach((mode, i) => (keys[i + 1] = () => viewer.setColour(mode)));
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** Shows the state of the player. */
  update() {
    const { player, run } = this;
    element("play").dataset.state = player.playing ? "playing" : "paused";
    element("play").title = player.playing ? "Pause (space)" : "Play (space)";
    element("step").textContent = number(player.step);
    element("steps").textContent = number(run.series.step.length);
    element("time").textContent = `${(player.step * run.dt).toFixed(2)} s`;
    element("speed").value = player.speed;
    element("loop").classList.toggle("on", player.loop);
    this.slider.value = player.frame;
  }

  /** Shows how things are drawn. */
  updateLook() {
    const { colours, overlays } = this.viewer;
    for (const button of element("modes").children) button.classList.toggle("on", button.dataset.mode === colours.mode);
    for (const name of ["boxes", "pairs"]) element(name).classList.toggle("on", overlays[name]);
    element("legend").replaceChildren(
      ...colours.legend().flatMap(({ background, text, end, wide }) => {
        const swatch = document.createElement("i");
        swatch.style.background = background;
        swatch.classList.toggle("wide", Boolean(wide));
        const words = document.createElement("span");
        words.textContent = text;
        const after = document.createElement("span");
        after.textContent = end ?? "";
        return wide ? [words, swatch, after] : [swatch, words];
      }),
    );
  }

  /** Rows of [what, value] about the object that was clicked, or null. */
  showObject(rows) {
    const card = element("object");
    card.hidden = rows === null;
    card.replaceChildren(
      ...(rows ?? []).flatMap(([what, value]) => {
        const term = document.createElement("dt");
        term.textContent = what;
        const text = document.createElement("dd");
        text.textContent = value;
        return [term, text];
      }),
    );
  }
}
