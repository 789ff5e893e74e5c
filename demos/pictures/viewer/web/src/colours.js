// SPDX-License-Identifier: MIT
import { Color } from "three";
import { moods } from "./poses.js";

const linear = (hex) => new Color(hex).toArray();
const css = (hex) => `#${hex.toString(16).padStart(6, "0")}`;

// Bodies run through these in order of creation, so that mixing shows.
const creation = [0x215c8f, 0x299c8f, 0xedc46b, 0xf08c4d, 0xdb4d42];
const kinds = { box: 0x3b7dd8, sphere: 0xe8833a, capsule: 0x3aa76d, cylinder: 0x9a6ad6, cone: 0xd6567d, triangles: 0x8c7a5b, plane: 0xe6e9ec, compound: 0x4bb3c4, soft: 0xe05252 };
const special = { fixed: 0xc6c6c3, kinematic: 0x4d545f, sensor: 0x1a9e73, character: 0xd6263d };
const sleep = { moving: 0xf08c4d, sleeping: 0x4a6fa5 };
// Few to many pairs.
const heat = [0xb4c3d8, 0x4a7fc0, 0x49b0a6, 0xf2d35e, 0xf28c38, 0xd62f2f];
const mostPairs = 12;
const alone = 0xa9afb8;

function onRamp(ramp, t) {
  const at = Math.min(Math.max(t, 0), 0.9999) * (ramp.length - 1);
  const low = Math.floor(at);
  return new Color(ramp[low]).lerp(new Color(ramp[low + 1]), at - low).toArray();
}

/** Far apart for numbers that are near each other. */
const islandColour = (tag) => new Color().setHSL((tag * 0.61803398875) % 1, 0.58, 0.4 + 0.2 * ((tag * 0.7548776662) % 1)).toArray();

/** One row of a legend: a colour or a ramp, and what it stands for. */
const row = (hex, text) => ({ background: css(hex), text });
const ramp = (colours, from, to) => ({ background: `linear-gradient(90deg, ${colours.map(css).join(", ")})`, wide: true, text: from, end: to });

/** The kind of each object, for colours and for words: that of its form, "compound" or "soft". */
export function kindsOf(run) {
  const names = new Array(run.states.length).fill("");
  for (const [object, form] of run.parts) names[object] = names[object] ? "compound" : run.forms[form].kind;
  for (const part of run.softParts) names[part.object] = "soft";
  return names;
}

/** Colours of all objects, three numbers each, in the mode chosen. */
export class Colours {
  constructor(run) {
    this.count = run.states.length;
    this.first = run.states.map((state) => ["fixed", "kinematic", "moving", "sleeping", "soft", "sensor", "character"][state]);
    this.kinds = kindsOf(run);
    this.values = new Float32Array(3 * this.count);
    this.pairsOf = new Uint16Array(this.count);
    this.islandSize = new Uint32Array(this.count);
    this.modes = {
      created: { title: "Created", of: this.created(), legend: () => [ramp(creation, "first", "last")] },
      kind: { title: "Kind", of: this.fixedColours((i) => linear(kinds[this.kinds[i]])), legend: () => this.kindLegend() },
      island: { title: "Island", of: (i, frame) => this.island(i, frame), legend: () => [row(alone, "alone"), { background: "conic-gradient(#d6567d, #edc46b, #3aa76d, #3b7dd8, #9a6ad6, #d6567d)", text: "one colour for each island" }] },
      asleep: { title: "Asleep", of: (i, frame) => this.asleep(i, frame), legend: () => [row(sleep.moving, "awake"), row(sleep.sleeping, "asleep"), row(special.fixed, "fixed")] },
      pairs: { title: "Pairs", of: (i) => this.heatOf(i), legend: () => [ramp(heat, "0", `${mostPairs} or more candidate pairs`)] },
    };
    this.heat = Array.from({ length: mostPairs + 1 }, (_, i) => onRamp(heat, i / mostPairs));
    this.moodColours = moods.map((mood) => linear(sleep[mood] ?? special[mood] ?? sleep.moving));
    this.alone = linear(alone);
    this.fixed = linear(special.fixed);
    this.plane = linear(kinds.plane);
    this.mode = "created";
  }

  fixedColours(of) {
    const all = Array.from({ length: this.count }, (_, i) => of(i));
    return (i) => all[i];
  }

  created() {
    return this.fixedColours((i) => {
      if (special[this.first[i]]) return linear(this.kinds[i] === "plane" ? kinds.plane : special[this.first[i]]);
      // A little light and dark keeps neighbours apart.
      const shade = 0.06 * (Math.imul(i, 2654435761) >>> 30) - 0.09;
      return new Color().fromArray(onRamp(creation, i / this.count)).lerp(new Color(shade > 0 ? 0xffffff : 0), Math.abs(shade)).toArray();
    });
  }

  island(i, frame) {
    const tag = frame.islands[i];
    if (tag < 0) return this.kinds[i] === "plane" ? this.plane : this.fixed;
    return this.islandSize[tag] > 1 ? islandColour(tag) : this.alone;
  }

  heatOf(i) {
    if (this.kinds[i] === "plane") return this.plane;
    return this.first[i] === "fixed" ? this.fixed : this.heat[Math.min(this.pairsOf[i], mostPairs)];
  }

  asleep(i, frame) {
    return this.kinds[i] === "plane" ? this.plane : this.moodColours[frame.moods[i]];
  }

  kindLegend() {
    return [...new Set(this.kinds)].filter((kind) => kind).map((kind) => row(kinds[kind], kind === "triangles" ? "hull or mesh" : kind));
  }

  /** Counts what the modes are about. */
  tally(frame) {
    this.pairsOf.fill(0);
    for (const object of frame.pairs) ++this.pairsOf[object];
    this.islandSize.fill(0);
    for (const tag of frame.islands) if (tag >= 0) ++this.islandSize[tag];
  }

  set(frame) {
    this.tally(frame);
    const { of } = this.modes[this.mode];
    for (let i = 0; i < this.count; ++i) {
      const colour = of(i, frame);
      this.values[3 * i] = colour[0];
      this.values[3 * i + 1] = colour[1];
      this.values[3 * i + 2] = colour[2];
    }
  }

  legend() {
    return this.modes[this.mode].legend();
  }
}
