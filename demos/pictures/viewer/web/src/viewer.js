// SPDX-License-Identifier: MIT
import { Box3, Vector3 } from "three";
import { Bodies } from "./bodies.js";
import { Colours } from "./colours.js";
import { Graphs } from "./graphs.js";
import { BoxOverlay, PairOverlay, boxOf } from "./overlays.js";
import { Panel } from "./panel.js";
import { watchClicks } from "./pick.js";
import { Player } from "./player.js";
import { Poses, moods } from "./poses.js";
import { SoftBodies } from "./soft.js";
import { Viewport, crowd } from "./viewport.js";
import { Walls } from "./walls.js";

// What does not move and is at least this large, as a share of the scene, counts as a wall.
const wallShare = 0.15;
const mostWalls = 48;

/** The viewer of one run. */
export class Viewer {
  constructor(run, frames, first, plain) {
    this.run = run;
    this.frames = frames;
    this.player = new Player(run);
    this.colours = new Colours(run);
    this.poses = new Poses(run, frames);
    this.overlays = { boxes: false, pairs: false };
    this.selected = -1;
    this.shown = null;
    const canvas = document.getElementById("scene");
    this.viewport = new Viewport(canvas, plain);
    this.build(first);
    this.panel = new Panel(run, this);
    this.graphs = new Graphs(document.getElementById("graphs"), document.getElementById("lanes"), run, (step) => this.player.goToStep(step));
    this.player.onChange = () => this.panel.update();
    frames.onLoad = () => (this.stale = true);
    watchClicks(canvas, this.viewport.camera, () => [...this.bodies.meshes(), ...this.soft.meshes()], (object) => this.select(object));
    this.viewport.controls.addEventListener("change", () => this.cutAway());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    new ResizeObserver(() => this.graphs.resize()).observe(this.graphs.canvas);
    this.panel.update();
    this.panel.updateLook();
  }

  build(first) {
    const { run, viewport } = this;
    const subjects = this.crowd(first);
    const everything = this.everything(first, subjects);
    this.movers = run.states.flatMap((state, object) => (state !== 0 ? [object] : []));
    const reach = everything.getSize(new Vector3()).length() * 3;
    const wallSize = everything.getSize(new Vector3()).length() * wallShare;
    let walls = 0;
    const isWall = (form, item) => form.kind === "box" && run.states[item.object] === 0 && Math.max(...item.scale) > wallSize && (item.wall ??= walls++) < mostWalls;
    this.bodies = new Bodies(run, viewport.scene, reach, isWall);
    this.soft = new SoftBodies(run, viewport.scene);
    const count = run.states.length;
    this.boxLines = new BoxOverlay(count, viewport.scene, 0x1f4e8c, count > 5000 ? 0.25 : 0.5);
    this.pairLines = new PairOverlay(viewport.scene, 0xc2185b);
    this.selectedBox = new BoxOverlay(1, viewport.scene, 0xd62f2f, 1);
    this.selectedPairs = new PairOverlay(viewport.scene, 0xd62f2f);
    this.walls = new Walls(this.bodies, this.poses);
    const floors = this.floors(first);
    viewport.dress(everything, floors.length > 0 ? Math.min(...floors) : everything.min.y, floors.length > 0);
    this.home = subjects ?? everything;
  }

  /** Heights of the planes that things can stand on. */
  floors(frame) {
    const { forms, parts, unit, rotationUnit } = this.run;
    const upright = ([x, , z]) => Math.abs(x) < 1e-3 && Math.abs(z) < 1e-3;
    const isFloor = ([object, form, , , rotation = [0, 0, 0, 1]]) =>
      forms[form].kind === "plane" && upright(rotation) && upright([...frame.rotations.subarray(4 * object, 4 * object + 3)].map((x) => x * rotationUnit));
    return parts.filter(isFloor).map(([object, , , place = [0, 0, 0]]) => unit * frame.places[3 * object + 1] + place[1]);
  }

  /** Boxes of what is in the world and has an end: of what moves, or of everything. */
  boxes(frame, all) {
    const min = [0, 0, 0];
    const max = [0, 0, 0];
    const result = [];
    for (let object = 0; object < frame.moods.length; ++object)
      if ((all || frame.moods[object] !== 0) && boxOf(frame, object, this.run.unit, min, max))
        result.push(new Box3(new Vector3().fromArray(min), new Vector3().fromArray(max)));
    return result;
  }

  crowd(frame) {
    return crowd(this.boxes(frame, false));
  }

  everything(frame, subjects) {
    const all = new Box3();
    for (const box of this.boxes(frame, true)) all.union(box);
    if (subjects) all.union(subjects);
    if (all.isEmpty()) all.set(new Vector3(-1, 0, -1), new Vector3(1, 1, 1));
    return all;
  }

  /** The view that the page opens with: room for the beginning and for the end. */
  async open() {
    const last = await this.frames.load(this.frames.count - 1);
    const end = this.crowd(last);
    if (end) this.home = this.home.clone().union(end);
    this.resize();
    this.viewport.frame(this.home, true);
  }

  frameAll() {
    const frame = this.shown?.frame;
    this.viewport.frame((frame && this.crowd(frame)) ?? this.home, false);
  }

  resize() {
    const { clientWidth, clientHeight } = this.viewport.renderer.domElement.parentElement;
    this.viewport.resize(clientWidth, clientHeight);
  }

  setColour(mode) {
    this.colours.mode = mode;
    this.panel.updateLook();
    this.stale = true;
  }

  setOverlay(name, on) {
    this.overlays[name] = on;
    this.panel.updateLook();
    this.stale = true;
  }

  select(object) {
    this.selected = object;
    this.stale = true;
  }

  /** Once for each picture of the display. */
  tick(seconds) {
    const { player, frames } = this;
    const next = player.frame + 1;
    player.tick(seconds, frames.get(Math.min(next, player.last)) ? player.last : player.frame);
    frames.foresee(player.frame);
    this.show();
    this.viewport.draw();
  }

  /** Is what there is to see on the canvas? */
  get isSettled() {
    return !this.stale && this.shown?.position === this.player.position && !this.viewport.dirty && this.viewport.drawn > 0;
  }

  /** Brings the scene to where the player is, as soon as that frame is unpacked. */
  show() {
    const { player, shown } = this;
    if (!this.stale && shown?.position === player.position) return;
    const frame = this.frames.get(player.frame);
    if (!frame) return;
    const isNew = this.stale || shown?.frame !== frame;
    const between = player.position - player.frame;
    this.poses.set(frame, between > 0 ? this.frames.get(player.frame + 1) : null, between);
    this.bodies.place(this.poses);
    this.soft.place(this.poses);
    if (isNew) this.paint(frame);
    this.showPairs(frame);
    this.shown = { frame, position: player.position };
    this.stale = false;
    if (isNew) this.graphs.mark(player.step);
    this.cutAway();
    this.viewport.moved();
  }

  paint(frame) {
    this.colours.set(frame);
    this.bodies.paint(this.colours.values);
    this.soft.paint(this.colours.values);
    this.boxLines.lines.visible = this.overlays.boxes;
    if (this.overlays.boxes) this.boxLines.set(frame, this.run.unit);
    this.selectedBox.lines.visible = this.selected >= 0;
    if (this.selected >= 0) this.selectedBox.set(frame, this.run.unit, () => this.selected);
    this.panel.showObject(this.selected >= 0 ? this.aboutObject(frame, this.selected) : null);
  }

  showPairs(frame) {
    this.pairLines.lines.visible = this.overlays.pairs;
    if (this.overlays.pairs) this.pairLines.set(frame, this.poses, this.run.unit);
    this.selectedPairs.lines.visible = this.selected >= 0;
    if (this.selected >= 0) this.selectedPairs.set(frame, this.poses, this.run.unit, this.selected);
  }

  aboutObject(frame, object) {
    const { colours, poses } = this;
    const tag = frame.islands[object];
    const place = [...poses.places.subarray(3 * object, 3 * object + 3)].map((x) => x.toFixed(2)).join(", ");
    return [
      ["object", object.toLocaleString("en")],
      ["kind", colours.kinds[object]],
      ["state", moods[frame.moods[object]]],
      ["place", place],
      ["island", tag < 0 ? "none" : `${colours.islandSize[tag].toLocaleString("en")} objects`],
      ["candidate pairs", colours.pairsOf[object].toLocaleString("en")],
    ];
  }

  cutAway() {
    if (this.shown && this.walls.cutAway(this.viewport.camera.position, this.movers)) this.viewport.moved();
  }
}
