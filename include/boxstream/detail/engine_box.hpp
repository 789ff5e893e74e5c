// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>
#include <cstring>
#include <limits>

#include <boxstream/aabb.hpp>

namespace boxstream::detail {

/// Without a comparison of floats, which could trap.
inline bool is_nan_bits(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof(x));
  return (bits & 0x7fffffffu) > 0x7f800000u;
}
inline bool is_nan_bits(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof(x));
  return (bits & 0x7fffffffffffffffu) > 0x7ff0000000000000u;
}

template <class S>
BasicAabb<S> without_nan(BasicAabb<S> box) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  for (int d = 0; d < 3; ++d) {
    if (is_nan_bits(box.min[d])) box.min[d] = -inf;
    if (is_nan_bits(box.max[d])) box.max[d] = inf;
  }
  return box;
}

/// The core's box for an engine's with min_ and max_, bound by bound. A NaN bound is no bound, as in comparisons that
/// it fails; a box that is inverted stays so and pairs with nothing.
template <class S, class EngineBox>
BasicAabb<S> box_of_engine(const EngineBox& aabb) {
  BasicAabb<S> box{{aabb.min_[0], aabb.min_[1], aabb.min_[2]}, {aabb.max_[0], aabb.max_[1], aabb.max_[2]}};
  bool has_nan = false;
  for (int d = 0; d < 3; ++d) has_nan = has_nan || is_nan_bits(box.min[d]) || is_nan_bits(box.max[d]);
  return has_nan ? without_nan(box) : box;
}

}  // namespace boxstream::detail
