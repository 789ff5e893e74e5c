// SPDX-License-Identifier: MIT
// Plots on the page: drawn when they come into sight, enlarged on demand, saved as SVG or PNG.
import { BarChart, CustomChart, LineChart, ScatterChart } from "echarts/charts";
import { DataZoomComponent, GridComponent, LegendPlainComponent, MarkLineComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { LabelLayout } from "echarts/features";
import { SVGRenderer } from "echarts/renderers";
import { inks, tint, tinted } from "./colours.js";
import { isDark, onTheme } from "./theme.js";
import { element, save } from "./dom.js";

use([BarChart, CustomChart, LineChart, ScatterChart, DataZoomComponent, GridComponent, LegendPlainComponent, MarkLineComponent, TooltipComponent, LabelLayout, SVGRenderer]);

const font = { textStyle: { fontFamily: "system-ui, sans-serif", fontSize: 11 } };

/** How axes look, and the box beside the pointer, which does not glide: nothing on the page moves by itself. */
function look() {
  const ink = (name) => tint(inks[name]);
  const axis = { nameTextStyle: { color: ink("soft") }, axisLabel: { color: ink("soft") }, axisLine: { lineStyle: { color: ink("line") } }, axisTick: { lineStyle: { color: ink("line") } }, splitLine: { lineStyle: { color: ink("grid") } } };
  return { categoryAxis: axis, valueAxis: axis, tooltip: { transitionDuration: 0, backgroundColor: isDark() ? "#1d242c" : "#fff", borderColor: ink("line"), textStyle: { color: ink("text"), fontSize: 12 } } };
}

/** Places whose plot is drawn, to be drawn again when it gets dark. */
const drawn = new Set();
onTheme(() => {
  for (const place of drawn) if (place.isConnected) place.redraw();
});

const seen = new IntersectionObserver(
  (entries) => {
    for (const entry of entries) if (entry.isIntersecting) entry.target.draw?.();
  },
  { rootMargin: "300px" },
);

const resized = new ResizeObserver((entries) => {
  for (const entry of entries) entry.target.chart?.resize();
});

/** A place for a chart. `place.chart` is there once it is drawn. */
export function chartPlace(option, { height = 260, width = null, selected = () => ({}) } = {}) {
  const place = element("div.chart", { style: `height:${height}px${width ? `;min-width:${width}px` : ""}` });
  place.draw = () => {
    if (place.chart) return place.chart;
    seen.unobserve(place);
    place.chart = init(place, look(), { renderer: "svg" });
    place.chart.setOption({ ...font, ...tinted(option), legend: { show: false, selected: selected() } });
    resized.observe(place);
    drawn.add(place);
    return place.chart;
  };
  place.redraw = () => {
    place.chart.dispose();
    place.chart = null;
    place.draw();
  };
  seen.observe(place);
  return place;
}

const svgOf = (place) => place.draw().renderToSVGString();

async function pngOf(place) {
  const chart = place.draw();
  const [width, height] = [chart.getWidth(), chart.getHeight()];
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOf(place))}`;
  await image.decode();
  const canvas = element("canvas", { width: 2 * width, height: 2 * height });
  const context = canvas.getContext("2d");
  context.fillStyle = isDark() ? "#14181d" : "#fff";
  context.fillRect(0, 0, 2 * width, 2 * height);
  context.drawImage(image, 0, 0, 2 * width, 2 * height);
  return canvas.toDataURL("image/png");
}

/** The same plot over the whole window, with handles to zoom. */
function enlarge(title, option, selected) {
  const dialog = element("dialog", { onclose: () => dialog.remove() });
  const zoomed = option.dataZoom.length > 0;
  const sliders = zoomed ? [{ type: "slider", xAxisIndex: 0, height: 18, bottom: 6, filterMode: "none", labelFormatter: "" }, { type: "slider", yAxisIndex: 0, width: 18, right: 6, filterMode: "none", labelFormatter: "" }] : [];
  const inside = option.dataZoom.map((zoom) => ({ ...zoom, zoomOnMouseWheel: true }));
  const place = chartPlace({ ...option, grid: { ...option.grid, bottom: option.grid.bottom + (zoomed ? 32 : 0), right: zoomed ? 46 : 16 }, dataZoom: [...inside, ...sliders] }, { height: Math.round(0.78 * innerHeight), selected });
  dialog.append(element("p.row", {}, element("b", {}, title), element("button", { type: "button", onclick: () => dialog.close() }, "Close")), place);
  document.body.append(dialog);
  dialog.showModal();
  place.draw();
}

/** Buttons of a plot: larger, and to save it. */
export function tools(name, title, place, option, selected) {
  const button = (label, hint, act) => element("button.save", { type: "button", title: hint, onclick: act }, label);
  return element(
    "span.tools",
    {},
    button("enlarge", "Larger, with handles to zoom", () => enlarge(title, option, selected)),
    button("SVG", `Save ${name}.svg`, () => save(`${name}.svg`, svgOf(place), "image/svg+xml")),
    button("PNG", `Save ${name}.png`, async () => save(`${name}.png`, await pngOf(place))),
  );
}
