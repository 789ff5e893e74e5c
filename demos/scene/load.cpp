// SPDX-License-Identifier: MIT
#include "scene/broadphase_names.hpp"
#include "scene/json_text.hpp"
#include "scene/load_parts.hpp"

namespace boxstream::scenes {
namespace {

void load_meta(const Node& node, Scene& scene) {
  Fields fields(node);
  scene.meta.name = fields.require("name").text();
  scene.meta.about = fields.require("about").text();
  scene.meta.source = fields.text("source", "");
  if (const auto tags = fields.find("tags"))
    for (const Node& tag : tags->list(0, 32)) scene.meta.tags.push_back(tag.text());
  fields.finish();
}

void load_time(const Node& node, Scene& scene) {
  Fields fields(node);
  scene.time.dt = fields.number("dt", {1e-5, 0.1});
  scene.time.steps = fields.integer("steps", scene.time.steps, 1, 10'000'000);
  fields.finish();
}

void load_world(const Node& node, Scene& scene) {
  Fields fields(node);
  scene.world.gravity = fields.vec3("gravity", scene.world.gravity, {-1000, 1000});
  Fields bounds(fields.require("bounds"));
  scene.world.bounds.min = bounds.require("min").vec3(any_place);
  const Node max = bounds.require("max");
  scene.world.bounds.max = max.vec3(any_place);
  for (std::size_t d = 0; d < 3; ++d)
    if (!(scene.world.bounds.min[d] < scene.world.bounds.max[d]))
      max.fail("must be greater than \"min\" on every axis");
  bounds.finish();
  if (const auto seed = fields.find("seed")) scene.world.seed = seed->count();
  fields.finish();
}

void load_solver(const Node& node, Scene& scene) {
  Fields fields(node);
  scene.solver.iterations = fields.integer("iterations", scene.solver.iterations, 1, 1000);
  scene.solver.split_impulse = fields.boolean("split_impulse", scene.solver.split_impulse);
  scene.solver.cache_friction = fields.boolean("cache_friction", scene.solver.cache_friction);
  fields.finish();
}

void load_broadphase(const Node& node, Scene& scene) {
  Fields fields(node);
  const std::vector<std::string>& known = broadphase_names();
  scene.broadphase.kind = known[fields.require("kind").choice(known)];
  fields.finish();
}

void load_materials(const Node& node, Names& names) {
  Fields block(node);
  for (const auto& [name, value] : node.json().items()) {
    Fields fields(block.require(name));
    Material material;
    material.friction = fields.number("friction", material.friction, {0, 100});
    material.rolling = fields.number("rolling", material.rolling, {0, 100});
    material.spinning = fields.number("spinning", material.spinning, {0, 100});
    material.restitution = fields.number("restitution", material.restitution, {0, 1});
    fields.finish();
    names.materials.emplace(name, material);
  }
}

void load_sensors(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 10'000)) {
    Fields fields(item);
    Sensor sensor;
    sensor.name = fields.text("name", "");
    sensor.half_extents = fields.require("half_extents").vec3(any_size);
    sensor.position = fields.require("position").vec3(any_place);
    fields.finish();
    scene.sensors.push_back(std::move(sensor));
  }
}

void load_fields(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    fields.require("type").choice({"swirl"});
    SwirlField swirl;
    swirl.centre = fields.vec3("centre", swirl.centre, any_place);
    swirl.radius = fields.number("radius", any_size);
    swirl.height = fields.number("height", any_size);
    swirl.speed = fields.number("speed", any_velocity);
    swirl.updraft = fields.number("updraft", any_velocity);
    swirl.rate = fields.number("rate", {0, 100});
    fields.finish();
    scene.fields.emplace_back(swirl);
  }
}

void load_queries(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    fields.require("type").choice({"rays"});
    RayFan fan;
    fan.count = fields.require("count").integer(1, max_count);
    fan.from = fields.require("from").vec3(any_place);
    fan.radius = fields.number("radius", any_size);
    fan.drop = fields.number("drop", any_size);
    fan.degrees = fields.number("degrees", fan.degrees, {-360, 360});
    fields.finish();
    scene.queries.emplace_back(fan);
  }
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name) {
  const nlohmann::json document = parse_json(text, name);
  const Node root(document, "", name);
  Fields fields(root);
  fields.require("format").integer(1, 1);

  Scene scene;
  scene.file = name;
  Names names;
  load_meta(fields.require("meta"), scene);
  load_time(fields.require("time"), scene);
  load_world(fields.require("world"), scene);
  if (const auto node = fields.find("solver")) load_solver(*node, scene);
  if (const auto node = fields.find("broadphase")) load_broadphase(*node, scene);
  if (const auto node = fields.find("materials")) load_materials(*node, names);
  if (const auto node = fields.find("shapes")) load_shapes(*node, scene, names);
  if (const auto node = fields.find("bodies")) load_bodies(*node, scene, names);
  if (const auto node = fields.find("generators")) load_generators(*node, scene, names);
  if (const auto node = fields.find("joints")) load_joints(*node, scene, names);
  if (const auto node = fields.find("sensors")) load_sensors(*node, scene);
  if (const auto node = fields.find("characters")) load_characters(*node, scene);
  if (const auto node = fields.find("soft_bodies")) load_soft_bodies(*node, scene);
  if (const auto node = fields.find("fields")) load_fields(*node, scene);
  if (const auto node = fields.find("queries")) load_queries(*node, scene);
  if (const auto node = fields.find("expect")) load_expect(*node, scene);
  fields.finish();
  return scene;
}

Scene load_scene(const std::string& path) {
  return parse_scene(read_text_file(path), path);
}

}  // namespace boxstream::scenes
