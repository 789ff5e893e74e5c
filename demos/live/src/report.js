// SPDX-License-Identifier: MIT
// What the page says about frames and checks.
import { element } from "./panel.js";
import { budget } from "./plot.js";
import { count, duration, figure, median } from "./words.js";

const several = (number, what) => `${count(number)} ${what}${number === 1 ? "" : "s"}`;

/** Numbers in the corner, of the last half second, so that they can be read. */
export class Report {
  constructor() {
    this.frames = [];
    this.last = 0;
  }

  clear() {
    this.frames.length = 0;
  }

  add(frame, now) {
    this.frames.push({ ...frame.times, pairs: frame.pairs, now });
    while (this.frames.length > 2 && this.frames[0].now < now - 1000) this.frames.shift();
  }

  /** Frames a second over the last second, or since the frame before the last. */
  rate(now) {
    const { length, 0: first } = this.frames;
    return length > 1 ? (1000 * (length - 1)) / (now - first.now) : 0;
  }

  show(now, { n, engine }) {
    if (now - this.last < 250 || this.frames.length === 0) return;
    this.last = now;
    const of = (name) => median(this.frames.map((frame) => frame[name]).filter((time) => time !== undefined)) ?? 0;
    const [motion, search, marking] = [of("motion"), of(engine), of("marking")];
    element("boxes").textContent = count(n);
    element("pairs").textContent = count(this.frames.at(-1).pairs);
    element("search").textContent = duration(search);
    element("rate").textContent = figure(this.rate(now));
    element("budgettext").textContent = `A step in the worker: motion ${motion.toFixed(1)} + pairs ${search.toFixed(1)} + marking ${marking.toFixed(1)} of ${budget.toFixed(1)} ms`;
    for (const [id, time] of Object.entries({ barmotion: motion, barsearch: search, barmarking: marking })) element(id).style.width = `${Math.min(100, (100 * time) / budget)}%`;
    element("barsearch").dataset.engine = engine;
  }
}

function say(state, text) {
  element("check").dataset.state = state;
  element("checked").textContent = text;
}

export function sayChecked({ name, frame, pairs, missing, extra }) {
  if (missing + extra === 0) say("equal", `Frame ${count(frame)}: the same ${several(pairs, "pair")} by ${name}`);
  else say("wrong", `Frame ${count(frame)}: ${count(missing)} missing, ${count(extra)} too many, beside ${name}`);
}
export const sayWaiting = () => say("waiting", "The first check is under way");
export const sayUnchecked = () => say("unchecked", "Not checked: no package finds these pairs within 5 seconds");

/** A wrong pair, as loud as can be. */
export function showAlarm({ name, frame, missing, extra, first, spoiled, seed, n, input, motion, engine }) {
  element("alarmtitle").textContent = spoiled ? "The planted pair was noticed" : "The pairs are wrong";
  const what = `Frame ${count(frame)}: ${several(missing, "pair")} missing and ${count(extra)} too many beside ${name}, the first of boxes ${first.map(count).join(" and ")}.`;
  element("alarmtext").textContent = spoiled ? `${what} One pair was taken away on purpose, if there was one, and one put in whose boxes do not touch.` : `${what} Please report it: input ${input}, ${count(n)} boxes, motion ${motion}, ${engine}, seed ${seed}.`;
  element("alarm").hidden = false;
}

export function showFailure(message) {
  element("alarmtitle").textContent = "It stopped";
  element("alarmtext").textContent = `${message}. Fewer or smaller boxes, or findPairs, may help.`;
  element("alarm").hidden = false;
}

export function showObject(selected, frame) {
  element("object").hidden = selected < 0;
  if (selected < 0) return;
  const list = frame.partners.slice(0, 8).map(count).join(", ");
  const more = frame.partners.length > 8 ? " \u2026" : "";
  element("object").textContent = `Box ${count(selected)} touches ${frame.partners.length === 0 ? "nothing" : `${several(frame.partners.length, "box").replace("boxs", "boxes")}: ${list}${more}`}`;
}
