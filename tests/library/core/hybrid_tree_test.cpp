// SPDX-License-Identifier: MIT
// The tree that a search falls back on, alone: no plan helps it, and none misleads it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "batch/search.hpp"
#include "box_sets.hpp"
#include "checks.hpp"
#include "same_pairs.hpp"
#include "sanitized.hpp"

namespace boxstream::tests {
namespace {

/// A node of the usual search: it owns the pairs of which a box begins in it.
template <class S>
struct Region {
  int axis = 0;
  S begin = -std::numeric_limits<S>::infinity();

  bool begins_before(const BasicAabb<S>& box) const { return box.min[axis] < begin; }
  Pairs owned(Pairs pairs, const Boxes<S>& a, const Boxes<S>& b) const {
    const auto is_other = [&](Pair pair) { return begins_before(a[pair.a]) && begins_before(b[pair.b]); };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_other), pairs.end());
    return pairs;
  }
};

/// What the tree finds, sorted, without the usual search above it but for one node.
template <class S>
struct Fallback {
  Stats stats;
  Pairs pairs;

  Fallback(const Boxes<S>& a, const Boxes<S>& b, bool self, const Region<S>& region = {}) {
    const detail::Input<S> input{a, self ? a : b, {}, {}, self};
    const auto keep = [&](Span<const Pair> some) {
      pairs.insert(pairs.end(), some.begin(), some.end());
      return true;
    };
    detail::Arena arena;
    detail::DeliveringBuffer<S> buffer(input, keep);
    const detail::Search<S> search(input);
    detail::SweepContext context = search.make_sweep(arena, buffer);
    detail::HybridTree tree(context, stats);
    std::vector<detail::Record> of_a = records(a, search, region), of_b = records(b, search, region);
    EXPECT_TRUE(self ? tree.join_self(of_a) : tree.join_cross(of_a, of_b));
    buffer.flush();
    stats.tests = context.tests;
    std::sort(pairs.begin(), pairs.end());
  }

 private:
  static std::vector<detail::Record> records(const Boxes<S>& boxes, const detail::Search<S>& search,
                                             const Region<S>& region) {
    const detail::BoxSource<S> source(boxes, search.keys);
    std::vector<detail::Record> valid;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      detail::Record record;
      if (source.load(i, 1, &record).valid == 0) continue;
      valid.push_back(record);
      if (region.begins_before(boxes[i])) valid.back().before = 1u << region.axis;
    }
    return valid;
  }
};

template <class S>
class HybridTree : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(HybridTree, Scalars);

TYPED_TEST(HybridTree, FindsEachPairOnce) {
  for (const auto& set : box_sets<TypeParam>()) {
    const auto boxes = set.make(500, 1), others = set.make(250, 2);
    SCOPED_TRACE(set.name);
    expect_same_pairs(Fallback<TypeParam>(boxes, {}, true).pairs, brute_force(boxes), boxes, set.name, 1);
    EXPECT_EQ(Fallback<TypeParam>(boxes, others, false).pairs, brute_force(boxes, others));
    EXPECT_EQ(Fallback<TypeParam>(others, boxes, false).pairs, brute_force(others, boxes));
  }
}

/// Boxes that begin before the node, in great number also on the axis that comes last.
TYPED_TEST(HybridTree, FindsWhatItsNodeOwns) {
  for (const auto& set : box_sets<TypeParam>()) {
    const auto boxes = set.make(500, 1), others = set.make(250, 2);
    const Pairs truth = brute_force(boxes), cross = brute_force(boxes, others);
    for (int axis = 0; axis < 3; ++axis) {
      SCOPED_TRACE(testing::Message() << set.name << ", axis " << axis);
      const Region<TypeParam> node{axis, boxes[7].min[axis]};
      EXPECT_EQ(Fallback<TypeParam>(boxes, {}, true, node).pairs, node.owned(truth, boxes, boxes));
      EXPECT_EQ(Fallback<TypeParam>(boxes, others, false, node).pairs, node.owned(cross, boxes, others));
    }
  }
}

/// Where most of a search goes astray: here it is the tree's ordinary work.
TYPED_TEST(HybridTree, ComparesNoMoreThanItsBound) {
  if (sanitized && sizeof(TypeParam) == 8) GTEST_SKIP() << "the same as with floats";
  for (const auto& set : box_sets<TypeParam>())
    for (const std::size_t n : {300, 3000}) {
      const auto boxes = set.make(n, 3);
      const Stats stats = Fallback<TypeParam>(boxes, {}, true).stats;
      const double log = std::log2(double(n));
      Pairs pairs;
      const double found = double(Detector().find_pairs(boxes, pairs).pairs);
      EXPECT_LE(double(stats.tests + stats.records), double(n) * log * log * log + 16 * found) << set.name << ", " << n;
    }
}

}  // namespace
}  // namespace boxstream::tests
