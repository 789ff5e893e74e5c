// SPDX-License-Identifier: MIT
// Curves of all steps under the scene; a click or a drag goes to that step.
import { LineChart } from "echarts/charts";
import { AxisPointerComponent, GridComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { CanvasRenderer } from "echarts/renderers";
import { make } from "./dom.js";
import { duration, figure, whole } from "./words.js";

use([LineChart, AxisPointerComponent, GridComponent, TooltipComponent, CanvasRenderer]);

/** Of worlds that stand side by side. */
export const worldColours = ["#3b8fd9", "#e07b39"];

const lanes = [
  { title: "Candidate pairs", of: "pairs", isCount: true, colour: "#3b8fd9", text: whole, axis: (value) => (value >= 1000 ? `${figure(value / 1000)}k` : whole(value)) },
  { title: "Broad-phase", of: "broadphase", colour: "#1f9d6f", text: duration, axis: duration },
  { title: "Whole step", of: "step", colour: "#d9662b", text: duration, axis: duration },
];

/** What nearly all values stay below: single peaks may stick out. */
function ceiling(values) {
  const sorted = Float64Array.from(values).sort();
  const below = (share) => sorted[Math.floor((sorted.length - 1) * share)] ?? 0;
  return Math.max(Math.min(1.15 * below(0.985), 2 * below(0.9)), 1e-6);
}

/** A round number, at least `value`; of what is counted an even one. */
function roundUp(value, isCount) {
  if (isCount && value < 10) return 2 * Math.ceil(value / 2);
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((digit) => digit * power >= value * 0.999);
}

export class Graphs {
  constructor(place, worlds, theme, onPick) {
    this.place = place;
    this.worlds = worlds;
    this.theme = theme;
    this.onPick = onPick;
    this.dt = worlds[0].run.dt;
    this.seconds = worlds[0].run.series.step.length * this.dt;
    this.step = 0;
    // Not before the first picture of the scene.
    requestAnimationFrame(() => setTimeout(() => new ResizeObserver(() => this.resize()).observe(place)));
  }

  resize() {
    if (this.place.clientWidth === 0) return;
    if (!this.chart) this.start();
    this.chart.resize();
    this.repaint();
  }

  start() {
    this.chart = init(this.place, null, { renderer: "canvas" });
    let dragging = false;
    const go = (event) => {
      const pixel = [event.offsetX, event.offsetY];
      const lane = Math.max(0, lanes.findIndex((_, i) => this.chart.containPixel({ gridIndex: i }, pixel)));
      const [seconds] = this.chart.convertFromPixel({ gridIndex: lane }, pixel);
      this.onPick(Math.round(Math.min(Math.max(seconds, 0), this.seconds) / this.dt));
    };
    const canvas = this.chart.getZr();
    canvas.on("mousedown", (event) => {
      dragging = true;
      go(event);
    });
    canvas.on("mousemove", (event) => dragging && go(event));
    addEventListener("pointerup", () => (dragging = false));
  }

  /** One beside the other where there is room, else one above the other. */
  grids() {
    const { clientWidth: width, clientHeight: height } = this.place;
    const [left, right, top, bottom] = [58, 14, 22, 20];
    const isWide = width > 900 || height < 130;
    if (isWide) return lanes.map((_, i) => ({ left: (i * width) / 3 + left, width: width / 3 - left - right, top, bottom }));
    const each = (height - bottom) / 3;
    return lanes.map((_, i) => ({ left, right, top: i * each + 16, height: each - 20 }));
  }

  repaint() {
    if (!this.chart) return;
    const { quiet, line, ink, paper } = this.theme.colours;
    const grids = this.grids();
    const isWide = grids[0].top === grids[1].top;
    const most = lanes.map(({ of, isCount }) => roundUp(Math.max(...this.worlds.map(({ run }) => ceiling(run.series[of]))), isCount));
    this.chart.setOption(
      {
        animation: false,
        textStyle: { fontFamily: "system-ui, sans-serif", color: quiet },
        axisPointer: { link: [{ xAxisIndex: "all" }], lineStyle: { color: quiet, type: "solid" }, label: { show: false } },
        tooltip: { trigger: "axis", confine: true, backgroundColor: paper, borderColor: line, textStyle: { color: ink, fontSize: 12 }, formatter: (items) => this.hover(items[0].dataIndex) },
        grid: grids,
        xAxis: lanes.map((_, i) => this.timeAxis(i, isWide)),
        yAxis: lanes.map((lane, i) => this.valueAxis(lane, i, most[i])),
        series: lanes.flatMap((lane, i) => this.worlds.map((world, w) => this.curve(lane, i, world, this.worlds.length > 1 ? worldColours[w] : lane.colour))),
      },
      true,
    );
    this.mark(this.step);
  }

  timeAxis(lane, isWide) {
    const { quiet, line } = this.theme.colours;
    const label = { show: isWide || lane === lanes.length - 1, color: quiet, fontSize: 10, hideOverlap: true, showMaxLabel: false, formatter: (value) => `${figure(value)} s` };
    const lines = { axisLine: { lineStyle: { color: line } }, axisTick: { lineStyle: { color: line } }, splitLine: { show: false } };
    return { gridIndex: lane, type: "value", min: 0, max: this.seconds, splitNumber: isWide ? 4 : 6, axisLabel: label, ...lines };
  }

  /** The name of an upright axis stands above it, from the left. */
  valueAxis({ title, axis }, lane, most) {
    const { quiet, line, ink } = this.theme.colours;
    const name = { name: title, nameLocation: "end", nameGap: 6, nameTextStyle: { align: "left", color: ink, fontSize: 11, padding: [0, 0, 0, -48] } };
    return { gridIndex: lane, type: "value", min: 0, max: most, interval: most / 2, ...name, axisLabel: { color: quiet, fontSize: 10, formatter: axis }, splitLine: { lineStyle: { color: line } } };
  }

  curve({ of }, lane, { run }, colour) {
    const data = run.series[of].map((value, k) => [(k + 1) * run.dt, value]);
    const area = this.worlds.length > 1 ? undefined : { color: colour, opacity: 0.14 };
    const look = { lineStyle: { width: 1.3, color: colour }, areaStyle: area, itemStyle: { color: colour }, showSymbol: false, emphasis: { disabled: true } };
    return { type: "line", xAxisIndex: lane, yAxisIndex: lane, data, sampling: "lttb", ...look };
  }

  /** Values of a step, in all worlds. */
  hover(index) {
    const seconds = (index + 1) * this.dt;
    const row = ({ title, of, text }) => `${title}: ${this.worlds.map(({ run }) => text(run.series[of][Math.round(seconds / run.dt) - 1] ?? 0)).join(" \u00b7 ")}`;
    const names = this.worlds.length > 1 ? [this.worlds.map(({ run }) => run.label).join(" \u00b7 ")] : [];
    const escaped = (text) => text.replace(/[&<>]/g, (character) => `&#${character.charCodeAt(0)};`);
    return [`<b>step ${whole(index + 1)}, ${seconds.toFixed(2)} s</b>`, ...[...names, ...lanes.map(row)].map(escaped)].join("<br>");
  }

  /** The line at the step that is shown. */
  mark(step) {
    this.step = step;
    if (!this.chart || this.place.clientWidth === 0) return;
    const marks = this.grids()[0].top === this.grids()[1].top ? [0, 1, 2] : [0];
    const { clientHeight } = this.place;
    this.marks ??= lanes.map(() => this.place.appendChild(make("div", "", { className: "now" })));
    this.marks.forEach((line, i) => {
      const [left] = this.chart.convertToPixel({ gridIndex: i }, [step * this.dt, 0]);
      Object.assign(line.style, { left: `${left}px`, top: "16px", height: `${clientHeight - 36}px`, visibility: marks.includes(i) ? "visible" : "hidden" });
    });
  }
}
