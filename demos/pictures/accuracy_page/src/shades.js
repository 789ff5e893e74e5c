// SPDX-License-Identifier: MIT
// Colours of the cells of a map, and what they say.
import { inks } from "./colours.js";
import { unique, valueOf } from "./data.js";
import { figure } from "./words.js";

/** An orange or a green, the deeper the larger the part of one. */
const deep = (tone, part) => `rgba(${tone}, ${(0.15 + 0.6 * part).toFixed(3)})`;
const orange = "224, 124, 32";
const green = "38, 148, 92";

/** The value that a map calls right. */
function rightValue(experiment, spec) {
  const wanted = unique(experiment.expect.filter((entry) => entry.op === "==" && entry.metric === spec.y).map((entry) => entry.value));
  return wanted.length === 1 ? wanted[0] : 0;
}

/**
 * Value -> colour. Beside a neutral value what is better is green and what is worse orange; else what is right is pale
 * green and all else orange. The further, the deeper.
 */
export function shades(experiment, spec) {
  const values = experiment.table.points.map((point) => valueOf(point, spec.y)).filter((value) => value !== null);
  const worse = (value) => (spec.better === "high" ? -value : value);
  const partOf = (distance, most) => Math.log1p(distance) / Math.log1p(most);
  if (spec.neutral !== undefined) {
    const beside = (value) => worse(value) - worse(spec.neutral);
    const most = Math.max(...values.map((value) => Math.abs(beside(value))));
    return (value) => (figure(value) === figure(spec.neutral) ? inks.neutral : deep(beside(value) < 0 ? green : orange, partOf(Math.abs(beside(value)), most)));
  }
  const right = rightValue(experiment, spec);
  // Where more is better what is wrong begins at the most of it.
  const start = spec.better === "high" ? Math.max(...values) : right;
  const most = Math.max(...values.map((value) => Math.abs(value - start)));
  return (value) => (value === right ? inks.right : deep(orange, most > 0 ? partOf(Math.abs(value - start), most) : 1));
}

/** What the colours of a map say. */
export function shadesNote({ experiment }, spec) {
  if (spec.neutral === undefined) return `Green: as it should be (${figure(rightValue(experiment, spec))}). The deeper the orange, the worse.`;
  const [less, more] = spec.better === "high" ? ["more", "less"] : ["less", "more"];
  return `Green: ${less} than ${figure(spec.neutral)}, which is better. Orange: ${more}, which is worse. The deeper, the further from ${figure(spec.neutral)}.`;
}
