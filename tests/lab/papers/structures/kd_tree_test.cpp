// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "box_sets.hpp"
#include "papers/structures/kd_builder.hpp"
#include "papers/structures/kd_tree.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;
using Numbers = std::vector<std::uint32_t>;

template <int K>
bool contains(const KdRange<K>& range, const KdPoint<K>& point) {
  for (std::size_t a = 0; a < K; ++a)
    if (point.at[a] < range.min[a] || point.at[a] > range.max[a]) return false;
  return true;
}

template <int K>
Numbers found(const KdTree<K>& tree, const KdRange<K>& range) {
  Numbers numbers;
  tree.query(range, [&](const KdPoint<K>& item) { numbers.push_back(item.number); });
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Built at once, and in steps of any size, which must keep to the work that was announced.
template <int K>
std::vector<KdTree<K>> built_both_ways(const std::vector<KdPoint<K>>& points, Random& random) {
  std::vector<KdTree<K>> trees;
  trees.emplace_back(points);
  const Span<const KdPoint<K>> all(points);
  const std::size_t cut = random.index(points.size() + 1);
  KdBuilder<K> builder(all.subspan(0, cut), all.subspan(cut, points.size() - cut));
  std::uint64_t work = 0;
  while (!builder.finished()) {
    const auto portion = static_cast<std::uint64_t>(random.integer(1, 50));
    const std::uint64_t done = builder.run(portion);
    EXPECT_LE(done, portion);
    EXPECT_TRUE(done == portion || builder.finished());
    work += done;
  }
  EXPECT_LE(work, KdBuilder<K>::work_of(points.size()));
  trees.push_back(builder.take());
  return trees;
}

template <int K>
void check(const std::vector<KdPoint<K>>& points, const std::vector<KdRange<K>>& ranges, const std::string& what) {
  Random random(5);
  for (const KdTree<K>& tree : built_both_ways(points, random)) {
    ASSERT_EQ(tree.items().size(), points.size());
    for (const KdRange<K>& range : ranges) {
      Numbers expected;
      for (const KdPoint<K>& point : points)
        if (contains(range, point)) expected.push_back(point.number);
      ASSERT_EQ(found(tree, range), expected) << what << ", K = " << K;
    }
  }
}

TEST(KdTree, FindsThePointsInRange) {
  for (const BoxSet& set : box_sets()) {
    std::vector<KdPoint<3>> points;
    for (std::uint32_t i = 0; i < set.boxes.size(); ++i) {
      const float* at = set.boxes[i].min;
      points.push_back({{at[0], at[1], at[2]}, i});
    }
    std::vector<KdRange<3>> ranges;
    for (const Aabb& q : queries_for(set.boxes, 60, 1))
      ranges.push_back({{q.min[0], q.min[1], q.min[2]}, {q.max[0], q.max[1], q.max[2]}});
    // All, half of all, and nothing.
    constexpr float inf = std::numeric_limits<float>::infinity();
    ranges.push_back({{-inf, -inf, -inf}, {inf, inf, inf}});
    ranges.push_back({{-inf, -inf, 0}, {inf, 1, inf}});
    ranges.push_back({{1, 0, 0}, {0, 1, 1}});
    check(points, ranges, set.name);
  }
}

TEST(KdTree, FindsTouchingBoxesAsPointsOfSixDimensions) {
  for (const BoxSet& set : box_sets()) {
    std::vector<KdPoint<6>> points;
    for (std::uint32_t i = 0; i < set.boxes.size(); ++i) points.push_back(as_point(set.boxes[i], i));
    const KdBoxes tree(points);
    for (const Aabb& query : queries_for(set.boxes, 100, 2)) {
      Numbers expected;
      for (std::uint32_t i = 0; i < set.boxes.size(); ++i)
        if (overlaps(set.boxes[i], query)) expected.push_back(i);
      ASSERT_EQ(found(tree, touching(query)), expected) << set.name;
    }
    std::vector<KdRange<6>> ranges;
    for (const Aabb& query : queries_for(set.boxes, 40, 3)) ranges.push_back(touching(query));
    check(points, ranges, set.name);
  }
}

/// In one dimension it is a balanced search tree.
TEST(KdTree, OneDimension) {
  Random random(8);
  std::vector<KdPoint<1>> points;
  std::vector<KdRange<1>> ranges;
  for (std::uint32_t i = 0; i < 500; ++i) points.push_back({{static_cast<float>(random.integer(0, 300))}, i});
  for (int i = 0; i < 100; ++i) {
    const auto low = static_cast<float>(random.integer(-5, 300));
    ranges.push_back({{low}, {low + static_cast<float>(random.integer(0, 20))}});
  }
  check(points, ranges, "one dimension");
}

/// Theorem 4: a query of the plane looks at O(sqrt n + a) nodes. Four times the points, twice the nodes; a strip
/// without answers, which a tree that forgot one of its axes would search at length.
TEST(KdTree, LooksAtFewNodes) {
  for (const bool upright : {false, true}) {
    double last = 0;
    for (const std::uint32_t n : {4096u, 16384u, 65536u}) {
      Random random(n);
      std::vector<KdPoint<2>> points;
      for (std::uint32_t i = 0; i < n; ++i) points.push_back({{float(random.unit()), float(random.unit())}, i});
      const KdTree<2> tree(points);
      double looked_at = 0;
      for (int i = 0; i < 50; ++i) {
        const auto at = static_cast<float>(random.unit());
        const KdRange<2> strip = upright ? KdRange<2>{{at, 0}, {at, 1}} : KdRange<2>{{0, at}, {1, at}};
        looked_at += static_cast<double>(tree.query(strip, [](const auto&) {})) / 50;
      }
      EXPECT_LT(looked_at, 8 * std::sqrt(n)) << n;
      if (last > 0) {
        EXPECT_NEAR(looked_at / last, 2, 0.3) << n;
      }
      last = looked_at;
    }
  }
}

/// Answers of subtrees within the range cost nothing but themselves.
TEST(KdTree, DoesNotLookAtWhatLiesWithin) {
  Random random(1);
  std::vector<KdPoint<2>> points;
  for (std::uint32_t i = 0; i < 65536; ++i) points.push_back({{float(random.unit()), float(random.unit())}, i});
  const KdTree<2> tree(points);
  std::size_t answers = 0;
  const std::size_t looked_at = tree.query({{0.1F, 0.1F}, {0.9F, 0.9F}}, [&](const auto&) { ++answers; });
  EXPECT_GT(answers, 40000u);
  EXPECT_LT(looked_at, 32u * 256u);
}

}  // namespace
}  // namespace boxstream::papers::tests
