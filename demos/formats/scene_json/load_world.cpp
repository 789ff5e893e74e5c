// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"
#include "formats/scene_model/names.hpp"

namespace boxstream::scenes {
namespace {

constexpr Range any_acceleration{-1000, 1000};

TumblingGravity read_tumbling(const Node& node) {
  Fields fields(node);
  fields.require("script").choice({"tumble"});
  TumblingGravity tumbling;
  tumbling.strength = fields.number("strength", {0, any_acceleration.high});
  tumbling.degrees_per_second = fields.number("degrees_per_second", {-36'000, 36'000});
  fields.finish();
  return tumbling;
}

}  // namespace

Bounds read_bounds(const Node& node) {
  Fields fields(node);
  Bounds bounds;
  bounds.min = fields.require("min").vec3(any_place);
  const Node max = fields.require("max");
  bounds.max = max.vec3(any_place);
  for (std::size_t d = 0; d < 3; ++d)
    if (!(bounds.min[d] < bounds.max[d])) max.fail("must be greater than \"min\" on every axis");
  fields.finish();
  return bounds;
}

void load_time(const Node& node, Scene& scene) {
  Fields fields(node);
  Time& time = scene.time;
  time.dt = fields.number("dt", {1e-5, 0.1});
  time.substeps = fields.integer("substeps", time.substeps, 1, 1000);
  time.steps = fields.integer("steps", time.steps, 1, 10'000'000);
  time.warmup_steps = fields.integer("warmup_steps", time.warmup_steps, 0, 10'000'000);
  fields.finish();
}

void load_world(const Node& node, Scene& scene) {
  Fields fields(node);
  WorldSettings& world = scene.world;
  if (const auto gravity = fields.find("gravity")) {
    if (gravity->is_object()) {
      world.tumbling = read_tumbling(*gravity);
    } else {
      world.gravity = gravity->vec3(any_acceleration);
    }
  }
  world.bounds = read_bounds(fields.require("bounds"));
  if (const auto on_leave = fields.find("on_leave"))
    world.on_leave = static_cast<OnLeave>(on_leave->choice({"nothing", "freeze", "remove", "report"}));
  world.self_similar = fields.boolean("self_similar", world.self_similar);
  world.ccd = fields.boolean("ccd", world.ccd);
  if (const auto seed = fields.find("seed")) world.seed = seed->count();
  fields.finish();
}

void load_solver(const Node& node, Scene& scene) {
  Fields fields(node);
  Solver& solver = scene.solver;
  if (const auto kind = fields.find("kind")) solver.kind = static_cast<SolverKind>(kind->choice(solver_names()));
  if (const auto bounces = fields.find("bounces"))
    solver.bounces = static_cast<Bounces>(bounces->choice(bounces_names()));
  solver.iterations = fields.integer("iterations", solver.iterations, 1, 1000);
  solver.residual = fields.number("residual", solver.residual, {0, 1e6});
  solver.warmstart = fields.boolean("warmstart", solver.warmstart);
  solver.split_impulse = fields.boolean("split_impulse", solver.split_impulse);
  solver.cache_friction = fields.boolean("cache_friction", solver.cache_friction);
  solver.erp = fields.number("erp", solver.erp, {0, 1});
  solver.contact_erp = fields.number("contact_erp", solver.contact_erp, {0, 1});
  solver.slop = fields.number("slop", solver.slop, {0, 1000});
  if (const auto directions = fields.find("friction_directions"))
    solver.friction_directions = static_cast<FrictionDirections>(directions->choice(friction_directions_names()));
  if (const auto precision = fields.find("precision"))
    solver.precision = static_cast<Precision>(precision->choice(precision_names()));
  fields.finish();
}

void load_broadphase(const Node& node, Scene& scene) {
  Fields fields(node);
  BroadphaseSettings& broadphase = scene.broadphase;
  if (const auto kind = fields.find("kind")) {
    const std::vector<std::string>& known = broadphase_names();
    broadphase.kind = known[kind->choice(known)];
  }
  broadphase.threads = fields.integer("threads", broadphase.threads, 1, 256);
  broadphase.force_boxes = fields.boolean("force_boxes", broadphase.force_boxes);
  fields.finish();
}

void load_materials(const Node& node, Names& names) {
  constexpr Range any_friction{0, 100};
  Fields block(node);
  for (const auto& [name, value] : node.json().items()) {
    const Node item = block.require(name);
    if (name.empty()) item.fail("a material needs a name");
    Fields fields(item);
    Material material;
    material.friction = fields.number("friction", material.friction, any_friction);
    material.rolling = fields.number("rolling", material.rolling, any_friction);
    material.spinning = fields.number("spinning", material.spinning, any_friction);
    material.restitution = fields.number("restitution", material.restitution, {0, 1});
    material.anisotropic = fields.vec3("anisotropic", material.anisotropic, any_friction);
    fields.finish();
    names.materials.emplace(name, material);
  }
}

Material read_material(Fields& fields, const Names& names) {
  const auto node = fields.find("material");
  return node ? look_up(names.materials, *node, "material") : Material{};
}

}  // namespace boxstream::scenes
