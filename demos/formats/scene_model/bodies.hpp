// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

struct Material {
  double friction = 0.5;
  double rolling = 0;
  double spinning = 0;
  double restitution = 0;
  Vec3 anisotropic{1, 1, 1};  // friction along the body's own axes, as factors of `friction`
};

enum class BodyType { fixed, kinematic, dynamic };

/// How a spinning body turns by its inertia, if at all: so that energy and momentum stay, or by one of Bullet's three
/// torques.
enum class Gyro { off, conserving, explicit_step, implicit_world, implicit_body };

struct Ccd {
  double threshold;  // motion per step beyond which the body is swept
  double radius;     // of the sphere swept for it
};

/// What bodies made from one template share. Exactly one of mass and density is given for dynamic bodies.
struct BodyTraits {
  std::size_t shape = 0;
  Material material;
  BodyType type = BodyType::dynamic;
  std::optional<double> mass;
  std::optional<double> density;
  double linear_damping = 0;
  double angular_damping = 0;
  std::optional<std::uint32_t> group;
  std::optional<std::uint32_t> mask;
  std::optional<Ccd> ccd;  // absent: as speed and thickness call for
  bool may_ccd = true;     // "ccd": false rules it out
  bool sleep = true;
  std::optional<Gyro> gyro;  // absent: as spin and inertia call for
};

struct Body {
  std::string name;  // may be empty
  BodyTraits traits;
  Vec3 position{};
  Quat rotation{0, 0, 0, 1};
  Vec3 velocity{};
  Vec3 spin{};                    // rad/s
  std::optional<Vec3> inertia{};  // kg m^2 about its own axes; absent: that of its shape, along whatever axes it is
  Vec3 products{};                // of inertia, with `inertia`: xy, xz, yz of the tensor
  std::optional<Vec3> centre{};   // of mass; absent: that of its shape, or the origin if inertia is given
  bool late = false;              // not in the world at the start
  Vec3 surface_velocity{};        // of a fixed body, m/s along its own axes: a conveyor
};

}  // namespace boxstream::scenes
