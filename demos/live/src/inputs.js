// SPDX-License-Identifier: MIT
// Sets of boxes as in demos/inputs, from other random numbers. Six numbers a box: the low ends, then the high ones.
import { Random } from "./random.js";

/** The paper's balanced boxes: whole numbers in 1 .. n, each side up to n^(2/3) long. */
function balanced(boxes, n, random) {
  const longest = Math.max(1, Math.floor(Math.cbrt(n * n) + 1e-6));
  for (let i = 0; i < 6 * n; i += 6)
    for (let d = 0; d < 3; ++d) {
      boxes[i + d] = random.integer(1, n - longest);
      boxes[i + 3 + d] = boxes[i + d] + random.integer(1, longest);
    }
}

/** The paper's sphere: boxes on a surface of radius n / 2, each side up to n^(1/2) long. */
function sphere(boxes, n, random) {
  const longest = Math.max(1, Math.floor(Math.sqrt(n)));
  for (let i = 0; i < 6 * n; i += 6) {
    const height = random.real(-1, 1);
    const angle = random.real(0, 2 * Math.PI);
    const ring = Math.sqrt(1 - height * height);
    const at = [ring * Math.cos(angle), height, ring * Math.sin(angle)];
    for (let d = 0; d < 3; ++d) {
      const half = random.integer(1, longest) / 2;
      boxes[i + d] = (n / 2) * at[d] - half;
      boxes[i + 3 + d] = (n / 2) * at[d] + half;
    }
  }
}

/** Bars from wall to wall along x, y and z on a grid: every projection is crowded, and nothing meets. */
function lattice(boxes, n, random) {
  const thickness = 0.2;
  const lines = Math.ceil(Math.sqrt(n / 3) - 1e-9);
  const all = new Float64Array(18 * lines * lines);
  let at = 0;
  for (let d = 0; d < 3; ++d)
    for (let line = 0; line < lines * lines; ++line, at += 6) {
      const low = [0, (line % lines) + 0.5, Math.floor(line / lines)];
      const high = [lines, low[1] + thickness, low[2] + thickness];
      for (let k = 0; k < 3; ++k) {
        all[at + ((d + k) % 3)] = low[k];
        all[at + 3 + ((d + k) % 3)] = high[k];
      }
    }
  random.shuffle(all, 6);
  boxes.set(all.subarray(0, 6 * n));
}

/** 85 % in a unit cube, the rest scattered over a cube of 10 000. */
function heap(boxes, n, random) {
  const strays = Math.floor(0.15 * n);
  for (let box = 0; box < n; ++box) {
    const [edge, count] = box < strays ? [1e4, strays] : [1, n - strays];
    const side = edge / Math.cbrt(count + 1);
    for (let d = 0; d < 3; ++d) {
      boxes[6 * box + d] = random.real(0, edge);
      boxes[6 * box + 3 + d] = boxes[6 * box + d] + side * random.real(0.5, 1);
    }
  }
  random.shuffle(boxes, 6);
}

export const inputs = {
  U: { title: "U", about: "random boxes in a cube, about one pair for two boxes", make: balanced },
  S: { title: "S", about: "small boxes on the surface of a sphere", make: sphere },
  lattice: { title: "lattice", about: "bars from wall to wall: crowded in every projection, yet no pairs", make: lattice },
  heap: { title: "heap", about: "85 % in a heap, the rest strewn over a world ten thousand times as wide", make: heap },
};

/** n boxes of an input. */
export function makeBoxes(input, n, seed) {
  const boxes = new Float64Array(6 * n);
  inputs[input].make(boxes, n, new Random(seed));
  return boxes;
}
