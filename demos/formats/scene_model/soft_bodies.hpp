// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <variant>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

struct ClothSoft {
  static constexpr const char* kind = "cloth";
  std::array<Vec3, 4> corners;  // 00, 10, 01, 11
  std::array<int, 2> resolution;
  int pinned = 0;  // bit per corner, in the order above
};
struct BallSoft {
  static constexpr const char* kind = "ball";
  Vec3 centre;
  double radius;
  int resolution;
  double pressure;
};

struct SoftBody {
  std::string name;
  double mass = 1;  // whole
  double stiffness = 0.9;
  double damping = 0.005;
  double friction = 0.5;
  double margin = 0.05;
  int iterations = 4;
  std::variant<ClothSoft, BallSoft> value;
};

}  // namespace boxstream::scenes
