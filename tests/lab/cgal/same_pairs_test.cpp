// SPDX-License-Identifier: MIT
// CGAL's box_intersection_d, written by others from the same paper, finds the same pairs: of more boxes than brute
// force can compare.
#include <CGAL/box_intersection_d.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/box_sets.hpp"
#include "core/same_pairs.hpp"

namespace boxstream::tests {
namespace {

template <class S>
using CgalBox = CGAL::Box_intersection_d::Box_with_handle_d<S, 3, const BasicAabb<S>*>;

/// CGAL permutes them, so they remember which they were.
template <class S>
std::vector<CgalBox<S>> cgal_boxes(const Boxes<S>& boxes) {
  std::vector<CgalBox<S>> copies;
  for (const BasicAabb<S>& box : boxes) {
    S lo[3], hi[3];
    std::copy_n(&box.min[0], 3, lo);
    std::copy_n(&box.max[0], 3, hi);
    copies.emplace_back(lo, hi, &box);
  }
  return copies;
}

template <class S>
Pairs of_cgal(const Boxes<S>& a) {
  Pairs pairs;
  auto boxes = cgal_boxes(a);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const CgalBox<S>& x, const CgalBox<S>& y) {
    const auto i = static_cast<std::uint32_t>(x.handle() - a.data()),
               j = static_cast<std::uint32_t>(y.handle() - a.data());
    pairs.push_back({std::min(i, j), std::max(i, j)});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <class S>
Pairs of_cgal(const Boxes<S>& a, const Boxes<S>& b) {
  Pairs pairs;
  auto first = cgal_boxes(a), second = cgal_boxes(b);
  CGAL::box_intersection_d(
      first.begin(), first.end(), second.begin(), second.end(), [&](const CgalBox<S>& x, const CgalBox<S>& y) {
        pairs.push_back(
            {static_cast<std::uint32_t>(x.handle() - a.data()), static_cast<std::uint32_t>(y.handle() - b.data())});
      });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Where a bound is the largest finite number, or infinite: CGAL misses pairs that meet there.
template <class S>
bool reach_the_end_of_the_range(const Boxes<S>& boxes) {
  const auto far = [](S x) { return !(std::abs(x) < std::numeric_limits<S>::max()); };
  return std::any_of(boxes.begin(), boxes.end(), [&](const BasicAabb<S>& box) {
    return std::any_of(&box.min[0], &box.min[0] + 3, far) || std::any_of(&box.max[0], &box.max[0] + 3, far);
  });
}

template <class S>
class Cgal : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Cgal, Scalars);

TYPED_TEST(Cgal, FindsTheSamePairs) {
  Detector detector;
  Pairs found;
  int compared = 0;
  for (const auto& set : box_sets<TypeParam>()) {
    const std::size_t n = std::min<std::size_t>(20000, set.largest);
    const auto a = set.make(n, 7), b = set.make(n / 3, 8);
    // What CGAL makes of NaN and of boxes inside out is not defined.
    if (set.has_invalid || reach_the_end_of_the_range(a) || reach_the_end_of_the_range(b)) continue;
    detector.find_pairs(a, found);
    ASSERT_TRUE(expect_same_pairs(found, of_cgal(a), a, set.name, 7));
    detector.find_pairs(a, b, found);
    ASSERT_TRUE(expect_same_pairs(found, of_cgal(a, b), a, b, set.name, 7));
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

/// As brute force shows: the witness is wrong there, not the search.
TYPED_TEST(Cgal, MissesPairsAtTheEndOfTheRange) {
  for (const char* const name : {"infinite", "full_range", "ties"}) {
    SCOPED_TRACE(name);
    const auto boxes = box_set<TypeParam>(name).make(2000, 7);
    ASSERT_TRUE(reach_the_end_of_the_range(boxes));
    Pairs found;
    Detector().find_pairs(boxes, found);
    std::sort(found.begin(), found.end());
    ASSERT_TRUE(expect_same_pairs(found, brute_force(boxes), boxes, name, 7));
    const Pairs of_the_witness = of_cgal(boxes);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), of_the_witness.begin(), of_the_witness.end()));
    EXPECT_LT(of_the_witness.size(), found.size());
  }
}

}  // namespace
}  // namespace boxstream::tests
