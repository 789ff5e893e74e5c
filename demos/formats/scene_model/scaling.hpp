// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// What generators of a scaled scene may make at most.
inline constexpr std::size_t most_scaled_bodies = 4'000'000;

/// By what a scaled scene is larger than the one it is made from.
struct Scaling {
  double factor;  // of counts
  bool self_similar;
  double side = std::cbrt(factor);
  double face = std::sqrt(factor);

  [[noreturn]] static void fail() {
    throw std::invalid_argument("that makes more than " + std::to_string(most_scaled_bodies) + " bodies");
  }
  /// `count` scaled by `by`, at least `least`.
  static int times(int count, double by, int least = 1) {
    const double scaled = std::round(count * by);
    if (scaled > static_cast<double>(most_scaled_bodies)) fail();
    return std::max(least, static_cast<int>(scaled));
  }
  /// Keeps the shape of a lattice, and never makes it so narrow that it grows taller than it was.
  static void columns(std::array<int, 2>& c, double by) {
    constexpr auto most = static_cast<double>(most_scaled_bodies);
    for (int& n : c) n = static_cast<int>(std::clamp(std::ceil(n * by), 1.0, most));
  }
  void room(Vec3& v) const { v = scenes::times(v, side); }
};

}  // namespace boxstream::scenes
