// SPDX-License-Identifier: MIT
import { Color } from "three";
import { moods, velocityOf } from "./poses.js";
import { figure } from "./words.js";

const linear = (hex) => new Color(hex).toArray();
const css = (hex) => `#${hex.toString(16).padStart(6, "0")}`;

// Bodies run through these in order of creation, so that mixing shows.
const creation = [0x215c8f, 0x299c8f, 0xedc46b, 0xf08c4d, 0xdb4d42];
const kinds = { box: 0x3b7dd8, sphere: 0xe8833a, capsule: 0x3aa76d, cylinder: 0x9a6ad6, cone: 0xd6567d, triangles: 0x8c7a5b, plane: 0xe6e9ec, compound: 0x4bb3c4, soft: 0xe05252 };
const special = { fixed: 0xb9bab8, kinematic: 0x4d545f, sensor: 0x1a9e73, character: 0xd6263d, wheel: 0x3a3f47 };
const sleep = { moving: 0xf08c4d, sleeping: 0x4a6fa5 };
// Little to much.
const heat = [0xb4c3d8, 0x4a7fc0, 0x49b0a6, 0xf2d35e, 0xf28c38, 0xd62f2f];
const shades = 64;
const most = { contacts: 12, pairs: 12, idle: 8 };
const alone = 0xa9afb8;
const aloneColour = linear(alone);

function onRamp(ramp, t) {
  const at = Math.min(Math.max(t, 0), 0.9999) * (ramp.length - 1);
  const low = Math.floor(at);
  return new Color(ramp[low]).lerp(new Color(ramp[low + 1]), at - low).toArray();
}

/** Far apart for numbers that are near each other. */
const islandColour = (tag) => new Color().setHSL((tag * 0.61803398875) % 1, 0.58, 0.4 + 0.2 * ((tag * 0.7548776662) % 1)).toArray();

/** 1, 2 or 5 times a power of ten, at most `value`. */
function rounded(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [5, 2, 1].find((digit) => digit * power <= value * 1.0001);
}

/** One row of a legend: a colour or a ramp, and what it stands for. */
const row = (hex, text) => ({ background: css(hex), text });
const ramp = (colours, from, to) => ({ background: `linear-gradient(90deg, ${colours.map(css).join(", ")})`, wide: true, text: from, end: to });

/** The kind of each object, for colours and for words: that of its form, "compound" or "soft". */
function kindsOf(run) {
  const names = new Array(run.states.length).fill("");
  for (const [object, form] of run.parts) names[object] = names[object] ? "compound" : run.forms[form].kind;
  for (const part of run.softParts) names[part.object] = "soft";
  return names;
}

/** Colours of all objects, three numbers each, in the mode chosen. `size`: of what there is to see; `seconds` from frame to frame. */
export class Colours {
  constructor(run, objects, size, seconds, isCompared) {
    this.run = run;
    this.objects = objects;
    this.seconds = seconds;
    this.count = run.states.length;
    this.first = run.states.map((state) => ["fixed", "kinematic", "moving", "sleeping", "soft", "sensor", "character", "wheel"][state]);
    this.kinds = kindsOf(run);
    this.values = new Float32Array(3 * this.count);
    this.pairsOf = new Uint16Array(this.count);
    this.touchesOf = new Uint16Array(this.count);
    this.islandSize = new Uint32Array(this.count);
    this.fastest = rounded(size / 2.5);
    this.furthest = rounded(size / 20);
    this.heat = Array.from({ length: shades }, (_, i) => onRamp(heat, i / (shades - 1)));
    this.moodColours = moods.map((mood) => linear(sleep[mood] ?? special[mood] ?? sleep.moving));
    this.plane = linear(kinds.plane); // of the ground, once the page says so
    this.still = this.first.map((state, i) => (this.kinds[i] === "plane" ? this.plane : special[state] && state !== "kinematic" && state !== "character" ? linear(special[state]) : null));
    this.modes = this.allModes();
    if (!isCompared) delete this.modes.difference;
    this.mode = "created";
  }

  allModes() {
    const counted = (name) => [ramp(heat, "0", `${most[name]} or more${this.objects.amongThese}`)];
    const scale = (end, unit) => [ramp(heat, "0", `${figure(end)} ${unit}`)];
    return {
      created: { title: "order of creation", of: this.created(), legend: () => [ramp(creation, "first", "last")] },
      kind: { title: "kind of shape", of: this.fixedColours((i) => (this.kinds[i] === "plane" ? this.plane : linear(this.first[i] === "wheel" ? special.wheel : kinds[this.kinds[i]]))), legend: () => this.kindLegend() },
      island: { title: "island", of: (i, { frame }) => this.island(i, frame), legend: () => [row(alone, "alone"), { background: "conic-gradient(#d6567d, #edc46b, #3aa76d, #3b7dd8, #9a6ad6, #d6567d)", text: `one colour for each island${this.objects.amongThese}` }] },
      asleep: { title: "asleep or awake", of: (i, { frame }) => this.still[i] ?? this.moodColours[frame.moods[i]], legend: () => [row(sleep.moving, "awake"), row(sleep.sleeping, "asleep"), row(special.fixed, "fixed")] },
      speed: { title: "speed", of: (i, { frame, poses }) => this.onHeat(i, Math.sqrt(Math.hypot(...velocityOf(frame, i, poses.unit, this.seconds)) / this.fastest)), legend: () => scale(this.fastest, "m/s (square root)") },
      contacts: { title: "bodies that it touches", of: (i) => this.onHeat(i, this.touchesOf[i] / most.contacts), legend: () => counted("contacts") },
      pairs: { title: "candidate pairs", of: (i) => this.onHeat(i, this.pairsOf[i] / most.pairs), legend: () => counted("pairs") },
      idle: { title: "candidates that do not touch", of: (i) => this.onHeat(i, (this.pairsOf[i] - this.touchesOf[i]) / most.idle), legend: () => counted("idle") },
      difference: { title: "distance from the other run", of: (i, { apart }) => this.onHeat(i, Math.sqrt(apart[i] / this.furthest)), legend: () => scale(this.furthest, "m (square root)") },
    };
  }

  /** Floors look like the ground around them. */
  setGround(css) {
    new Color(css).toArray(this.plane);
  }

  onHeat(i, t) {
    return this.still[i] ?? this.heat[Math.round(Math.min(Math.max(t, 0), 1) * (shades - 1))];
  }

  fixedColours(of) {
    const all = Array.from({ length: this.count }, (_, i) => of(i));
    return (i) => all[i];
  }

  created() {
    return this.fixedColours((i) => {
      if (this.kinds[i] === "plane") return this.plane;
      if (special[this.first[i]]) return linear(special[this.first[i]]);
      // A little light and dark keeps neighbours apart.
      const shade = 0.06 * (Math.imul(i, 2654435761) >>> 30) - 0.09;
      return new Color().fromArray(onRamp(creation, i / this.count)).lerp(new Color(shade > 0 ? 0xffffff : 0), Math.abs(shade)).toArray();
    });
  }

  island(i, frame) {
    const tag = frame.islands[i];
    if (tag < 0) return this.still[i] ?? aloneColour;
    return this.islandSize[tag] > 1 ? islandColour(tag) : aloneColour;
  }

  kindLegend() {
    return [...new Set(this.kinds)].filter((kind) => kind).map((kind) => row(kinds[kind], kind === "triangles" ? "hull or mesh" : kind));
  }

  /** Counts what the modes are about. */
  tally(frame) {
    this.pairsOf.fill(0);
    this.touchesOf.fill(0);
    frame.pairs.forEach((object, i) => {
      ++this.pairsOf[object];
      this.touchesOf[object] += frame.touching[i >> 1];
    });
    this.islandSize.fill(0);
    for (const tag of frame.islands) if (tag >= 0) ++this.islandSize[tag];
  }

  /** `moment`: {frame, poses, apart}, the last one how far each object is from itself in the other world. */
  set(moment) {
    this.tally(moment.frame);
    const { of } = this.modes[this.mode];
    for (let i = 0; i < this.count; ++i) this.values.set(of(i, moment), 3 * i);
  }

  legend() {
    return this.modes[this.mode].legend();
  }
}
