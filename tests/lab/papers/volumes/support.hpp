// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boxstream/pair.hpp>

#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/dop.hpp"
#include "papers/volumes/objects.hpp"
#include "papers/volumes/oriented_box.hpp"
#include "papers/volumes/sphere.hpp"
#include "random.hpp"

/// Inputs, and what is true of them by nothing but comparisons of each with each.
namespace boxstream::papers::volumes::tests {

using boxstream::tests::Random;
using Boxes = std::vector<Aabb>;
using Pairs = std::vector<Pair>;

using AllVolumes = ::testing::Types<AxisBox, Sphere, OrientedBox, Dop<14>, Dop<18>, Dop<26>>;

/// Is the point in the volume, as its definition says, with no tolerance, in the longest floating-point type there is?
using Real = long double;

inline bool inside(const AxisBox& v, const Point& p) {
  for (int d = 0; d < 3; ++d)
    if (p[d] < v.box.min[d] || p[d] > v.box.max[d]) return false;
  return true;
}
inline bool inside(const Sphere& v, const Point& p) {
  Real square = 0;
  for (int d = 0; d < 3; ++d) square += (Real{p[d]} - v.centre[d]) * (Real{p[d]} - v.centre[d]);
  return square <= Real{v.radius} * v.radius;
}
inline bool inside(const OrientedBox& v, const Point& p) {
  for (int axis = 0; axis < 3; ++axis) {
    Real along = 0;
    for (int d = 0; d < 3; ++d) along += v.axes(d, axis) * (Real{p[d]} - v.centre[d]);
    if (std::abs(along) > v.half[axis]) return false;
  }
  return true;
}
template <int K>
bool inside(const Dop<K>& v, const Point& p) {
  for (std::size_t i = 0; i < Dop<K>::slabs; ++i) {
    Real along = 0;
    for (int d = 0; d < 3; ++d) along += Real{p[d]} * Dop<K>::normal(i)[d];
    if (along < v.low[i] || along > v.high[i]) return false;
  }
  return true;
}

/// Boxes around centres of `spread` about `offset`, each side of at most `side`.
struct Kind {
  const char* name;
  std::size_t n;
  double offset, spread[3], side[3];
};
inline constexpr Kind kinds[] = {
    {"none", 0, 0, {1, 1, 1}, {1, 1, 1}},
    {"one", 1, 0, {1, 1, 1}, {1, 1, 1}},
    {"two", 2, 0, {1, 1, 1}, {1, 1, 1}},
    {"scattered", 50, 0, {1, 1, 1}, {0.3, 0.3, 0.3}},
    {"identical", 20, 3, {0, 0, 0}, {0, 0, 0}},
    {"flat", 40, 0.1, {1, 0, 1}, {0.2, 0, 0.2}},
    {"collinear", 35, -7, {0, 0, 1}, {0, 0, 0.05}},
    {"points", 25, 0.7, {1, 1, 1}, {0, 0, 0}},
    {"small and far off", 30, 1e6, {2, 2, 2}, {0.5, 0.5, 0.5}},
    {"of any size", 30, 0, {1e30, 1e30, 1e30}, {3e29, 3e29, 3e29}},
    {"needles", 30, 0, {1, 1, 1}, {1, 0.001, 0.001}},
};

inline Boxes make(const Kind& kind, Random& random) {
  Boxes boxes(kind.n);
  for (Aabb& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const double low = kind.offset + kind.spread[d] * random.between(-1, 1);
      box.min[d] = static_cast<float>(low);
      box.max[d] = static_cast<float>(low + kind.side[d] * random.unit());
    }
  return boxes;
}

/// Each box some way on, as a whole.
inline void move(Boxes& boxes, const Kind& kind, double step, Random& random) {
  for (Aabb& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const auto way = static_cast<float>(step * kind.spread[d] * random.between(-1, 1));
      box.min[d] += way;
      box.max[d] += way;
    }
}

inline Pairs truth(const Boxes& boxes) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
  return pairs;
}

inline Pairs truth(const Boxes& a, const Boxes& b) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j)
      if (overlaps(a[i], b[j])) pairs.push_back({i, j});
  return pairs;
}

}  // namespace boxstream::papers::volumes::tests
