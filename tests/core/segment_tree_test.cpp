// SPDX-License-Identifier: MIT
// The tree that a search falls back on, alone: no plan helps it, and none misleads it.
#include <gtest/gtest.h>

#include <cmath>

#include "box_sets.hpp"
#include "checks.hpp"
#include "same_pairs.hpp"
#include "search/search.hpp"

namespace boxstream::tests {
namespace {

/// What the tree finds, sorted, without a node of the usual search above it.
template <class S>
struct Fallback {
  Stats stats;
  Pairs pairs;

  Fallback(const Boxes<S>& a, const Boxes<S>& b, bool self) {
    const detail::Input<S> input{a, self ? a : b, {}, {}};
    const auto keep = [&](Span<const Pair> some) {
      pairs.insert(pairs.end(), some.begin(), some.end());
      return true;
    };
    detail::Arena arena;
    detail::DeliveringBuffer<S> buffer(input, keep);
    const detail::Search<S> search(input, self);
    detail::SweepContext context{arena,
                                 buffer,
                                 {search.keys.kind(0), search.keys.kind(1), search.keys.kind(2)},
                                 self ? detail::PairOrder::smaller_first : detail::PairOrder::first_set_first};
    detail::SegmentTree tree(context, stats);
    const std::vector<detail::Record> of_a = records(a, search), of_b = records(b, search);
    EXPECT_TRUE(self ? tree.join_self(of_a) : tree.join_cross(of_a, of_b));
    buffer.flush();
    stats.tests = context.tests;
    std::sort(pairs.begin(), pairs.end());
  }

 private:
  static std::vector<detail::Record> records(const Boxes<S>& boxes, const detail::Search<S>& search) {
    const detail::BoxSource<S> source(boxes, search.keys);
    std::vector<detail::Record> valid;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (source.valid(i)) valid.push_back(source[i]);
    return valid;
  }
};

template <class S>
class SegmentTree : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SegmentTree, Scalars);

TYPED_TEST(SegmentTree, FindsEachPairOnce) {
  for (const auto& set : box_sets<TypeParam>()) {
    const auto boxes = set.make(500, 1), others = set.make(250, 2);
    SCOPED_TRACE(set.name);
    expect_same_pairs(Fallback<TypeParam>(boxes, {}, true).pairs, brute_force(boxes), boxes, set.name, 1);
    EXPECT_EQ(Fallback<TypeParam>(boxes, others, false).pairs, brute_force(boxes, others));
    EXPECT_EQ(Fallback<TypeParam>(others, boxes, false).pairs, brute_force(others, boxes));
  }
}

/// Where most of a search goes astray: here it is the tree's ordinary work.
TYPED_TEST(SegmentTree, ComparesNoMoreThanItsBound) {
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
