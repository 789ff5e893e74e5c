// SPDX-License-Identifier: MIT
// Plain names of effects, where scenes' own names for them do not say what they are.
const names = {
  exclusions: "pairs kept apart",
  ccd: "sweeping of fast bodies",
  ccd_on_demand: "watch for fast bodies",
  compounds: "compound shapes",
  forced_boxes: "boxes of sleeping bodies",
  friction_caching: "friction kept over steps",
  gyroscopic: "gyroscopic term",
  internal_edges: "inner edges of meshes",
  impulses: "random new velocities",
  kinematic: "kinematic bodies",
  out_of_bounds: "bodies that leave",
  monitors: "checks and output",
  queries: "rays and other queries",
  respawn: "bodies that rain down",
  vortex: "swirling air",
  threads: "threads of the broad-phase",
  tumbling_gravity: "gravity that turns",
};

export const effectName = (key) => names[key] ?? key.replaceAll("_", " ");

/** With the name that scenes have for it. */
export const effectWithKey = (key) => (key in names ? `${names[key]} (${key})` : effectName(key));
