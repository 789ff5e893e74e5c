// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <boxstream/aabb.hpp>
#include <boxstream/ray.hpp>

namespace boxstream::papers {

/// Where a plain ray (no extents) enters a box, both closed: 0 if it starts inside, infinity if it misses. It rounds as
/// the engine's query does, and each step is monotone in the bounds: what contains a box is entered no later than it.
inline float ray_enter(const Ray& ray, const Aabb& box) {
  constexpr float miss = std::numeric_limits<float>::infinity();
  float enter = 0, leave = ray.length;
  for (int d = 0; d < 3; ++d) {
    const float below = box.min[d] - ray.origin[d], above = box.max[d] - ray.origin[d];
    if (std::isinf(ray.inverse_direction[d])) {
      if (below > 0 || above < 0) return miss;
      continue;
    }
    const bool backwards = ray.inverse_direction[d] < 0;
    const float near = (backwards ? above : below) * ray.inverse_direction[d];
    const float far = (backwards ? below : above) * ray.inverse_direction[d];
    enter = near > enter ? near : enter;
    leave = far < leave ? far : leave;
  }
  return enter <= leave ? enter : miss;
}

/// The first box on a ray: the smallest `enter`, and among equal ones the smallest number.
struct FirstHit {
  static constexpr std::uint32_t none = 0xffffffff;
  float enter = std::numeric_limits<float>::infinity();
  std::uint32_t number = none;

  /// `at` may be infinity: no hit.
  void offer(float at, std::uint32_t candidate) {
    if (at < enter || (at == enter && candidate < number && number != none)) *this = {at, candidate};
  }
  friend bool operator==(const FirstHit&, const FirstHit&) = default;
};

}  // namespace boxstream::papers
