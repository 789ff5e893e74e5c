// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <limits>

#include <boxstream/aabb.hpp>

namespace boxstream {

/// The segment { origin + t * direction : 0 <= t <= length }, stored by the inverse of its direction, swept by a box:
/// a proxy is hit when the segment meets the proxy's box grown to [min - extent_max, max - extent_min].
/// With zero extents it is a plain ray. The direction need not have unit length; `length` is in multiples of it.
template <class S>
struct BasicRay {
  S origin[3];
  S inverse_direction[3];  ///< +-infinity (or any huge value) where the direction is zero; with a zero, of a direction
                           ///< that is infinite, the segment is its origin
  S length;
  S extent_min[3] = {0, 0, 0};
  S extent_max[3] = {0, 0, 0};

  /// The segment from `origin` to origin + length * direction.
  static BasicRay along(const S (&origin)[3], const S (&direction)[3], S length) {
    BasicRay ray{};
    for (int d = 0; d < 3; ++d) {
      ray.origin[d] = origin[d];
      ray.inverse_direction[d] = inverse(direction[d]);
    }
    ray.length = length;
    return ray;
  }

  /// The box `box` on its way to box + translation; t runs from 0 to 1.
  static BasicRay sweep(const BasicAabb<S>& box, const S (&translation)[3]) {
    const S zero[3] = {0, 0, 0};
    BasicRay ray = along(zero, translation, S(1));
    for (int d = 0; d < 3; ++d) {
      ray.extent_min[d] = box.min[d];
      ray.extent_max[d] = box.max[d];
    }
    return ray;
  }

 private:
  /// Infinite where the quotient would overflow, without a division that does: hosts may trap it.
  static S inverse(S direction) {
    constexpr S inf = std::numeric_limits<S>::infinity(), tiny = std::numeric_limits<S>::min() / 4;
    if (direction == 0) return inf;
    if (direction == direction && -tiny <= direction && direction <= tiny) return direction < 0 ? -inf : inf;
    return 1 / direction;
  }
};

using Ray = BasicRay<float>;
using Ray64 = BasicRay<double>;

}  // namespace boxstream
