// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <boxstream/aabb.hpp>

namespace boxstream::detail {

/// A squared distance in double, kept in a range where it is off by less than 8 * 2^-52 of its value: it has at most
/// five roundings in a row. At the ends of the range it may stand for any that is beyond.
class AboutSquared {
 public:
  explicit AboutSquared(double squared)
      : squared_(std::clamp(squared, tiny, most)), clearly_below_(squared_ * (1 - slack)) {}

  /// False if the estimate cannot decide.
  bool is_clearly_below(AboutSquared other) const { return squared_ < other.clearly_below_; }

  /// Of boxes that are not farther off, squares are at most this.
  double reach() const { return squared_ * (1 + slack); }

 private:
  static constexpr double slack = 0x1p-48, tiny = 0x1p-960, most = std::numeric_limits<double>::max();

  double squared_;
  double clearly_below_;
};

/// About the squared distance of a point to a box, in double; infinite where it leaves the range. A NaN is at no
/// distance from anything.
template <class S>
double squared_distance(const S (&point)[3], const BasicAabb<S>& box) {
  double squared = 0;
  for (int d = 0; d < 3; ++d) {
    const double below = static_cast<double>(box.min[d]) - static_cast<double>(point[d]);
    const double above = static_cast<double>(point[d]) - static_cast<double>(box.max[d]);
    double gap = below > 0 ? below : 0;
    gap = above > gap ? above : gap;
    squared += gap * gap;
  }
  return squared;
}

/// A distance above all those whose squares are at most this, and more than zero.
template <class S>
S distance_above(double squared) {
  using Limits = std::numeric_limits<S>;
  const double root = std::sqrt(squared) * (1 + 0x1p-20);
  return root < static_cast<double>(Limits::min())   ? Limits::min()
         : root < static_cast<double>(Limits::max()) ? static_cast<S>(root)
                                                     : Limits::infinity();
}

/// Below, at or above 0 as box `a` is nearer to the point, as near or farther. Nothing is rounded; both are valid. A
/// NaN is at no distance from any box. In the default floating-point environment only.
int compare_distances(const double (&point)[3], const Aabb64& a, const Aabb64& b);

}  // namespace boxstream::detail
