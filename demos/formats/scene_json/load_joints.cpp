// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>
#include <set>

#include "formats/scene_json/load_parts.hpp"

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

/// Reads all but the pivot, which every joint has.
struct ReadJoint {
  Fields& fields;

  void operator()(BallJoint&) const {}
  void operator()(HingeJoint& hinge) const {
    hinge.axis = read_direction(fields.require("axis"));
    if (const auto limits = fields.find("limits")) hinge.limits = scaled_by(radians, limits->pair(half_turns));
    hinge.motor = read_motor(fields);
  }
  void operator()(ConeTwistJoint& cone) const {
    constexpr Range half_turn{0, 180};
    cone.axis = read_direction(fields.require("axis"));
    cone.swing1 = fields.number("swing1", half_turn) * radians;
    cone.swing2 = fields.number("swing2", half_turn) * radians;
    cone.twist = fields.number("twist", half_turn) * radians;
  }
  void operator()(SliderJoint& slider) const {
    slider.axis = read_direction(fields.require("axis"));
    if (const auto limits = fields.find("limits")) slider.limits = limits->pair(any_place);
    slider.motor = read_motor(fields);
  }
  void operator()(FixedJoint&) const {}
  void operator()(SixDofJoint& joint) const {
    joint.linear = read_axes(fields, "linear", any_place, 1);
    joint.angular = read_axes(fields, "angular", half_turns, radians);
  }
  void operator()(SpringJoint& spring) const {
    spring.stiffness = fields.number("stiffness", any_force);
    spring.damping = fields.number("damping", 0, any_force);
  }
  void operator()(GearJoint& gear) const {
    constexpr Range any_ratio{-1000, 1000};
    gear.axis = read_direction(fields.require("axis"));
    const auto other = fields.find("axis_b");
    gear.axis_b = other ? read_direction(*other) : gear.axis;
    const Node ratio = fields.require("ratio");
    gear.ratio = ratio.number(any_ratio);
    if (gear.ratio == 0) ratio.fail("must not be zero");
  }
};

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
    const Vec3 pivot = fields.require("pivot").vec3(any_place);
    read_kind(fields, joint.value, ReadJoint{fields});
    if (std::holds_alternative<GearJoint>(joint.value) && !joint.b) item.fail("a gear needs \"b\"");
    std::visit([&](auto& value) { value.pivot = pivot; }, joint.value);
    fields.finish();
    scene.joints.push_back(joint);
  }
}

void load_exclusions(const Node& node, Scene& scene, const Names& names) {
  std::set<std::array<std::size_t, 2>> seen;
  for (const Node& item : node.list(0, max_count)) {
    const std::vector<Node> bodies = item.list(2, 2);
    const std::array<std::size_t, 2> pair{look_up(names.bodies, bodies[0], "body"),
                                          look_up(names.bodies, bodies[1], "body")};
    if (pair[0] == pair[1]) bodies[1].fail("a body apart from itself");
    if (!seen.insert({std::min(pair[0], pair[1]), std::max(pair[0], pair[1])}).second)
      item.fail("these two are named twice");
    scene.exclusions.push_back(pair);
  }
}

}  // namespace boxstream::scenes
