// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// Random numbers that are the same on every platform: the engine is fixed by the C++ standard, and the mapping to
/// numbers is done here because the standard leaves that of std::uniform_real_distribution open.
class Random {
 public:
  explicit Random(std::uint64_t start) : engine_(start) {}

  /// In [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// In [low, high).
  double range(double low, double high) { return low + (high - low) * unit(); }
  /// In [low, high), every octave equally likely; 0 < low.
  double log_range(double low, double high);
  /// In [0, count), count > 0.
  std::uint64_t below(std::uint64_t count);
  /// Uniform in a ball around the origin.
  Vec3 in_ball(double radius);
  /// Uniform over all rotations.
  Quat rotation();

 private:
  std::mt19937_64 engine_;
};

}  // namespace boxstream::scenes
