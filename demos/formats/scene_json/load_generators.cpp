// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_generator_parts.hpp"
#include "formats/scene_json/load_import.hpp"

namespace boxstream::scenes {

namespace {

bool never_resized(const ShapeValue& shape) {
  return std::holds_alternative<PlaneShape>(shape) || std::holds_alternative<HeightfieldShape>(shape) ||
         std::holds_alternative<MeshShape>(shape);
}

}  // namespace

std::array<int, 2> read_columns(const Node& node) {
  const std::vector<Node> parts = node.list(2, 2);
  return {parts[0].integer(1, max_count), parts[1].integer(1, max_count)};
}

std::array<double, 2> read_two_sizes(const Node& node) {
  const std::vector<Node> parts = node.list(2, 2);
  return {parts[0].number(any_size), parts[1].number(any_size)};
}

std::vector<MixEntry> read_mix(Fields& fields, const Scene& scene, const Names& names, MixTypes types) {
  std::vector<MixEntry> mix;
  for (const Node& item : fields.require("mix").list(1, 100)) {
    Fields entry(item);
    MixEntry& added = mix.emplace_back();
    added.weight = entry.number("weight", 1, positive(1e6));
    added.traits = read_traits(entry, scene, names, types == MixTypes::any);
    if (const auto scale = entry.find("scale")) {
      added.scale = scale->pair({1e-3, 1e3});
      if (never_resized(scene.shapes[added.traits.shape].value)) scale->fail("this kind of shape has one size only");
    }
    entry.finish();
  }
  return mix;
}

BodyTraits read_part(Fields& fields, const std::string& key, const Scene& scene, const Names& names) {
  Fields part(fields.require(key));
  BodyTraits traits = read_traits(part, scene, names, false);
  part.finish();
  return traits;
}

BodyTraits read_box_part(Fields& fields, const std::string& key, const Scene& scene, const Names& names) {
  BodyTraits part = read_part(fields, key, scene, names);
  if (!std::holds_alternative<BoxShape>(scene.shapes[part.shape].value))
    fields.node().child(key).child("shape").fail("a " + key + " is a box");
  return part;
}

namespace {

Generator read_grid(Fields& fields, const Scene& scene, const Names& names) {
  GridGenerator grid;
  grid.count = fields.require("count").integer(0, max_count);
  grid.columns = read_columns(fields.require("columns"));
  grid.spacing = fields.require("spacing").vec3(any_size);
  grid.origin = fields.require("origin").vec3(any_place);
  grid.jitter = fields.number("jitter", 0, {0, max_length});
  grid.turned = fields.boolean("turned", false);
  grid.vortex = fields.number("swirl", 0, any_velocity);
  grid.speed = fields.number("speed", 0, {0, max_speed});
  grid.scales = fields.boolean("scales", true);
  grid.mix = read_mix(fields, scene, names, MixTypes::any);
  return grid;
}

Generator read_wall(Fields& fields, const Scene& scene, const Names& names) {
  WallGenerator wall;
  wall.brick = read_box_part(fields, "brick", scene, names);
  wall.columns = fields.require("columns").integer(1, max_count);
  wall.rows = fields.require("rows").integer(1, max_count / wall.columns);
  wall.origin = fields.require("origin").vec3(any_place);
  wall.gap = fields.number("gap", 0, {0, max_length});
  return wall;
}

Generator read_chain(Fields& fields, const Scene& scene, const Names& names) {
  ChainGenerator chain;
  chain.link = read_part(fields, "link", scene, names);
  chain.end = read_part(fields, "end", scene, names);
  chain.links = fields.require("links").integer(1, 10'000);
  chain.anchor = fields.require("anchor").vec3(any_place);
  chain.direction = read_direction(fields.require("direction"));
  chain.pitch = fields.number("pitch", any_size);
  chain.end_offset = fields.number("end_offset", {0, max_length});
  return chain;
}

Generator read_ragdolls(Fields& fields, const Scene&, const Names& names) {
  RagdollGenerator dolls;
  dolls.count = fields.require("count").integer(0, max_count / 11);
  dolls.columns = read_columns(fields.require("columns"));
  dolls.spacing = fields.require("spacing").vec3(any_size);
  dolls.origin = fields.require("origin").vec3(any_place);
  dolls.height = fields.number("height", dolls.height, positive(1000));
  dolls.mass = fields.number("mass", dolls.mass, positive(max_mass));
  dolls.spin = fields.number("spin", dolls.spin, {0, 100});
  dolls.material = read_material(fields, names);
  return dolls;
}

Generator read_container(Fields& fields, const Scene&, const Names& names) {
  ContainerGenerator container;
  container.floor = fields.vec3("floor", container.floor, any_place);
  container.size = fields.require("size").vec3(any_size);
  container.thickness = fields.number("thickness", container.thickness, any_size);
  container.lid = fields.boolean("lid", false);
  container.material = read_material(fields, names);
  return container;
}

Generator read_pyramid(Fields& fields, const Scene& scene, const Names& names) {
  PyramidGenerator pyramid;
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
  return pyramid;
}

Generator read_tower(Fields& fields, const Scene& scene, const Names& names) {
  TowerGenerator tower;
  tower.brick = read_box_part(fields, "brick", scene, names);
  tower.levels = fields.require("levels").integer(1, 1000);
  tower.around = fields.require("around").integer(3, 1000);
  tower.origin = fields.require("origin").vec3(any_place);
  tower.gap = fields.number("gap", 0, {0, max_length});
  return tower;
}

Generator read_scatter(Fields& fields, const Scene& scene, const Names& names) {
  ScatterGenerator scatter;
  scatter.count = fields.require("count").integer(0, max_count);
  scatter.origin = fields.require("origin").vec3(any_place);
  scatter.size = fields.require("size").vec3(any_size);
  scatter.turned = fields.boolean("turned", false);
  scatter.mix = read_mix(fields, scene, names);
  return scatter;
}

Generator read_respawn(Fields& fields, const Scene& scene, const Names& names) {
  RespawnGenerator respawn;
  respawn.count = fields.require("count").integer(1, max_count);
  respawn.at_once = fields.integer("at_once", respawn.at_once, 1, max_count);
  respawn.every = fields.integer("every", respawn.every, 1, max_count);
  respawn.origin = fields.require("origin").vec3(any_place);
  respawn.size = fields.require("size").vec3(any_size);
  respawn.velocity = fields.vec3("velocity", respawn.velocity, any_velocity);
  respawn.turned = fields.boolean("turned", false);
  respawn.mix = read_mix(fields, scene, names);
  return respawn;
}

constexpr Kind<Generator, const Scene&, const Names&> kinds[] = {{"grid", read_grid},
                                                                 {"wall", read_wall},
                                                                 {"chain", read_chain},
                                                                 {"ragdolls", read_ragdolls},
                                                                 {"container", read_container},
                                                                 {"pyramid", read_pyramid},
                                                                 {"tower", read_tower},
                                                                 {"scatter", read_scatter},
                                                                 {"rain", read_respawn},
                                                                 {"ball_random", read_ball_random},
                                                                 {"assorted80", read_assorted80},
                                                                 {"joint_grid", read_joint_grid},
                                                                 {"drum", read_drum},
                                                                 {"import", read_import}};

}  // namespace

void load_generators(const Node& node, Scene& scene, const Names& names) {
  std::size_t bodies = scene.bodies.size();
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    scene.generators.push_back(read_kind(kinds, fields, scene, names));
    fields.finish();
    bodies += most_bodies(scene.generators.back());
    if (bodies > max_count) item.fail("more than " + std::to_string(max_count) + " bodies in all");
  }
}

}  // namespace boxstream::scenes
