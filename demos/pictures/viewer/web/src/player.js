// SPDX-License-Identifier: MIT

export const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8];

// A browser that draws slowly shows slow motion rather than leaps.
const longestTick = 0.1;

export const frameSecondsOf = (run) => (run.frameSteps.length > 1 ? run.dt * (run.frameSteps[1] - run.frameSteps[0]) : run.dt);

/** Where in the run we are: `position` counts frames, and stands between two of them while the run plays slowly. */
export class Player {
  constructor(run) {
    this.steps = run.frameSteps;
    this.last = run.frameSteps.length - 1;
    this.frameSeconds = frameSecondsOf(run);
    this.position = 0;
    this.speed = 1;
    this.playing = false;
    this.loop = false;
    this.onChange = () => {};
  }

  get frame() {
    return Math.floor(this.position);
  }
  get step() {
    return this.steps[this.frame];
  }
  get seconds() {
    return this.position * this.frameSeconds;
  }

  /** `seconds` have passed. `limit`: the last frame that could be shown. */
  tick(seconds, limit) {
    if (!this.playing) return;
    const wanted = this.position + (Math.min(seconds, longestTick) * this.speed) / this.frameSeconds;
    this.position = Math.max(this.position, Math.min(wanted, limit, this.last));
    if (this.position >= this.last) {
      if (this.loop) this.position = 0;
      else this.playing = false;
    }
    this.onChange();
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.position >= this.last) this.position = 0;
    if (!this.playing) this.position = this.frame;
    this.onChange();
  }

  /** To a frame, and stay there unless the run was playing. */
  go(frame) {
    this.position = Math.min(Math.max(Math.round(frame), 0), this.last);
    this.onChange();
  }

  /** To the frame nearest to a step. */
  goToStep(step) {
    const interval = this.last > 0 ? this.steps[1] - this.steps[0] : 1;
    this.go(step / interval);
  }

  move(frames) {
    this.playing = false;
    this.go(this.frame + frames);
  }

  faster(by) {
    const now = speeds.indexOf(this.speed);
    this.speed = speeds[Math.min(Math.max(now + by, 0), speeds.length - 1)];
    this.onChange();
  }
}
