// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include <LinearMath/btVector3.h>

#include <boxstream/bullet/precision.hpp>

#include "lanes.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// A ray as most are, compared with a box by vectors: no direction is zero or infinite, and nothing overflows. For the
/// default floating-point environment. Finds what the World does.
class PlainRay {
 public:
  /// `length` is not negative.
  PlainRay(const btVector3& origin, const btVector3& inverse, btScalar length, const btVector3& extent_min,
           const btVector3& extent_max)
      : origin_{origin.x(), origin.y(), origin.z(), 0},
        inverse_{inverse.x(), inverse.y(), inverse.z(), 1},
        reach_of_min_{extent_max.x(), extent_max.y(), extent_max.z(), 0},
        reach_of_max_{extent_min.x(), extent_min.y(), extent_min.z(), 0},
        length_(length) {}

  /// Otherwise the World is to be asked. A comparison with what is not a number is false.
  bool is_plain() const {
    constexpr btScalar most = std::numeric_limits<btScalar>::max(), far = most / 16;
    const LaneMasks is_near = (origin_ <= far) & (origin_ >= -far) & (reach_of_min_ <= far) & (reach_of_max_ >= -far);
    const LaneMasks is_box = reach_of_max_ <= reach_of_min_;
    const LaneMasks turns = (inverse_ <= most) & (inverse_ >= -most);
    const Lanes one = {1, 1, 1, 1}, at_most_one = inverse_ < one ? inverse_ : one;
    const Lanes turn = at_most_one > -one ? at_most_one : -one;
    const LaneMasks stays_near = (length_ < far * turn) | (length_ < -far * turn);  // false if it does not turn
    return !has_any(~(is_near & is_box & turns & stays_near));
  }

  /// Whether it meets a valid box. Without a branch for each direction, which would have to be guessed: the order of
  /// two crossings says which one is near.
  bool meets(const BoxLanes& box) const {
    const Lanes at_min = (box.min - reach_of_min_ - origin_) * inverse_;
    const Lanes at_max = (box.max - reach_of_max_ - origin_) * inverse_;
    const Lanes near = at_min < at_max ? at_min : at_max, far = at_min > at_max ? at_min : at_max;
    const btScalar enter = std::max(std::max(near[0], near[1]), std::max(btScalar(0), near[2]));
    const btScalar leave = std::min(std::min(far[0], far[1]), std::min(length_, far[2]));
    return enter <= leave;
  }

 private:
  Lanes origin_, inverse_, reach_of_min_, reach_of_max_;
  btScalar length_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
