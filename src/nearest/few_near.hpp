// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include <boxstream/aabb.hpp>

#include "nearest/box_walk.hpp"
#include "nearest/nearest_distance.hpp"

namespace boxstream::detail {

/// Zero, but compilers do not know it: they make a branch of a choice between zero and a number that is then squared,
/// and which of two boxes comes first on an axis is unpredictable.
template <class S>
S some_zero() {
  S zero = 0;
#if defined(__GNUC__)
  __asm__("" : "+m"(zero));
#endif
  return zero;
}

/// The squared distance of two boxes, about: what `lanes_near` gives for lanes. In the default environment.
template <class S>
S about_squared(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  const S zero = some_zero<S>();
  S sum = 0;
  for (int d = 0; d < 3; ++d) {
    const S below = a.min[d] - b.max[d], above = b.min[d] - a.max[d];
    // If one is NaN, from infinities that cancel, the other one is not above zero.
    const S larger = below > above ? below : above, gap = larger > zero ? larger : zero;
    sum += gap * gap;
  }
  return sum;
}

/// Very few boxes, or pairs of them, by their distance: less work than to put boxes into blocks.
template <class S>
class FewNear {
 public:
  static constexpr std::size_t most = NearLanes<S>::width;

  unsigned count() const { return count_; }

  /// Numbers are different, and below `most`.
  void add(unsigned number, S squared) { keys_[count_++] = NearLanes<S>::key_at(squared, number); }

  /// One that is nearer than the limit and has none before it, as it touches or is alone; or `most`.
  unsigned first(const NearLimit<S>& limit) const {
    if (count_ == 1 && limit.is_clearly_above(NearLanes<S>::squared_of(keys_[0])))
      return NearLanes<S>::lane_of(keys_[0]);
    unsigned i = 0;
    while (i < count_ && keys_[i] > NearLanes<S>::lane_bits) ++i;
    return i < count_ ? NearLanes<S>::lane_of(keys_[i]) : unsigned{most};
  }

  /// Calls `visit(number)` for those nearer than the limit, nearest first, about. It returns the limit from now on.
  /// `distance_of(number)` is asked where the square does not tell. In the caller's environment: what is compared here
  /// is compared as integers.
  template <class DistanceOf, class Visit>
  void visit(NearLimit<S> limit, DistanceOf&& distance_of, Visit&& visit) {
    for (unsigned left = count_; left != 0 && !limit.is_over();) {
      unsigned nearest = 0;
      for (unsigned i = 1; i < left; ++i) nearest = keys_[i] < keys_[nearest] ? i : nearest;
      const auto key = std::exchange(keys_[nearest], keys_[--left]);
      const S squared = NearLanes<S>::squared_of(key);
      const unsigned number = NearLanes<S>::lane_of(key);
      if (!limit.reaches(squared)) return;
      if (!limit.is_clearly_above(squared) && !limit.is_above(distance_of(number))) continue;
      const S next = visit(number);
      if (left != 0 && !limit.is(next)) limit.set(next);
    }
  }

 private:
  unsigned count_ = 0;
  typename NearLanes<S>::Key keys_[most];
};

}  // namespace boxstream::detail
