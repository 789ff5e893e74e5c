// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <variant>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

struct BallJoint {
  static constexpr const char* kind = "ball";
  Vec3 pivot;
};
/// Drives a joint along its axis.
struct Motor {
  double speed;      // rad/s or m/s
  double max_force;  // N m or N

  /// Without force it is none. Where a joint is at a limit, Bullet would let its speed count all the same.
  bool acts() const { return max_force > 0; }
};
struct HingeJoint {
  static constexpr const char* kind = "hinge";
  Vec3 pivot;
  Vec3 axis;
  std::optional<std::array<double, 2>> limits{};  // radians
  std::optional<Motor> motor{};
};
/// `axis` is the twist axis; swing is about the two others.
struct ConeTwistJoint {
  static constexpr const char* kind = "cone_twist";
  Vec3 pivot;
  Vec3 axis;
  double swing1;
  double swing2;
  double twist;
};
struct SliderJoint {
  static constexpr const char* kind = "slider";
  Vec3 pivot;
  Vec3 axis;
  std::optional<std::array<double, 2>> limits{};  // metres
  std::optional<Motor> motor{};
};
struct FixedJoint {
  static constexpr const char* kind = "fixed";
  Vec3 pivot;
};
/// Six degrees of freedom along world axes; an axis without limits is locked, one whose low limit is above its high one
/// is free.
struct SixDofJoint {
  static constexpr const char* kind = "6dof";
  Vec3 pivot;
  std::array<std::array<double, 2>, 3> linear{};   // metres
  std::array<std::array<double, 2>, 3> angular{};  // radians
};
/// Pulls the pivot back to where it was, along world axes; turning is free.
struct SpringJoint {
  static constexpr const char* kind = "spring";
  Vec3 pivot;
  double stiffness;  // N/m
  double damping;    // N s/m
};
/// Makes two bodies turn together, each about an axis of its own, which other joints hold: wheels with teeth, or a
/// belt.
struct GearJoint {
  static constexpr const char* kind = "gear";
  Vec3 pivot;
  Vec3 axis;     // of a
  Vec3 axis_b;   // of b
  double ratio;  // turns of a for one of b, the other way round; below 0: the same way, as a belt does
};
using JointValue =
    std::variant<BallJoint, HingeJoint, ConeTwistJoint, SliderJoint, FixedJoint, SixDofJoint, SpringJoint, GearJoint>;

/// Places and axes are in world coordinates at the start. Angles and travel are those of `a` as seen from `b`, positive
/// about and along the axis, and 0 at the start however the bodies are turned against each other.
struct Joint {
  std::size_t a = 0;             // index of a body
  std::optional<std::size_t> b;  // none: the world
  JointValue value;
  bool collide = false;  // may the two bodies touch each other?
};

}  // namespace boxstream::scenes
