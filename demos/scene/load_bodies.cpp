// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "scene/load_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr Range any_damping{0, 1};

bool only_fixed(const ShapeValue& shape) {
  return std::holds_alternative<PlaneShape>(shape) || std::holds_alternative<HeightfieldShape>(shape) ||
         std::holds_alternative<MeshShape>(shape);
}

std::optional<std::uint32_t> read_bits(Fields& fields, const std::string& key) {
  const auto node = fields.find(key);
  if (!node) return std::nullopt;
  // Bullet keeps these in an int.
  const std::uint64_t bits = node->count();
  if (bits > 0x7fffffff) node->fail("must be at most 2147483647, got " + std::to_string(bits));
  return static_cast<std::uint32_t>(bits);
}

}  // namespace

Vec3 read_direction(const Node& node) {
  const Vec3 v = node.vec3({-1e6, 1e6});
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(length > 1e-6)) node.fail("a direction must not be zero");
  return {v[0] / length, v[1] / length, v[2] / length};
}

Quat read_rotation(Fields& fields) {
  const auto node = fields.find("rotation");
  if (!node) return {0, 0, 0, 1};
  Fields turn(*node);
  const Vec3 axis = read_direction(turn.require("axis"));
  const double half = turn.number("degrees", {-360, 360}) * std::numbers::pi / 360;
  turn.finish();
  const double s = std::sin(half);
  return {axis[0] * s, axis[1] * s, axis[2] * s, std::cos(half)};
}

Material read_material(Fields& fields, const Names& names) {
  const auto node = fields.find("material");
  return node ? look_up(names.materials, *node, "material") : Material{};
}

BodyTraits read_traits(Fields& fields, const Scene& scene, const Names& names, bool may_be_fixed) {
  BodyTraits traits;
  const Node shape = fields.require("shape");
  traits.shape = look_up(names.shapes, shape, "shape");
  traits.material = read_material(fields, names);
  if (may_be_fixed)
    if (const auto type = fields.find("type"))
      traits.type = std::array{BodyType::fixed, BodyType::kinematic,
                               BodyType::dynamic}[type->choice({"static", "kinematic", "dynamic"})];
  if (only_fixed(scene.shapes[traits.shape].value) && traits.type != BodyType::fixed)
    shape.fail("this kind of shape is for static bodies only");

  const auto mass = fields.find("mass");
  const auto density = fields.find("density");
  if (traits.type == BodyType::dynamic) {
    if (mass && density) density->fail("give \"mass\" or \"density\", not both");
    if (mass) {
      traits.mass = mass->number(positive(max_mass));
    } else if (density) {
      traits.density = density->number(positive(1e5));
    } else {
      fields.node().fail("a dynamic body needs \"mass\" or \"density\"");
    }
  } else if (mass || density) {
    (mass ? mass : density)->fail("only dynamic bodies have mass");
  }
  traits.linear_damping = fields.number("linear_damping", 0, any_damping);
  traits.angular_damping = fields.number("angular_damping", 0, any_damping);
  traits.group = read_bits(fields, "group");
  traits.mask = read_bits(fields, "mask");
  if (const auto node = fields.find("ccd")) {
    Fields ccd(*node);
    traits.ccd = Ccd{ccd.number("threshold", any_size), ccd.number("radius", any_size)};
    ccd.finish();
  }
  traits.sleep = fields.boolean("sleep", true);
  return traits;
}

void load_bodies(const Node& node, Scene& scene, Names& names) {
  for (const Node& item : node.list(0, max_count)) {
    Fields fields(item);
    Body body;
    if (const auto name = fields.find("name")) {
      body.name = name->text();
      if (!names.bodies.emplace(body.name, scene.bodies.size()).second)
        name->fail("a second body called \"" + body.name + "\"");
    }
    body.traits = read_traits(fields, scene, names, true);
    body.position = fields.vec3("position", body.position, any_place);
    body.rotation = read_rotation(fields);
    if (body.traits.type != BodyType::fixed) {
      body.velocity = fields.vec3("velocity", body.velocity, any_velocity);
      body.spin = fields.vec3("spin", body.spin, any_velocity);
    }
    fields.finish();
    scene.bodies.push_back(std::move(body));
  }
}

void load_joints(const Node& node, Scene& scene, const Names& names) {
  constexpr double radians = std::numbers::pi / 180;
  for (const Node& item : node.list(0, max_count)) {
    Fields fields(item);
    Joint joint;
    const auto body = [&](const Node& name) {
      const std::size_t index = look_up(names.bodies, name, "body");
      if (scene.bodies[index].traits.type == BodyType::fixed)
        name.fail("a joint to a static body: leave it out instead");
      return index;
    };
    joint.a = body(fields.require("a"));
    if (const auto b = fields.find("b")) {
      joint.b = body(*b);
      if (*joint.b == joint.a) b->fail("a body joined to itself");
    }
    joint.collide = fields.boolean("collide", false);
    const Vec3 pivot = fields.require("pivot").vec3(any_place);
    switch (fields.require("type").choice({"ball", "hinge", "cone_twist"})) {
      case 0:
        joint.value = BallJoint{pivot};
        break;
      case 1: {
        HingeJoint hinge{pivot, read_direction(fields.require("axis")), std::nullopt};
        if (const auto limits = fields.find("limits")) {
          const std::array<double, 2> degrees = limits->pair({-180, 180});
          hinge.limits = {degrees[0] * radians, degrees[1] * radians};
        }
        joint.value = hinge;
        break;
      }
      case 2: {
        const Vec3 axis = read_direction(fields.require("axis"));
        joint.value =
            ConeTwistJoint{pivot, axis, fields.number("swing1", {0, 180}) * radians,
                           fields.number("swing2", {0, 180}) * radians, fields.number("twist", {0, 180}) * radians};
        break;
      }
    }
    fields.finish();
    scene.joints.push_back(joint);
  }
}

}  // namespace boxstream::scenes
