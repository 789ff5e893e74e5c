// SPDX-License-Identifier: MIT
import { Vector3 } from "three";
import { Bodies, SoftBodies } from "./bodies.js";
import { boundsOf, boxOf, fixedState, floorsOf, reaches } from "./boxes.js";
import { Colours } from "./colours.js";
import { BoxOverlay, ContactOverlay, JointOverlay, PairOverlay } from "./overlays.js";
import { Focus } from "./focus.js";
import { Objects } from "./objects.js";
import { frameSecondsOf } from "./player.js";
import { Poses } from "./poses.js";
import { Stage } from "./stage.js";
import { turned } from "./solids.js";
import { Walls } from "./walls.js";

// What does not move and is at least this large, as a share of the scene, counts as a wall.
const wallShare = 0.15;
const mostWalls = 48;

const keyOf = (a, b) => a * 2 ** 26 + b;

/** One world of the page: what is in its scene, brought to any frame. */
export class World {
  constructor({ run, frames }, first, isCompared) {
    this.run = run;
    this.frames = frames;
    this.frameSeconds = frameSecondsOf(run);
    this.poses = new Poses(run, frames);
    this.reaches = reaches(run);
    this.objects = new Objects(run);
    this.movers = run.states.flatMap((state, object) => (state !== fixedState ? [object] : []));
    this.apart = new Float32Array(run.states.length);
    this.shown = null;
    this.build(first, isCompared);
  }

  build(first, isCompared) {
    const { run } = this;
    const everything = boundsOf(run, first);
    this.size = everything.getSize(new Vector3()).length();
    const floors = floorsOf(run, first);
    this.stage = new Stage(everything, floors.length > 0 ? Math.min(...floors) : everything.min.y, floors.length > 0);
    const { scene } = this.stage;
    let walls = 0;
    const isWall = (form, item) => form.kind === "box" && run.states[item.object] === fixedState && Math.max(...item.scale) > wallShare * this.size && (item.wall ??= walls++) < mostWalls;
    this.bodies = new Bodies(run, scene, 3 * this.size, isWall);
    this.soft = new SoftBodies(run, scene);
    this.walls = new Walls(this.bodies, this.poses);
    this.colours = new Colours(run, this.objects, this.crowdSize(), this.frameSeconds, isCompared);
    this.focus = new Focus(run.states.length);
    this.boxLines = new BoxOverlay(run, scene, { colour: 0x2f7fd6, opacity: 0.75 });
    this.selectedBox = new BoxOverlay(run, scene, { colour: 0xe03131, depthTest: false, order: 2 });
    this.pairLines = new PairOverlay(run, scene);
    this.contactMarks = new ContactOverlay(run, scene, this.reaches);
    this.jointLines = new JointOverlay(run, scene);
  }

  crowdSize() {
    const [min, max] = this.run.crowds[0];
    return Math.hypot(...min.map((low, d) => max[d] - low));
  }

  /** [min, max] of the box of an object in a frame; null if it has none, or none with an end. */
  boxIn(frame, object) {
    const [min, max] = [[0, 0, 0], [0, 0, 0]];
    return boxOf(frame, object, this.run, min, max) ? [min, max] : null;
  }

  reachOf(object) {
    return this.reaches[object];
  }

  /** Which of its frames, and how far to the next, shows the time of `player`. */
  positionOf(player) {
    if (player.steps === this.run.frameSteps) return player.position;
    return Math.min(player.seconds / this.frameSeconds + 1e-6, this.frames.count - 1);
  }

  /** Brings the scene to the time of `player`; false while that frame is not unpacked yet. */
  place(player, stale) {
    const position = this.positionOf(player);
    const index = Math.floor(position);
    const frame = this.frames.get(index);
    if (!frame) return false;
    this.isNew = stale || this.shown?.frame !== frame;
    if (this.isNew || this.shown.position !== position) {
      const between = position - index;
      this.poses.set(frame, between > 0 ? this.frames.get(index + 1) : null, between);
      this.bodies.place(this.poses);
      this.soft.place(this.poses);
    }
    this.shown = { frame, position };
    return true;
  }

  /** How far each object is from where it is in `other`, in metres; 0 where both are kept too coarsely to tell. */
  compare(other) {
    const [a, b] = [this.poses.places, other.poses.places];
    const least = this.run.unit + other.run.unit;
    for (let i = 0; i < this.apart.length; ++i) {
      const away = Math.hypot(a[3 * i] - b[3 * i], a[3 * i + 1] - b[3 * i + 1], a[3 * i + 2] - b[3 * i + 2]);
      this.apart[i] = away < least ? 0 : away;
    }
  }

  /** `look`: {overlays, selected, eye}; `other`: the world beside it, if any. */
  paint({ overlays, selected, eye }, other) {
    const { frame } = this.shown;
    const { poses } = this;
    if (this.isNew) {
      this.colours.set({ frame, poses, apart: this.apart });
      this.bodies.paint(this.colours.values);
      this.soft.paint(this.colours.values);
    }
    this.focus.set(frame, poses, this.movers, selected, eye);
    const chosen = (a, b) => selected < 0 || a === selected || b === selected;
    const near = (a, b) => chosen(a, b) && (this.focus.hasPairs(a) || (b >= 0 && this.focus.hasPairs(b)));
    const isSelected = selected >= 0;
    this.boxLines.set(frame, overlays.boxes ? this.movers.filter((object) => this.focus.hasBox(object)) : []);
    this.selectedBox.set(frame, isSelected ? [selected] : []);
    if (overlays.pairs || isSelected) this.pairLines.set(frame, poses, near, this.sharedWith(other));
    else this.pairLines.hide();
    if (overlays.contacts || isSelected) this.contactMarks.set(frame, poses, near);
    else this.contactMarks.hide();
    this.jointLines.set(poses, overlays.joints ? chosen : () => false, turned);
  }

  /** Whether a pair is in the frame of `other` too. */
  sharedWith(other) {
    if (!other) return () => true;
    const keys = new Set();
    const { pairs } = other.shown.frame;
    for (let i = 0; i < pairs.length; i += 2) keys.add(keyOf(pairs[i], pairs[i + 1]));
    return (a, b) => keys.has(keyOf(a, b));
  }

  /** What is in the frame of this world and not in that of `other`. */
  pairsWithout(other) {
    const isShared = this.sharedWith(other);
    const { pairs } = this.shown.frame;
    let count = 0;
    for (let i = 0; i < pairs.length; i += 2) count += isShared(pairs[i], pairs[i + 1]) ? 0 : 1;
    return count;
  }

  meshes() {
    return [...this.bodies.meshes(), ...this.soft.meshes()];
  }

  /** Hides walls that stand in front of everything; true if one came or went. */
  cutAway(eye) {
    return this.shown !== null && this.walls.cutAway(eye, this.movers);
  }
}
