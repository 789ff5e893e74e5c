// SPDX-License-Identifier: MIT
import { peers } from "./settings.js";
import { startWorker } from "./workers.js";

const longest = 5000; // ms that a method may take for a frame
const mostForBruteForce = 10_000; // boxes; nothing can be wrong with it
const checkEvery = 1000;
const pause = 100; // between jobs, so that quick ones do not crowd the plot

/** Who is to find the pairs of which frame once more. At most one of them is at work. */
export class Beside {
  /** `onResult`: gets {name, time, frame, missing, extra, first, ...}; `onGivenUp`: a name. */
  constructor(onResult, onGivenUp) {
    this.onResult = onResult;
    this.onGivenUp = onGivenUp;
    this.free = 0;
    this.turn = 0;
    this.reset();
  }

  /** Other boxes: what is at work is for nothing. */
  reset() {
    this.hurry();
    this.forgive();
    if (this.job || !this.worker) this.restart();
  }

  /** The next frame is checked. */
  hurry() {
    this.lastCheck = -Infinity;
  }

  /** Who was too slow may try again. */
  forgive() {
    this.givenUp = new Set();
  }

  restart() {
    this.worker?.terminate();
    this.worker = startWorker("beside", (result) => this.receive(result));
    clearTimeout(this.alarm);
    this.job = null;
  }

  /** Who finds the pairs to compare with; undefined if all are too slow. */
  checker(n) {
    return n <= mostForBruteForce ? "brute force" : peers.find((name) => !this.givenUp.has(name));
  }

  /** The method whose turn it is, or undefined. */
  next(now, n, racing) {
    if (this.job || now < this.free) return undefined;
    if (now - this.lastCheck >= checkEvery) return this.checker(n);
    const willing = racing.filter((name) => !this.givenUp.has(name));
    return willing[this.turn % Math.max(1, willing.length)];
  }

  /** Starts a job on a snapshot of a frame. `about` comes back with the result. */
  start(name, snapshot, about) {
    const now = performance.now();
    if (now - this.lastCheck >= checkEvery) this.lastCheck = now;
    else ++this.turn;
    this.job = { name, about };
    this.alarm = setTimeout(() => this.giveUp(), longest);
    this.worker.postMessage({ name, ...snapshot }, [snapshot.boxes.buffer, snapshot.pairs.buffer]);
  }

  giveUp() {
    const { name } = this.job;
    this.givenUp.add(name);
    this.restart();
    this.onGivenUp(name);
  }

  receive(result) {
    if (result.failed) return this.giveUp();
    clearTimeout(this.alarm);
    const about = this.job?.about;
    this.job = null;
    this.free = performance.now() + pause;
    this.onResult({ ...result, ...about });
  }
}
