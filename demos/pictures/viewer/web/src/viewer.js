// SPDX-License-Identifier: MIT
import { CameraPath } from "./camera_path.js";
import { Graphs } from "./graphs.js";
import { Panel } from "./panel.js";
import { Viewport, watchClicks } from "./viewport.js";
import { Player } from "./player.js";
import { Theme } from "./dom.js";
import { World } from "./world.js";

/** The viewer of a run: one world, or two at the same time of theirs, seen from the same place. */
export class Viewer {
  constructor(parts, first, plain) {
    const canvas = document.getElementById("scene");
    this.theme = new Theme();
    this.viewport = new Viewport(canvas, plain);
    this.worlds = parts.map((part, i) => new World(part, first[i], parts.length > 1));
    this.player = new Player(this.worlds[0].run);
    this.overlays = { boxes: false, pairs: false, contacts: false, joints: true };
    this.selected = -1;
    this.stale = true;
    for (const world of this.worlds) this.viewport.add(world.stage);
    this.viewport.reach(Math.max(...this.worlds.map((world) => world.size)));
    this.path = new CameraPath(this.viewport, this.worlds);
    this.panel = new Panel(this);
    this.graphs = new Graphs(document.getElementById("graphs"), this.worlds, this.theme, (step) => this.player.goToStep(step));
    this.player.onChange = () => this.panel.update();
    for (const { frames } of this.worlds) frames.onLoad = () => (this.stale = true);
    watchClicks(this.viewport, () => this.worlds.map((world) => world.meshes()), (object) => this.select(object));
    this.viewport.controls.addEventListener("change", () => this.turned());
    this.theme.onChange = () => this.paintStages();
    this.paintStages();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
    this.panel.update();
    if (this.isCompared) this.setColour("difference");
    this.panel.updateLook();
  }

  get isCompared() {
    return this.worlds.length > 1;
  }
  get colour() {
    return this.worlds[0].colours.mode;
  }
  get modes() {
    return this.worlds[0].colours.modes;
  }

  paintStages() {
    for (const world of this.worlds) {
      world.stage.paint(this.theme.colours);
      world.colours.setGround(this.theme.colours.ground);
    }
    this.graphs.repaint();
    this.stale = true;
    this.viewport.changed();
  }

  resize() {
    const { clientWidth, clientHeight } = this.viewport.canvas;
    this.viewport.resize(clientWidth, clientHeight);
    this.panel.label(this.viewport.rectangles);
  }

  setColour(mode) {
    for (const world of this.worlds) world.colours.mode = mode;
    this.refresh();
  }

  setOverlay(name, on) {
    this.overlays[name] = on;
    this.refresh();
  }

  select(object) {
    this.selected = object;
    if (object < 0) this.path.chased = -1;
    this.refresh();
  }

  chase(object) {
    this.path.chase(object, this.player);
    this.panel.updateLook();
  }

  follow(on) {
    this.path.following = on;
    this.panel.updateLook();
  }

  refresh() {
    this.panel.updateLook();
    this.stale = true;
  }

  /** The camera has moved: the nearest bodies may be others, and walls in the way. */
  turned() {
    if (this.overlays.boxes || this.overlays.pairs || this.overlays.contacts) this.isTurned = true;
    this.cutAway();
  }

  /** Once for each picture of the display. */
  tick(seconds) {
    const { player } = this;
    const next = Math.min(player.frame + 1, player.last);
    player.tick(seconds, this.worlds.every((world) => world.frames.get(Math.min(next, world.frames.count - 1))) ? player.last : player.frame);
    for (const world of this.worlds) world.frames.foresee(Math.floor(world.positionOf(player)));
    this.show();
    this.viewport.draw();
    if (this.isSettled && !this.isOpen) performance.mark("first picture");
    this.isOpen ||= this.isSettled;
  }

  /** Is what there is to see on the canvas? */
  get isSettled() {
    return !this.stale && !this.isTurned && this.shown === this.player.position && !this.viewport.dirty && this.viewport.drawn > 0;
  }

  /** Brings the scenes to where the player is, as soon as those frames are unpacked. */
  show() {
    const { player, worlds } = this;
    if (!this.stale && this.shown === player.position && !this.isTurned) return;
    if (!worlds.every((world) => world.place(player, this.stale))) return;
    if (this.isCompared) worlds.forEach((world, i) => world.compare(worlds[1 - i]));
    if (this.shown !== player.position) this.path.advance(player);
    const look = { overlays: this.overlays, selected: this.selected, eye: this.viewport.camera.position };
    worlds.forEach((world, i) => world.paint(look, this.isCompared ? worlds[1 - i] : null));
    this.shown = player.position;
    this.stale = this.isTurned = false;
    this.graphs.mark(player.step);
    this.panel.showObject();
    this.cutAway();
    this.viewport.moved();
  }

  cutAway() {
    for (const world of this.worlds) if (world.cutAway(this.viewport.camera.position)) this.viewport.moved();
  }
}
