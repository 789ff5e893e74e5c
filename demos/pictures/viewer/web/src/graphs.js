// SPDX-License-Identifier: MIT

const lanes = [
  { title: "Candidate pairs", series: ["pairs"], colours: ["#1d6fb8"], unit: "" },
  { title: "Broad-phase", series: ["broadphase"], colours: ["#12805c"], unit: " ms" },
  { title: "Whole step", series: ["step"], colours: ["#c2571a"], unit: " ms" },
];
const gap = 7;

const short = (value, unit) => (unit ? value.toPrecision(3) : Math.round(value).toLocaleString("en")) + unit;

/** What nearly all values stay below: single peaks may stick out. */
function ceiling(values) {
  const sorted = Float64Array.from(values).sort();
  const below = (share) => sorted[Math.floor((sorted.length - 1) * share)] ?? 0;
  return Math.max(Math.min(1.15 * below(0.985), 2 * below(0.9)), 1e-9);
}

/** Graphs of all steps under the scene; a click or a drag goes there. */
export class Graphs {
  constructor(canvas, labels, run, onPick) {
    this.canvas = canvas;
    this.run = run;
    this.steps = run.series.step.length;
    this.ceilings = lanes.map((lane) => ceiling(run.series[lane.series[0]]));
    this.values = lanes.map((lane) => {
      const row = document.createElement("div");
      row.className = "lane";
      const value = document.createElement("b");
      value.style.color = lane.colours[0];
      const title = document.createElement("span");
      title.textContent = lane.title;
      row.append(title, value);
      labels.append(row);
      return value;
    });
    const stepAt = (event) => {
      const { left, width } = canvas.getBoundingClientRect();
      return Math.round((Math.min(Math.max(event.clientX - left, 0), width) / width) * this.steps);
    };
    let dragging = false;
    canvas.addEventListener("pointerdown", (event) => {
      dragging = true;
      canvas.setPointerCapture(event.pointerId);
      onPick(stepAt(event));
    });
    canvas.addEventListener("pointermove", (event) => {
      this.hover = stepAt(event);
      if (dragging) onPick(this.hover);
      this.mark(this.step);
    });
    canvas.addEventListener("pointerup", () => (dragging = false));
    canvas.addEventListener("pointerleave", () => {
      this.hover = undefined;
      this.mark(this.step);
    });
    this.step = 0;
  }

  /** The curves; they stay as they are until the size changes. */
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = window.devicePixelRatio;
    this.canvas.width = Math.max(1, width * ratio);
    this.canvas.height = Math.max(1, height * ratio);
    this.curves = document.createElement("canvas");
    this.curves.width = this.canvas.width;
    this.curves.height = this.canvas.height;
    const context = this.curves.getContext("2d");
    context.scale(ratio, ratio);
    const laneHeight = (height - gap * (lanes.length - 1)) / lanes.length;
    lanes.forEach((lane, i) => this.drawLane(context, lane, this.ceilings[i], i * (laneHeight + gap), width, laneHeight));
    this.mark(this.step);
  }

  drawLane(context, lane, most, top, width, height) {
    context.fillStyle = "#f3f5f8";
    context.fillRect(0, top, width, height);
    context.save();
    context.beginPath();
    context.rect(0, top, width, height);
    context.clip();
    lane.series.forEach((name, i) => {
      const values = this.run.series[name];
      const x = (step) => (step / this.steps) * width;
      const y = (value) => top + height - (value / most) * (height - 3);
      // From the last sample at the left to the first at the right; values belong to steps 1, 2, 3 ...
      context.beginPath();
      context.moveTo(x(1), top + height);
      values.forEach((value, k) => context.lineTo(x(k + 1), y(value)));
      context.lineTo(x(values.length), top + height);
      context.fillStyle = `${lane.colours[i]}26`;
      context.fill();
      context.beginPath();
      values.forEach((value, k) => context.lineTo(x(k + 1), y(value)));
      context.strokeStyle = lane.colours[i];
      context.lineWidth = 1.2;
      context.stroke();
    });
    context.restore();
    context.fillStyle = "#8a93a0";
    context.font = "10px system-ui, sans-serif";
    context.textAlign = "right";
    context.fillText(short(most, lane.unit), width - 4, top + 11);
  }

  /** The line at the step that is shown. */
  mark(step) {
    this.step = step;
    const shown = this.hover ?? step;
    lanes.forEach((lane, i) => {
      const value = this.run.series[lane.series[0]][shown - 1];
      this.values[i].textContent = value === undefined ? "\u2013" : short(value, lane.unit);
    });
    if (!this.curves) return;
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.curves, 0, 0);
    const line = (at, colour, width) => {
      context.fillStyle = colour;
      context.fillRect(Math.round((at / this.steps) * this.canvas.width - width / 2), 0, width, this.canvas.height);
    };
    if (this.hover !== undefined) line(this.hover, "#1f293355", window.devicePixelRatio);
    line(step, "#d62f2f", 2 * window.devicePixelRatio);
  }
}
