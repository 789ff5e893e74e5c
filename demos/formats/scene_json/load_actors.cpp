// SPDX-License-Identifier: MIT
#include <numbers>
#include <set>

#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

std::vector<Wheel> read_wheels(const Node& node) {
  std::vector<Wheel> wheels;
  for (const Node& item : node.list(1, 64)) {
    Fields fields(item);
    Wheel& wheel = wheels.emplace_back();
    wheel.at = fields.require("at").vec3(any_place);
    wheel.radius = fields.number("radius", wheel.radius, any_size);
    wheel.steered = fields.boolean("steered", wheel.steered);
    wheel.driven = fields.boolean("driven", wheel.driven);
    fields.finish();
  }
  return wheels;
}

}  // namespace

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

void load_characters(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    Character character;
    character.name = fields.text("name", "");
    character.radius = fields.number("radius", character.radius, any_size);
    character.height = fields.number("height", character.height, any_size);
    character.step = fields.number("step", character.step, {0, max_length});
    character.speed = fields.number("speed", character.speed, {0, max_speed});
    character.push = fields.number("push", character.push, any_force);
    character.jump_speed = fields.number("jump_speed", character.jump_speed, {0, 1000});
    character.jump_every = fields.integer("jump_every", character.jump_every, 0, max_count);
    for (const Node& place : fields.require("path").list(1, 10'000)) character.path.push_back(place.vec3(any_place));
    fields.finish();
    scene.characters.push_back(std::move(character));
  }
}

void load_vehicles(const Node& node, Scene& scene, const Names& names) {
  std::set<std::size_t> taken;
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    Vehicle vehicle;
    const Node chassis = fields.require("chassis");
    vehicle.chassis = look_up(names.bodies, chassis, "body");
    if (scene.bodies[vehicle.chassis].traits.type != BodyType::dynamic) chassis.fail("a chassis is a dynamic body");
    if (!taken.insert(vehicle.chassis).second) chassis.fail("a second vehicle on this chassis");
    vehicle.wheels = read_wheels(fields.require("wheels"));
    vehicle.suspension = fields.number("suspension", vehicle.suspension, any_size);
    vehicle.stiffness = fields.number("stiffness", vehicle.stiffness, positive(1e6));
    vehicle.grip = fields.number("grip", vehicle.grip, {0, 1e6});
    vehicle.engine = fields.number("engine", vehicle.engine, {-any_force.high, any_force.high});
    vehicle.brake = fields.number("brake", vehicle.brake, any_force);
    vehicle.steer = fields.number("steer", 0, {-90, 90}) * std::numbers::pi / 180;
    fields.finish();
    scene.vehicles.push_back(std::move(vehicle));
  }
}

namespace {

struct ReadSoft {
  Fields& fields;

  void operator()(ClothSoft& cloth) const {
    const std::vector<Node> corners = fields.require("corners").list(4, 4);
    for (std::size_t i = 0; i < 4; ++i) cloth.corners[i] = corners[i].vec3(any_place);
    const std::vector<Node> resolution = fields.require("resolution").list(2, 2);
    cloth.resolution = {resolution[0].integer(2, 1000), resolution[1].integer(2, 1000)};
    if (const auto pinned = fields.find("pinned"))
      for (const Node& corner : pinned->list(0, 4)) cloth.pinned |= 1 << corner.integer(0, 3);
  }
  void operator()(BallSoft& ball) const {
    ball.centre = fields.require("centre").vec3(any_place);
    ball.radius = fields.number("radius", any_size);
    ball.resolution = fields.integer("resolution", 128, 8, 100'000);
    ball.pressure = fields.number("pressure", 0, {0, 1e7});
  }
};

}  // namespace

void load_soft_bodies(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    SoftBody soft;
    soft.name = fields.text("name", "");
    soft.mass = fields.number("mass", positive(max_mass));
    soft.stiffness = fields.number("stiffness", soft.stiffness, {0, 1});
    soft.damping = fields.number("damping", soft.damping, {0, 1});
    soft.friction = fields.number("friction", soft.friction, {0, 1});
    soft.margin = fields.number("margin", soft.margin, any_size);
    soft.iterations = fields.integer("iterations", soft.iterations, 1, 100);
    read_kind(fields, soft.value, ReadSoft{fields});
    fields.finish();
    scene.soft_bodies.push_back(std::move(soft));
  }
}

}  // namespace boxstream::scenes
