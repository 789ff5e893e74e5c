// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

enum class MixTypes { dynamic_only, any };

std::array<int, 2> read_columns(const Node& node) {
  const std::vector<Node> parts = node.list(2, 2);
  return {parts[0].integer(1, max_count), parts[1].integer(1, max_count)};
}

std::array<double, 2> read_two_sizes(const Node& node) {
  const std::vector<Node> parts = node.list(2, 2);
  return {parts[0].number(any_size), parts[1].number(any_size)};
}

std::vector<MixEntry> read_mix(Fields& fields, const Scene& scene, const Names& names,
                               MixTypes types = MixTypes::dynamic_only) {
  std::vector<MixEntry> mix;
  for (const Node& item : fields.require("mix").list(1, 100)) {
    Fields entry(item);
    MixEntry& added = mix.emplace_back();
    added.weight = entry.number("weight", 1, positive(1e6));
    added.traits = read_traits(entry, scene, names, types == MixTypes::any);
    if (const auto scale = entry.find("scale")) {
      added.scale = scale->pair({1e-3, 1e3});
      if (use_of(scene.shapes[added.traits.shape].value) == ShapeUse::fixed_body)
        scale->fail("this kind of shape has one size only");
    }
    entry.finish();
  }
  return mix;
}

/// A nested object with the traits of one body.
BodyTraits read_part(Fields& fields, const std::string& key, const Scene& scene, const Names& names) {
  Fields part(fields.require(key));
  BodyTraits traits = read_traits(part, scene, names, false);
  part.finish();
  return traits;
}

/// The same, of a body whose shape is a box.
BodyTraits read_box_part(Fields& fields, const std::string& key, const Scene& scene, const Names& names) {
  BodyTraits part = read_part(fields, key, scene, names);
  if (!std::holds_alternative<BoxShape>(scene.shapes[part.shape].value))
    fields.node().child(key).child("shape").fail("a " + key + " is a box");
  return part;
}

BallStart read_ball_start(Fields& fields) {
  BallStart start;
  start.count = fields.require("count").integer(0, max_count);
  start.centre = fields.require("centre").vec3(any_place);
  start.radius = fields.number("radius", any_size);
  start.speed = fields.number("speed", 0, {0, max_speed});
  return start;
}

struct ReadGenerator {
  Fields& fields;
  const Scene& scene;
  const Names& names;

  void operator()(GridGenerator& grid) const {
    grid.count = fields.require("count").integer(0, max_count);
    grid.columns = read_columns(fields.require("columns"));
    grid.spacing = fields.require("spacing").vec3(any_size);
    grid.origin = fields.require("origin").vec3(any_place);
    grid.jitter = fields.number("jitter", 0, {0, max_length});
    grid.turned = fields.boolean("turned", false);
    grid.vortex = fields.number("vortex", 0, any_velocity);
    grid.speed = fields.number("speed", 0, {0, max_speed});
    grid.scales = fields.boolean("scales", true);
    grid.mix = read_mix(fields, scene, names, MixTypes::any);
  }
  void operator()(WallGenerator& wall) const {
    wall.brick = read_box_part(fields, "brick", scene, names);
    wall.columns = fields.require("columns").integer(1, max_count);
    wall.rows = fields.require("rows").integer(1, max_count / wall.columns);
    wall.origin = fields.require("origin").vec3(any_place);
    // So that something is left of a half brick, which is shorter than half of one by half of a gap.
    const double length = 2 * std::get<BoxShape>(scene.shapes[wall.brick.shape].value).half_extents[0];
    wall.gap = fields.number("gap", 0, {0, std::min(0.9 * length, max_length)});
  }
  void operator()(ChainGenerator& chain) const {
    chain.link = read_part(fields, "link", scene, names);
    chain.end = read_part(fields, "end", scene, names);
    chain.links = fields.require("links").integer(1, 10'000);
    chain.anchor = fields.require("anchor").vec3(any_place);
    chain.direction = read_direction(fields.require("direction"));
    chain.pitch = fields.number("pitch", any_size);
    chain.end_offset = fields.number("end_offset", {0, max_length});
  }
  void operator()(RagdollGenerator& dolls) const {
    dolls.count = fields.require("count").integer(0, max_count / 11);
    dolls.columns = read_columns(fields.require("columns"));
    dolls.spacing = fields.require("spacing").vec3(any_size);
    dolls.origin = fields.require("origin").vec3(any_place);
    dolls.height = fields.number("height", dolls.height, positive(1000));
    dolls.mass = fields.number("mass", dolls.mass, positive(max_mass));
    dolls.spin = fields.number("spin", dolls.spin, {0, 100});
    dolls.material = read_material(fields, names);
  }
  void operator()(ContainerGenerator& container) const {
    container.floor = fields.vec3("floor", container.floor, any_place);
    container.size = fields.require("size").vec3(any_size);
    container.thickness = fields.number("thickness", container.thickness, any_size);
    container.lid = fields.boolean("lid", false);
    container.material = read_material(fields, names);
  }
  void operator()(PyramidGenerator& pyramid) const {
    pyramid.brick = read_box_part(fields, "brick", scene, names);
    pyramid.levels = fields.require("levels").integer(1, 1000);
    pyramid.flat = fields.boolean("flat", false);
    pyramid.origin = fields.require("origin").vec3(any_place);
    pyramid.degrees = fields.number("degrees", 0, {-360, 360});
    pyramid.gap = fields.number("gap", 0, {0, max_length});
    if (const auto repeat = fields.find("repeat")) {
      const std::vector<Node> copies = repeat->list(2, 2);
      pyramid.repeat = {copies[0].integer(1, 1000), copies[1].integer(1, 1000)};
      pyramid.spacing = read_two_sizes(fields.require("spacing"));
    }
  }
  void operator()(TowerGenerator& tower) const {
    tower.brick = read_box_part(fields, "brick", scene, names);
    tower.levels = fields.require("levels").integer(1, 1000);
    tower.around = fields.require("around").integer(3, 1000);
    tower.origin = fields.require("origin").vec3(any_place);
    tower.gap = fields.number("gap", 0, {0, max_length});
  }
  void operator()(ScatterGenerator& scatter) const {
    scatter.count = fields.require("count").integer(0, max_count);
    scatter.origin = fields.require("origin").vec3(any_place);
    scatter.size = fields.require("size").vec3(any_size);
    scatter.turned = fields.boolean("turned", false);
    scatter.mix = read_mix(fields, scene, names);
  }
  void operator()(RespawnGenerator& respawn) const {
    respawn.count = fields.require("count").integer(1, max_count);
    respawn.at_once = fields.integer("at_once", respawn.at_once, 1, max_count);
    respawn.every = fields.integer("every", respawn.every, 1, max_count);
    respawn.origin = fields.require("origin").vec3(any_place);
    respawn.size = fields.require("size").vec3(any_size);
    respawn.velocity = fields.vec3("velocity", respawn.velocity, any_velocity);
    respawn.turned = fields.boolean("turned", false);
    respawn.mix = read_mix(fields, scene, names);
  }
  void operator()(BallRandomGenerator& ball) const {
    ball.start = read_ball_start(fields);
    ball.turned = fields.boolean("turned", false);
    ball.mix = read_mix(fields, scene, names);
  }
  void operator()(Assorted80Generator& assorted) const {
    assorted.start = read_ball_start(fields);
    assorted.unit = read_box_part(fields, "unit", scene, names);
  }
  void operator()(JointGridGenerator& grid) const {
    grid.node = read_part(fields, "node", scene, names);
    grid.columns = read_columns(fields.require("columns"));
    grid.spacing = read_two_sizes(fields.require("spacing"));
    grid.origin = fields.require("origin").vec3(any_place);
    grid.held = fields.integer("held", grid.held, 0, max_count);
    if (grid.held > grid.columns[0]) fields.node().child("held").fail("more than the top row has");
  }
  void operator()(DrumGenerator& drum) const {
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
  }
  void operator()(ImportGenerator& import) const { read_import(fields, scene, names, import); }
};

}  // namespace

void load_generators(const Node& node, Scene& scene, const Names& names) {
  std::size_t bodies = scene.bodies.size();
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    read_kind(fields, scene.generators.emplace_back(), ReadGenerator{fields, scene, names});
    fields.finish();
    bodies += most_bodies(scene.generators.back());
    if (bodies > max_count) item.fail("more than " + std::to_string(max_count) + " bodies in all");
  }
}

}  // namespace boxstream::scenes
