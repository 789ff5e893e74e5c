// SPDX-License-Identifier: MIT
// A plot with its panels, its legend and the numbers behind it.
import { chartPlace, tools } from "./charts.js";
import { tint } from "./colours.js";
import { onTheme } from "./theme.js";
import { valueOf } from "./data.js";
import { element, escaped, saveButton, tableOf, unfolding } from "./dom.js";
import { swatch } from "./plot_parts.js";
import { plotOf } from "./plots.js";
import { figure, several } from "./words.js";

const interval = (point) => (point.cost === null ? "\u2013" : `${figure(point.cost)} (${figure(point.cost_low)} to ${figure(point.cost_high)})`);

const number = (text) => ({ text, number: true });

/** Rows of points with some metrics, in plain names. */
export function pointsTable({ experiment, names }, points, metrics, idOf = () => null) {
  const counted = points.some((point) => point.instructions !== null);
  const head = ["scene or input", "candidate", number(`${names.cost(experiment)} (95 % interval)`), ...(counted ? [number("instructions")] : []), ...metrics.map((metric) => number(names.metricLabel(experiment, metric))), "failure"];
  const rows = points.map((point) => [
    names.panel(experiment, point.panel),
    names.candidate(experiment, point.series, point.setting, point.panel),
    number(interval(point)),
    ...(counted ? [number(figure(point.instructions))] : []),
    ...metrics.map((metric) => number(figure(valueOf(point, metric)))),
    point.failure,
  ]);
  return tableOf(head, rows, (i) => ({ id: idOf(points[i]) }));
}

const quoted = (cell) => (/[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell);

/** Points as CSV, under the names that the measurement gave. */
export function csvOf({ table }, metrics) {
  const head = ["panel", "series", "setting", "x", "cost", "cost_low", "cost_high", "cost_min", "instructions", ...metrics, "failure"];
  const facts = Object.entries(table.facts).map(([key, value]) => `# ${key}: ${value}\n`);
  const rows = table.points.map((point) => head.map((name) => point[name] ?? point.values[name] ?? ""));
  return facts.join("") + [head, ...rows].map((row) => `${row.map((cell) => quoted(String(cell))).join(",")}\n`).join("");
}

/** Curves as CSV, to the digits that the page has. */
export const curvesCsv = (experiment) => `panel,series,setting,at,value\n${experiment.curves.flatMap(([panel, series, setting, at, values]) => at.map((t, i) => `${[panel, series, setting].map(quoted).join(",")},${t},${values[i] ?? ""}\n`)).join("")}`;

/** A marker in the colour that the plot gives it, light or dark. */
export function marked(color, mark) {
  const made = swatch(mark);
  const paint = () => (made.style.color = tint(color));
  onTheme(paint);
  paint();
  return made;
}

function legendOf(plot, places, hidden) {
  if (plot.legend.length < 2 && !plot.legend[0]?.said) return null;
  return element(
    "div.legend",
    {},
    plot.legend.map(({ name, said, color, ...mark }) =>
      element(
        "button",
        {
          type: "button",
          "aria-pressed": "true",
          title: "Show or hide",
          onclick: ({ currentTarget }) => {
            const shown = hidden.delete(name) || (hidden.add(name), false);
            currentTarget.setAttribute("aria-pressed", String(shown));
            for (const place of places) place.chart?.dispatchAction({ type: shown ? "legendSelect" : "legendUnSelect", name });
          },
        },
        marked(color, mark),
        said ? `${name}: ${said}` : name,
      ),
    ),
  );
}

/** The figure of a plot, made by plotOf. */
export function figureOf(context, plot, name) {
  if (plot.missing) return element("figure", { id: name }, element("figcaption", {}, `${plot.title}: ${plot.missing}`));
  const hidden = new Set();
  const selected = () => Object.fromEntries([...hidden].map((series) => [series, false]));
  const panels = plot.panels.map(({ panel, title = panel === null ? "" : context.names.panel(context.experiment, panel), option, height, width }, i) => {
    const place = chartPlace(option, { height, width, selected });
    return { place, made: element("div.panel", {}, element("div.row", {}, element("h4", {}, title), tools(`${name}-${i + 1}`, `${plot.title}: ${title}`, place, option, selected)), element("div.wide", {}, place)) };
  });
  const broad = plot.panels.some((panel) => panel.width > 420);
  const shape = broad ? ".alone" : plot.panels.length === 1 ? ".alone.single" : plot.kind === "bars" ? ".alone" : "";
  const behind = plot.metrics.length === 0 ? null : behindPlot(context, plot, name);
  return element("figure", { id: name }, element("figcaption", {}, plot.title), plot.note ? element("p.small", {}, plot.note) : null, element(`div.panels${shape}`, {}, panels.map(({ made }) => made)), legendOf(plot, panels.map(({ place }) => place), hidden), behind);
}

function behindPlot(context, plot, name) {
  const { table } = context.experiment;
  const metrics = plot.metrics.filter((metric) => metric !== "cost");
  const points = table.points.filter((point) => point.failure || plot.metrics.some((metric) => valueOf(point, metric) !== null));
  return unfolding(`Numbers of this plot: ${several(points.length, "point")}`, () => [saveButton("CSV", `${name}.csv`, () => csvOf(context.experiment, metrics), "text/csv"), pointsTable(context, points, metrics)]);
}

export const drawing = (context, spec, name) => figureOf({ ...context, escape: escaped }, plotOf({ ...context, escape: escaped }, spec), name);
