// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>

#include <LinearMath/btVector3.h>

#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Three numbers and one more, which are computed and compared by a few instructions. Not to be passed or returned by
/// value, for which compilers have more than one way.
typedef btScalar Lanes __attribute__((vector_size(4 * sizeof(btScalar))));
/// All bits or none for each lane, as comparisons give them.
using LaneMasks = decltype(Lanes() < Lanes());

/// The fourth numbers are any.
struct BoxLanes {
  BoxLanes(const btVector3& lo, const btVector3& hi) {
    std::memcpy(&min, lo.m_floats, sizeof min);
    std::memcpy(&max, hi.m_floats, sizeof max);
  }
  Lanes min, max;
};

inline bool has_any(const LaneMasks& masks) {
  using Halves __attribute__((vector_size(sizeof(LaneMasks)))) = long long;
  const auto halves = Halves(masks);
  long long any = 0;
  for (std::size_t i = 0; i < sizeof(Halves) / sizeof(long long); ++i) any |= halves[i];
  return any != 0;
}
inline bool has_any_of_three(const LaneMasks& masks) {
  return has_any(masks & LaneMasks{-1, -1, -1, 0});
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
