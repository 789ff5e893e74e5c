// SPDX-License-Identifier: MIT
// The recursion ends: each level is counted, on the way to slabs and on the way to large boxes.
#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "same_pairs.hpp"
#include "search/search.hpp"

namespace boxstream::tests {
namespace {

constexpr int deepest = 24;

struct Outcome {
  Stats stats;
  Pairs pairs;
};

/// A search whose root is at `depth`, which no search of a Detector is.
template <class S>
Outcome search_from(int depth, const Boxes<S>& a, const Boxes<S>& b) {
  const bool self = b.empty();
  Outcome outcome;
  const detail::Input<S> input{a, self ? a : b, {}, {}};
  const auto keep = [&](Span<const Pair> pairs) {
    outcome.pairs.insert(outcome.pairs.end(), pairs.begin(), pairs.end());
    return true;
  };
  detail::Arena arena;
  detail::DeliveringBuffer<S> buffer(input, keep);
  const detail::Search<S> search(input, self);
  const detail::Tree::Context context{0, depth, nullptr};
  {
    detail::Tree tree = search.make_tree(arena, buffer, outcome.stats);
    const detail::BoxSource<S> boxes_a(input.a, search.keys), boxes_b(input.b, search.keys);
    if (self ? tree.join_self(boxes_a, context) : tree.join_cross(boxes_a, boxes_b, context)) buffer.flush();
  }
  std::sort(outcome.pairs.begin(), outcome.pairs.end());
  return outcome;
}

template <class S>
class Depth : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Depth, Scalars);

/// One level above the deepest one there is one cut, and none below it; the pairs are those of a search from the top.
TYPED_TEST(Depth, EachLevelCounts) {
  for (const char* name : {"dense", "rods_mixed"}) {
    const auto boxes = box_set<TypeParam>(name).make(60000, 1);
    const Boxes<TypeParam> first(boxes.begin(), boxes.begin() + 30000), second(boxes.begin() + 30000, boxes.end());
    for (const Boxes<TypeParam>& other : {Boxes<TypeParam>(), second}) {
      SCOPED_TRACE(testing::Message() << name << (other.empty() ? "" : ", two sets"));
      const Boxes<TypeParam>& set = other.empty() ? boxes : first;
      const Outcome top = search_from(0, set, other);
      EXPECT_GT(top.stats.nodes, 1u);
      for (const int depth : {deepest - 1, deepest}) {
        const Outcome deep = search_from(depth, set, other);
        EXPECT_EQ(deep.stats.nodes, static_cast<unsigned>(deepest - depth)) << "from depth " << depth;
        EXPECT_EQ(deep.pairs, top.pairs);
      }
    }
  }
}

}  // namespace
}  // namespace boxstream::tests
