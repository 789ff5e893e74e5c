// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_generator_parts.hpp"

namespace boxstream::scenes {
namespace {

BallStart read_ball_start(Fields& fields) {
  BallStart start;
  start.count = fields.require("count").integer(0, max_count);
  start.centre = fields.require("centre").vec3(any_place);
  start.radius = fields.number("radius", any_size);
  start.speed = fields.number("speed", 0, {0, max_speed});
  return start;
}

}  // namespace

Generator read_ball_random(Fields& fields, const Scene& scene, const Names& names) {
  BallRandomGenerator ball;
  ball.start = read_ball_start(fields);
  ball.turned = fields.boolean("turned", false);
  ball.mix = read_mix(fields, scene, names);
  return ball;
}

Generator read_assorted80(Fields& fields, const Scene& scene, const Names& names) {
  return Assorted80Generator{read_ball_start(fields), read_box_part(fields, "unit", scene, names)};
}

Generator read_joint_grid(Fields& fields, const Scene& scene, const Names& names) {
  JointGridGenerator grid;
  grid.node = read_part(fields, "node", scene, names);
  grid.columns = read_columns(fields.require("columns"));
  grid.spacing = read_two_sizes(fields.require("spacing"));
  grid.origin = fields.require("origin").vec3(any_place);
  grid.held = fields.integer("held", grid.held, 0, max_count);
  if (grid.held > grid.columns[0]) fields.node().child("held").fail("more than the top row has");
  return grid;
}

Generator read_drum(Fields& fields, const Scene&, const Names& names) {
  DrumGenerator drum;
  drum.centre = fields.require("centre").vec3(any_place);
  drum.radius = fields.number("radius", any_size);
  drum.length = fields.number("length", any_size);
  drum.thickness = fields.number("thickness", any_size);
  drum.staves = fields.integer("staves", drum.staves, 3, 1000);
  drum.paddles = fields.integer("paddles", drum.paddles, 0, 1000);
  drum.depth = fields.number("depth", any_size);
  if (drum.depth > drum.radius) fields.node().child("depth").fail("paddles that reach beyond the axis");
  drum.spin = fields.number("spin", {-100, 100});
  drum.material = read_material(fields, names);
  return drum;
}

}  // namespace boxstream::scenes
