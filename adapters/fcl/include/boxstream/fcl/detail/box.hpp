// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include <fcl/math/bv/AABB.h>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/engine_box.hpp>
#include <boxstream/detail/float_environment.hpp>

namespace boxstream::fcl::detail {

/// By `reach` >= 0 on all sides, rounded outward. A box that is inverted stays so.
template <class S>
BasicAabb<S> grown(BasicAabb<S> box, S reach) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  const boxstream::detail::DefaultFloatEnvironment environment;
  if (!(reach > 0) || !is_valid(box)) return box;
  box = expanded(box, reach);
  for (int d = 0; d < 3; ++d) {
    box.min[d] = std::nextafter(box.min[d], -inf);
    box.max[d] = std::nextafter(box.max[d], inf);
  }
  return box;
}

/// Bound by bound.
template <class S>
inline BasicAabb<S> copy_of(const ::fcl::AABB<S>& aabb) {
  return {{aabb.min_[0], aabb.min_[1], aabb.min_[2]}, {aabb.max_[0], aabb.max_[1], aabb.max_[2]}};
}

/// The core's box for one of FCL's. A NaN bound is no bound, as in AABB::overlap, whose comparisons it fails; a box
/// that is inverted stays so and pairs with nothing.
template <class S>
inline BasicAabb<S> box_of(const ::fcl::AABB<S>& aabb) {
  return boxstream::detail::box_of_engine<S>(aabb);
}

}  // namespace boxstream::fcl::detail
