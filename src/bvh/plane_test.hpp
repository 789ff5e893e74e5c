// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include <boxstream/aabb.hpp>
#include <boxstream/plane.hpp>

#include "bvh/bvh_block.hpp"

namespace boxstream::detail {

/// A plane made ready for tests of boxes: scaled so that no sum can overflow, and its numbers rounded to the side on
/// which boxes are kept, by far more than the sums can be off in any rounding mode.
///
/// For each axis the coordinate that counts is taken in the direction of the normal: x = max where it points up,
/// x = -min where it points down. A positive x is multiplied by a little more than the normal's component, a negative
/// one by a little less. Every step is monotone in x, rounding and flushing included, so a box that contains another is
/// never behind where the inner one is not, and one that is before the plane with all its corners contains none that
/// is behind.
///
/// No number is small enough for a product, or a difference of products, to be denormal; and no infinity meets a zero
/// or another infinity. So nothing traps.
class PlaneTest {
 public:
  /// Has nothing behind it.
  PlaneTest() = default;
  template <class S>
  explicit PlaneTest(const BasicPlane<S>& plane);

  template <class S>
  bool has_behind(const BasicAabb<S>& box) const {
    return sum([&](int d) { return up_[d] ? box.max[d] : -box.min[d]; }) < 0;
  }

  /// True if no corner of the box is behind, so that nothing inside the box is.
  template <class S>
  bool has_before(const BasicAabb<S>& box) const {
    return sum([&](int d) { return up_[d] ? box.min[d] : -box.max[d]; }) >= 0;
  }

  /// The lanes that are not behind, empty ones included.
  template <class S>
  unsigned not_behind(const BoxBlock<S>& block) const {
    constexpr unsigned width = BoxBlock<S>::width;
    double sums[width];
    for (unsigned i = 0; i < width; ++i) sums[i] = offset_;
    for (int d = 0; d < 3; ++d) {
      if (more_[d] == 0) continue;
      if (up_[d])
        for (unsigned i = 0; i < width; ++i) sums[i] += term(block.hi[d][i], d);
      else
        for (unsigned i = 0; i < width; ++i) sums[i] += term(-block.lo[d][i], d);
    }
    unsigned bits = 0;
    for (unsigned i = 0; i < width; ++i) bits |= sums[i] >= 0 ? 1u << i : 0;
    return bits;
  }

 private:
  /// Bounds below this in magnitude count as this.
  template <class S>
  static constexpr S least = sizeof(S) == 4 ? S(0x1p-126) : S(0x1p-300);

  /// What x adds. At minus infinity the largest finite number stands in: it is enough, and can be added to infinity.
  template <class S>
  double term(S x, int axis) const {
    constexpr S most = std::numeric_limits<S>::max();
    x = x < -most ? -most : x;
    x = x > -least<S> && x < least<S> ? least<S> : x;
    const auto wide = static_cast<double>(x);
    return wide * (wide > 0 ? more_[axis] : less_[axis]);
  }

  /// Axis by axis in the same order as for blocks: equal numbers give equal sums.
  template <class Coordinate>
  double sum(Coordinate&& coordinate) const {
    double all = offset_;
    for (int d = 0; d < 3; ++d)
      if (more_[d] != 0) all += term(coordinate(d), d);
    return all;
  }

  double more_[3] = {};  // of the component's magnitude; 0: the axis does not matter
  double less_[3] = {};
  double offset_ = 0;
  bool up_[3] = {};
};

}  // namespace boxstream::detail
