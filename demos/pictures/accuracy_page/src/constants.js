// SPDX-License-Identifier: MIT
// Metrics that do not change with their knob: each is a finding or a mistake.
import { unique, valueOf } from "./data.js";

/** Does every series have the same value at all its settings, and one of them more than one setting? */
function isConstant(points, metric) {
  const known = points.filter((point) => !point.failure && valueOf(point, metric) !== null);
  const bySeries = unique(known.map((point) => point.series)).map((name) => known.filter((point) => point.series === name).map((point) => valueOf(point, metric)));
  const several = bySeries.filter((values) => values.length > 1);
  return several.length > 0 && several.every((values) => Math.max(...values) - Math.min(...values) <= 1e-9 * Math.max(...values.map(Math.abs)));
}

/** [{metric, panel, why}]; `why` is empty where the experiment has no sentence for it. */
export function constants(experiment) {
  if (!experiment.table) return [];
  return experiment.table.panels.flatMap((panel) => {
    const points = experiment.table.points.filter((point) => point.panel === panel);
    return experiment.table.metrics
      .filter((metric) => isConstant(points, metric))
      .map((metric) => {
        const said = experiment.constant.find((entry) => entry.metric === metric && [entry.panel ?? panel].flat().includes(panel));
        return { metric, panel, why: said?.why ?? "" };
      });
  });
}
