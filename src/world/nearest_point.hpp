// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boxstream/aabb.hpp>

#include "near/exact_sum.hpp"

namespace boxstream::detail {

/// Which of two boxes is nearer to a point. Squared distances in double tell, unless they are too close to each other,
/// or have left the range; then nothing is rounded. In the default floating-point environment only.
class NearerToPoint {
 public:
  template <class S>
  explicit NearerToPoint(const S (&point)[3]) {
    for (int d = 0; d < 3; ++d) {
      is_number_[d] = point[d] == point[d];
      point_[d] = is_number_[d] ? double(point[d]) : 0;
    }
  }

  /// True if the squares say which box is nearer. They have at most five roundings in a row, so they are off by less
  /// than 8 * 2^-52 of their value where they are in the range.
  static bool differ_clearly(double squared, double other) {
    const double less = std::min(squared, other), more = std::max(squared, other);
    return more > tiny && less < std::min(more, most) * (1 - slack);
  }

  /// Boxes with squares beyond this are not nearer than one with `squared`.
  static double reach(double squared) { return squared * (1 + slack) + tiny; }

  /// Below, at or above 0 as box `a` is nearer, as near or farther. Exact; both are valid.
  template <class S>
  int compare(const BasicAabb<S>& a, const BasicAabb<S>& b) const {
    const Gaps x = gaps(a), y = gaps(b);
    if (x.infinite || y.infinite) return int{x.infinite} - int{y.infinite};
    bool same = true;
    for (int d = 0; d < 3; ++d) same = same && x.to[d] == y.to[d];
    if (same) return 0;
    double squared_x = 0, squared_y = 0;
    if (is_exact(x, squared_x) && is_exact(y, squared_y))
      return int{squared_x > squared_y} - int{squared_x < squared_y};
    ExactSum sum;
    add(sum, x, 1);
    add(sum, y, -1);
    return sum.sign();
  }

 private:
  static constexpr double slack = 0x1p-48, tiny = 0x1p-960, most = std::numeric_limits<double>::max();

  /// The nearest point of a box. A NaN is inside of it.
  struct Gaps {
    double to[3];
    bool infinite = false;
  };

  template <class S>
  Gaps gaps(const BasicAabb<S>& box) const {
    Gaps g{};
    for (int d = 0; d < 3; ++d) {
      const double least = box.min[d], greatest = box.max[d], x = point_[d];
      g.to[d] = !is_number_[d] ? x : x < least ? least : greatest < x ? greatest : x;
      g.infinite = g.infinite || (g.to[d] != x && !(std::abs(g.to[d]) <= most && std::abs(x) <= most));
    }
    return g;
  }

  /// True if `squared` is the squared distance: numbers of few digits, as on grids, are subtracted, squared and added
  /// without error.
  bool is_exact(const Gaps& g, double& squared) const {
    double sum = 0;
    for (int d = 0; d < 3; ++d) {
      const double gap = g.to[d] - point_[d];
      if (gap == 0) continue;
      if (!is_short(gap) || gap + point_[d] != g.to[d] || g.to[d] - gap != point_[d]) return false;
      const double square = gap * gap, more = sum + square;
      if (square < tiny || more - sum != square || more - square != sum) return false;
      sum = more;
    }
    squared = sum;
    return true;
  }

  /// At most 26 bits, so that its square has no more than a double.
  static bool is_short(double gap) { return (std::bit_cast<std::uint64_t>(gap) & ((1u << 27) - 1)) == 0; }

  void add(ExactSum& sum, const Gaps& g, int sign) const {
    for (int d = 0; d < 3; ++d) {
      if (g.to[d] == point_[d]) continue;
      const Digits to(g.to[d]), from(point_[d]);
      sum.add(to, to, sign);
      sum.add(to, from, -2 * sign);
      sum.add(from, from, sign);
    }
  }

  double point_[3];
  bool is_number_[3];
};

}  // namespace boxstream::detail
