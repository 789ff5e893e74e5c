// SPDX-License-Identifier: MIT
import { aboutObject } from "./objects.js";
import { actionsOf, listenToKeys } from "./keys.js";
import { element, make, rows } from "./dom.js";
import { worldColours } from "./graphs.js";
import { differences, duration, leftOut, whole } from "./words.js";
import { Names, watchSearch } from "./names.js";
import { speeds } from "./player.js";

const root = document.documentElement;
const overlayTitles = { boxes: ["Boxes", "B"], pairs: ["Pairs", "P"], contacts: ["Contacts", "K"], joints: ["Joints", "J"] };
// A phone has no room for what can be opened.
const isSmall = () => innerWidth <= 720 || innerHeight <= 480;

/** Everything around the scene: texts, buttons and keys. `viewer` does what they say. */
export class Panel {
  constructor(viewer) {
    this.viewer = viewer;
    this.player = viewer.player;
    this.worlds = viewer.worlds;
    this.names = new Names(this.worlds[0].run, this.worlds[0].objects, this.worlds[0].colours.kinds);
    this.describe();
    this.actions = actionsOf(this);
    this.fill();
    this.watch();
    element("keys").replaceChildren(...listenToKeys({ viewer, player: this.player, actions: this.actions }));
    watchSearch(this.names, (object) => viewer.select(object));
    root.classList.toggle("look", !isSmall());
    root.classList.toggle("curves", !isSmall());
  }

  describe() {
    const { run, objects } = this.worlds[0];
    document.title = `${run.title} \u2013 boxstream`;
    element("title").textContent = run.title;
    element("about").textContent = run.about;
    const every = run.frameSteps.length > 1 ? run.frameSteps[1] : 1;
    const how = this.viewer.isCompared ? this.worlds.map((world) => world.run.label).join(" beside ") : `broad-phase ${run.broadphase}`;
    const facts = [how, `${whole(objects.count)} objects`, `${whole(run.series.step.length)} steps of ${duration(1000 * run.dt)}`];
    if (every > 1) facts.push(`one in ${every} steps is shown`);
    element("facts").textContent = facts.join(" \u00b7 ");
    element("choice").textContent = objects.choice;
    element("choice").hidden = objects.isAll;
    element("versions").textContent = `${run.versions}. Drawn with three.js (MIT) and ECharts (Apache License 2.0).`;
  }

  fill() {
    const { run } = this.worlds[0];
    for (const speed of speeds) element("speed").add(new Option(`${speed} \u00d7`, speed, speed === 1, speed === 1));
    for (const [name, { title }] of Object.entries(this.viewer.modes)) element("modes").add(new Option(title, name));
    for (const [name, [title, key]] of Object.entries(overlayTitles)) {
      if (name === "joints" && run.joints.length === 0) continue;
      const button = make("button", title, { id: name, title: `${title} (${key})` });
      button.addEventListener("click", () => this.press(button, () => this.actions.overlay(name)));
      element("overlays").append(button);
    }
    element("scrubber").max = this.player.last;
  }

  watch() {
    for (const [id, action] of Object.entries(this.actions)) if (element(id)?.matches("button")) element(id).addEventListener("click", () => this.press(element(id), action));
    for (const button of document.querySelectorAll(".close")) button.addEventListener("click", this.actions.escape);
    element("scrubber").addEventListener("input", (event) => this.player.go(Number(event.target.value)));
    const choose = (id, act) =>
      element(id).addEventListener("change", (event) => {
        act(event.target.value);
        event.target.blur();
      });
    choose("speed", (speed) => {
      this.player.speed = Number(speed);
      this.player.onChange();
    });
    choose("modes", (mode) => this.viewer.setColour(mode));
  }

  /** Without the focus, or the space bar would press it again. */
  press(button, action) {
    action();
    button.blur();
  }

  /** Shows the state of the player. */
  update() {
    const { player } = this;
    const { run } = this.worlds[0];
    element("play").dataset.state = player.playing ? "playing" : "paused";
    element("step").textContent = whole(player.step);
    element("steps").textContent = `\u2009/\u2009${whole(run.series.step.length)}`;
    element("time").textContent = `${(player.step * run.dt).toFixed(2)} s`;
    element("speed").value = player.speed;
    element("loop").classList.toggle("on", player.loop);
    element("scrubber").value = player.frame;
  }

  /** Shows how things are drawn. */
  updateLook() {
    const { overlays, path, colour } = this.viewer;
    element("modes").value = colour;
    for (const button of element("overlays").children) button.classList.toggle("on", overlays[button.id]);
    element("follow").classList.toggle("on", path.following);
    element("chase").classList.toggle("on", path.chased >= 0);
    element("more").classList.toggle("on", root.classList.contains("look"));
    element("curves").classList.toggle("on", root.classList.contains("curves"));
    element("legend").replaceChildren(...this.worlds[0].colours.legend().flatMap((row) => this.legendRow(row)));
  }

  legendRow({ background, text, end, wide }) {
    const swatch = make("i");
    swatch.style.background = background;
    swatch.classList.toggle("wide", Boolean(wide));
    return wide ? [make("span", text), swatch, make("span", end)] : [swatch, make("span", text)];
  }

  /** The names of worlds that stand side by side, and what is between them. */
  label(rectangles) {
    if (!this.viewer.isCompared) return;
    const { offsetTop, offsetHeight } = element("scene");
    const place = (node, left, top) => Object.assign(node.style, { left: `${left}px`, top: `${top}px` });
    const names = rectangles.map(({ x, y, width, height }, i) => {
      const name = make("b", this.worlds[i].run.label);
      name.style.borderBottom = `3px solid ${worldColours[i]}`;
      place(name, x + width / 2, offsetTop + y + height - 10);
      return name;
    });
    const line = make("i");
    const [, second] = rectangles;
    place(line, second.x, offsetTop + second.y);
    Object.assign(line.style, second.x > 0 ? { width: "1px", height: `${offsetHeight}px` } : { height: "1px", width: "100%" });
    element("labels").replaceChildren(line, ...names);
  }

  /** Shows what is selected, and what the picture leaves out. */
  showObject() {
    const { selected, isCompared } = this.viewer;
    element("object").hidden = selected < 0;
    if (selected >= 0) {
      element("name").textContent = this.names.of(selected);
      element("facts-of-object").replaceChildren(...rows([["object", whole(this.worlds[0].objects.numberOf(selected))], ...aboutObject(this.worlds[0], selected, isCompared)]));
    }
    element("hint").textContent = isCompared ? differences(this.worlds) : leftOut(this.viewer);
  }
}
