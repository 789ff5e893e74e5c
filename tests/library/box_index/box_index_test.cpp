// SPDX-License-Identifier: MIT
//
// What an index of boxes that stay answers, compared with a look at each box.

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "box_index/answers.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class BoxIndices : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxIndices, Scalars);

TYPED_TEST(BoxIndices, EveryQueryOfEachFamily) {
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (const std::size_t n : {0, 1, 8, 9, 65, 300}) {
      SCOPED_TRACE(set.name + ' ' + std::to_string(n));
      const auto boxes = set.make(std::min(n, set.largest), n);
      expect_answers(BasicBoxIndex<TypeParam>(boxes), boxes, set.make(std::min<std::size_t>(20, set.largest), n + 1));
    }
}

TYPED_TEST(BoxIndices, HardBoxes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Boxes<TypeParam> boxes, places;
    for (std::uint64_t i = 0; i < 25 * seed; ++i) boxes.push_back(box_from<TypeParam>(1000 * seed + i));
    for (std::uint64_t i = 0; i < 40; ++i) places.push_back(box_from<TypeParam>(77000 + 1000 * seed + i));
    SCOPED_TRACE(seed);
    expect_answers(BasicBoxIndex<TypeParam>(boxes), boxes, places);
  }
}

/// More boxes than are asked about together.
TYPED_TEST(BoxIndices, ManyQuestionsAtOnce) {
  const auto boxes = box_set<TypeParam>("sparse").make(3000, 1);
  auto places = box_set<TypeParam>("sparse").make(5000, 2);
  std::swap(places[7].min[0], places[7].max[0]);
  std::vector<Pair> found = {{1, 2}}, expected = brute_force(places, boxes);
  BasicBoxIndex<TypeParam>(boxes).query_boxes(places, found);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

TYPED_TEST(BoxIndices, StopsWhenTold) {
  const BasicBoxIndex<TypeParam> index(Boxes<TypeParam>(100, {{0, 0, 0}, {1, 1, 1}}));
  int calls = 0;
  index.query_box({{0, 0, 0}, {1, 1, 1}}, [&](std::uint32_t) { return ++calls < 3; });
  EXPECT_EQ(calls, 3);
  EXPECT_THROW(index.query_box({{0, 0, 0}, {1, 1, 1}}, [](std::uint32_t) -> bool { throw std::out_of_range("!"); }),
               std::out_of_range);
  BasicBoxIndex<TypeParam> moved(Boxes<TypeParam>(2, {{0, 0, 0}, {1, 1, 1}}));
  const BasicBoxIndex<TypeParam> kept(std::move(moved));
  EXPECT_EQ(kept.size(), 2u);
  moved = BasicBoxIndex<TypeParam>();
  EXPECT_EQ(moved.size(), 0u);
  EXPECT_FALSE(makes_sense(moved.bounds()));
}

}  // namespace
}  // namespace boxstream::tests
