// SPDX-License-Identifier: MIT
#include "nearest/nearest_point.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

#include "nearest/exact_sum.hpp"

namespace boxstream::detail {

namespace {

/// The way from a point to a box, on each axis.
struct Gaps {
  double from[3] = {};
  double to[3] = {};
  bool infinite = false;

  Gaps(const double (&point)[3], const Aabb64& box) {
    for (int d = 0; d < 3; ++d) {
      const double x = point[d];
      if (x < box.min[d])
        set(d, x, box.min[d]);
      else if (box.max[d] < x)
        set(d, x, box.max[d]);
    }
  }

  void set(int axis, double x, double bound) {
    from[axis] = x;
    to[axis] = bound;
    infinite = infinite || std::isinf(x) || std::isinf(bound);
  }

  bool operator==(const Gaps& other) const {
    return std::equal(from, from + 3, other.from) && std::equal(to, to + 3, other.to);
  }
};

/// True if `squared` is the squared distance: numbers of few digits, as on grids, are subtracted, squared and added
/// without error.
bool square_exactly(const Gaps& gaps, double& squared) {
  // At most 26 bits, so that its square has no more than a double.
  const auto is_short = [](double x) { return (std::bit_cast<std::uint64_t>(x) & ((1u << 27) - 1)) == 0; };
  squared = 0;
  for (int d = 0; d < 3; ++d) {
    const double from = gaps.from[d], to = gaps.to[d], gap = to - from;
    if (from == to) continue;
    if (!is_short(gap) || gap + from != to || to - gap != from) return false;
    const double square = gap * gap, sum = squared + square;
    if (square < 0x1p-960 || sum - squared != square || sum - square != squared) return false;
    squared = sum;
  }
  return true;
}

void add_square(ExactSum& sum, const Gaps& gaps, int times) {
  for (int d = 0; d < 3; ++d) {
    const Digits from(gaps.from[d]), to(gaps.to[d]);
    sum.add(to, to, times);
    sum.add(to, from, -2 * times);
    sum.add(from, from, times);
  }
}

}  // namespace

int compare_distances(const double (&point)[3], const Aabb64& a, const Aabb64& b) {
  const Gaps x(point, a), y(point, b);
  if (x.infinite || y.infinite) return int{x.infinite} - int{y.infinite};
  if (x == y) return 0;
  double squared_x = 0, squared_y = 0;
  if (square_exactly(x, squared_x) && square_exactly(y, squared_y))
    return int{squared_x > squared_y} - int{squared_x < squared_y};
  ExactSum sum;
  add_square(sum, x, 1);
  add_square(sum, y, -1);
  return sum.sign();
}

}  // namespace boxstream::detail
