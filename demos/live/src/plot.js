// SPDX-License-Identifier: MIT
// Milliseconds a frame over the last seconds, on a logarithmic axis.
import { span } from "./history.js";
import { duration } from "./words.js";

const left = 52;
const bottom = 18;
const top = 6;
export const budget = 1000 / 60;

export class Plot {
  /** `lines`: {name: {dots}}; their colours are CSS variables, so that themes decide. */
  constructor(canvas, history, lines) {
    Object.assign(this, { canvas, history, lines });
    this.range = [-1, 2];
    canvas.addEventListener("pointermove", (event) => (this.hover = event.offsetX));
    for (const end of ["pointerleave", "pointercancel"]) canvas.addEventListener(end, () => (this.hover = undefined));
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  resize() {
    const ratio = window.devicePixelRatio;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
  }

  /** Powers of ten around all that is to be seen, and around the budget of a frame. */
  fit() {
    const values = [...this.history.series.values()].flatMap((list) => list.map(([, time]) => time)).filter((time) => time > 0);
    const least = Math.min(2, ...values);
    const most = Math.max(30, ...values);
    this.range = [Math.max(-2, Math.floor(Math.log10(least))), Math.ceil(Math.log10(most))];
  }

  draw(now) {
    const { canvas } = this;
    const ratio = window.devicePixelRatio;
    this.width = canvas.width / ratio - left - 4;
    this.height = canvas.height / ratio - top - bottom;
    if (this.width < 20) return;
    this.fit();
    this.style = getComputedStyle(canvas);
    this.context = canvas.getContext("2d");
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, canvas.width, canvas.height);
    this.axes();
    for (const [name, { dots }] of Object.entries(this.lines)) this.line(name, dots, now);
    if (this.hover >= left) this.values(now);
  }

  x(when, now) {
    return left + this.width * (1 - (now - when) / span);
  }
  y(ms) {
    const [low, high] = this.range;
    return top + this.height * (1 - (Math.log10(Math.max(ms, 1e-4)) - low) / (high - low));
  }
  colour(name) {
    return this.style.getPropertyValue(name);
  }

  axes() {
    const { context } = this;
    const at60 = this.y(budget);
    context.fillStyle = this.colour("--good-area");
    context.fillRect(left, at60, this.width, top + this.height - at60);
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.textAlign = "right";
    for (let power = this.range[0]; power <= this.range[1]; ++power) this.tick(10 ** power);
    context.textAlign = "left";
    context.fillStyle = this.colour("--good");
    context.fillText("60 frames a second", left + 6, at60 + 9);
    context.fillStyle = this.colour("--quiet");
    context.textAlign = "center";
    for (let seconds = 0; seconds < span / 1000; seconds += 5) {
      context.textAlign = seconds === 0 ? "right" : "center";
      context.fillText(seconds === 0 ? "now" : `${seconds} s ago`, this.x(-1000 * seconds, 0), top + this.height + 11);
    }
  }

  tick(ms) {
    const { context } = this;
    const y = Math.round(this.y(ms)) + 0.5;
    context.fillStyle = this.colour("--line");
    context.fillRect(left, y - 0.5, this.width, 1);
    context.fillStyle = this.colour("--quiet");
    context.fillText(ms >= 1000 ? `${ms / 1000} s` : `${Number(ms.toPrecision(1))} ms`, left - 6, y);
  }

  line(name, dots, now) {
    const { context } = this;
    context.strokeStyle = context.fillStyle = this.colour(`--${name.replace(" ", "-")}`);
    context.lineWidth = 1.5;
    context.save();
    context.beginPath();
    context.rect(left, 0, this.width, top + this.height);
    context.clip();
    context.beginPath();
    const list = this.history.series.get(name);
    for (const [when, ms] of list) context.lineTo(this.x(when, now), this.y(ms));
    context.stroke();
    if (dots) for (const [when, ms] of list) context.fillRect(this.x(when, now) - 2, this.y(ms) - 2, 4, 4);
    context.restore();
  }

  /** What the lines are where the pointer is. */
  values(now) {
    const { context } = this;
    const when = now - span * (1 - (this.hover - left) / this.width);
    const rows = Object.keys(this.lines).flatMap((name) => {
      const [at, ms] = this.history.series.get(name).findLast(([time]) => time <= when) ?? [];
      return ms === undefined || when - at > 6000 ? [] : [[name, duration(ms)]];
    });
    context.fillStyle = this.colour("--quiet");
    context.fillRect(this.hover, top, 1, this.height);
    if (rows.length === 0) return;
    const width = 150;
    const x = this.hover + width + 12 < left + this.width ? this.hover + 8 : this.hover - width - 8;
    context.fillStyle = this.colour("--card");
    context.fillRect(x, top, width, 16 * rows.length + 8);
    rows.forEach(([name, text], i) => {
      context.fillStyle = this.colour(`--${name}`);
      context.textAlign = "left";
      context.fillText(name, x + 8, top + 12 + 16 * i);
      context.textAlign = "right";
      context.fillText(text, x + width - 8, top + 12 + 16 * i);
    });
  }
}
