// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include <boxstream/aabb.hpp>
#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

inline constexpr btScalar largest_moderate = btScalar(1e18);

/// Valid, and of numbers of which differences and multiples are finite.
inline bool is_moderate(const BasicAabb<btScalar>& box) {
  bool is = true;
  for (int d = 0; d < 3; ++d)
    is = is && -largest_moderate < box.min[d] && box.min[d] <= box.max[d] && box.max[d] < largest_moderate;
  return is;
}

/// By which a fat box is wider on each side, of a moderate box.
inline btScalar usual_margin(const BasicAabb<btScalar>& box) {
  btScalar least = largest_moderate, most = 0;
  for (int d = 0; d < 3; ++d) {
    least = std::min(least, box.max[d] - box.min[d]);
    most = std::max(most, box.max[d] - box.min[d]);
  }
  return std::max(least / 8, most / 64);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
