// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fcl/math/bv/AABB.h>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/float_environment.hpp>

namespace boxstream::fcl::detail {

/// The core's box for one of FCL's, grown by `reach` on all sides (rounded outward). A NaN bound is no bound, as in
/// AABB::overlap, whose comparisons it fails; a box that is inside out stays so and pairs with nothing.
template <class S>
BasicAabb<S> box_of(const ::fcl::AABB<S>& aabb, S reach) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  const boxstream::detail::DefaultFloatEnvironment environment;
  BasicAabb<S> box = {{aabb.min_[0], aabb.min_[1], aabb.min_[2]}, {aabb.max_[0], aabb.max_[1], aabb.max_[2]}};
  if (!is_valid(box))
    for (int d = 0; d < 3; ++d) {
      if (std::isnan(box.min[d])) box.min[d] = -inf;
      if (std::isnan(box.max[d])) box.max[d] = inf;
    }
  if (!(reach > 0) || !is_valid(box)) return box;
  box = expanded(box, reach);
  for (int d = 0; d < 3; ++d) {
    box.min[d] = std::nextafter(box.min[d], -inf);
    box.max[d] = std::nextafter(box.max[d], inf);
  }
  return box;
}

/// Bit for bit.
template <class S>
inline bool is_same(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  constexpr std::size_t words = sizeof(a) / sizeof(std::uint64_t);
  std::uint64_t x[words], y[words], different = 0;
  std::memcpy(x, &a, sizeof(x));
  std::memcpy(y, &b, sizeof(y));
  for (std::size_t i = 0; i < words; ++i) different |= x[i] ^ y[i];
  return different == 0;
}

/// Inside out on every axis: pairs with nothing.
template <class S>
constexpr BasicAabb<S> no_box() {
  constexpr S inf = std::numeric_limits<S>::infinity();
  return {{inf, inf, inf}, {-inf, -inf, -inf}};
}

/// `overlaps` without branches: which of the six comparisons fails first is anybody's guess.
template <class S>
inline bool touch(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  return (a.min[0] <= b.max[0]) & (b.min[0] <= a.max[0]) & (a.min[1] <= b.max[1]) & (b.min[1] <= a.max[1]) &
         (a.min[2] <= b.max[2]) & (b.min[2] <= a.max[2]);
}

}  // namespace boxstream::fcl::detail
