// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/span.hpp>

#include "inputs/random.hpp"
#include "papers/hybrid/problem.hpp"

namespace boxstream::papers {

/// Level(n), section 3: how high a tree of medians is for n points, given that `height` was found best for `boxes` of
/// them. The same share of the points is sampled at every n: height(n) = height + log3(n / boxes), here rounded down
/// and never below 0. The height to start from hardly matters: `boxstream paper hybrid --figure level` shows 4 %
/// between the best and the worst of 0 to 9 for Hybrid.
struct Level {
  std::size_t boxes = 100'000;
  int height = 6;

  int operator()(std::size_t n) const {
    int h = height;
    for (std::size_t m = boxes; m > n && h > 0; m = (m + 2) / 3) --h;
    for (std::size_t m = n / 3; m >= boxes; m /= 3) ++h;
    return h;
  }
};

constexpr std::int32_t median_of_3(std::int32_t a, std::int32_t b, std::int32_t c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// ApproxMedian(P, h), figure 4: the low end, in dimension d, of a point near the median: medians of three, h levels
/// of them, over 3^h random points. `points` must not be empty.
template <class Access, class Element>
std::int32_t approx_median(const Problem<Access>& problem, Span<const Element> points, int h, int d,
                           batches::Random& random) {
  if (h == 0) {
    const auto last = static_cast<std::int64_t>(points.size()) - 1;
    return problem.lo(points[static_cast<std::size_t>(random.integer(0, last))], d);
  }
  // One after the other, because the order in which arguments are evaluated, and so the draw, is the compiler's.
  const std::int32_t a = approx_median(problem, points, h - 1, d, random);
  const std::int32_t b = approx_median(problem, points, h - 1, d, random);
  const std::int32_t c = approx_median(problem, points, h - 1, d, random);
  return median_of_3(a, b, c);
}

}  // namespace boxstream::papers
