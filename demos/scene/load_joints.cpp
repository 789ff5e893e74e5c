// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>
#include <set>

#include "scene/load_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr Range half_turns{-180, 180};

std::array<double, 2> scaled_by(double factor, const std::array<double, 2>& limits) {
  return {limits[0] * factor, limits[1] * factor};
}

std::optional<Motor> read_motor(Fields& fields) {
  const auto node = fields.find("motor");
  if (!node) return std::nullopt;
  Fields motor(*node);
  const Motor read{motor.number("speed", any_velocity), motor.number("max_force", any_force)};
  motor.finish();
  return read;
}

HingeJoint read_hinge(Fields& fields, const Vec3& pivot) {
  HingeJoint hinge{pivot, read_direction(fields.require("axis")), std::nullopt, std::nullopt};
  if (const auto limits = fields.find("limits")) hinge.limits = scaled_by(radians, limits->pair(half_turns));
  hinge.motor = read_motor(fields);
  return hinge;
}

ConeTwistJoint read_cone_twist(Fields& fields, const Vec3& pivot) {
  constexpr Range half_turn{0, 180};
  const Vec3 axis = read_direction(fields.require("axis"));
  const double swing1 = fields.number("swing1", half_turn) * radians;
  const double swing2 = fields.number("swing2", half_turn) * radians;
  return {pivot, axis, swing1, swing2, fields.number("twist", half_turn) * radians};
}

SliderJoint read_slider(Fields& fields, const Vec3& pivot) {
  SliderJoint slider{pivot, read_direction(fields.require("axis")), std::nullopt, std::nullopt};
  if (const auto limits = fields.find("limits")) slider.limits = limits->pair(any_place);
  slider.motor = read_motor(fields);
  return slider;
}

/// For each of three axes "free", "locked" or [low, high]; all are locked if absent.
std::array<std::array<double, 2>, 3> read_axes(Fields& fields, const char* key, Range range, double factor) {
  std::array<std::array<double, 2>, 3> axes{};
  const auto node = fields.find(key);
  if (!node) return axes;
  const std::vector<Node> items = node->list(3, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!items[i].is_string()) {
      axes[i] = scaled_by(factor, items[i].pair(range));
    } else if (items[i].choice({"free", "locked"}) == 0) {
      axes[i] = {1, -1};
    }
  }
  return axes;
}

SixDofJoint read_six_dof(Fields& fields, const Vec3& pivot) {
  SixDofJoint joint{pivot, {}, {}};
  joint.linear = read_axes(fields, "linear", any_place, 1);
  joint.angular = read_axes(fields, "angular", half_turns, radians);
  return joint;
}

SpringJoint read_spring(Fields& fields, const Vec3& pivot) {
  const double stiffness = fields.number("stiffness", any_force);
  return {pivot, stiffness, fields.number("damping", 0, any_force)};
}

JointValue read_value(Fields& fields) {
  const Vec3 pivot = fields.require("pivot").vec3(any_place);
  switch (fields.require("type").choice({"ball", "hinge", "cone_twist", "slider", "fixed", "6dof", "spring"})) {
    case 0:
      return BallJoint{pivot};
    case 1:
      return read_hinge(fields, pivot);
    case 2:
      return read_cone_twist(fields, pivot);
    case 3:
      return read_slider(fields, pivot);
    case 4:
      return FixedJoint{pivot};
    case 5:
      return read_six_dof(fields, pivot);
    default:
      return read_spring(fields, pivot);
  }
}

}  // namespace

void load_joints(const Node& node, Scene& scene, const Names& names) {
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
    joint.value = read_value(fields);
    fields.finish();
    scene.joints.push_back(joint);
  }
}

void load_apart(const Node& node, Scene& scene, const Names& names) {
  std::set<std::array<std::size_t, 2>> seen;
  for (const Node& item : node.list(0, max_count)) {
    const std::vector<Node> bodies = item.list(2, 2);
    const std::array<std::size_t, 2> pair{look_up(names.bodies, bodies[0], "body"),
                                          look_up(names.bodies, bodies[1], "body")};
    if (pair[0] == pair[1]) bodies[1].fail("a body apart from itself");
    if (!seen.insert({std::min(pair[0], pair[1]), std::max(pair[0], pair[1])}).second)
      item.fail("these two are named twice");
    scene.apart.push_back(pair);
  }
}

}  // namespace boxstream::scenes
