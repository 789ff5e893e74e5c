// SPDX-License-Identifier: MIT
// Histories of insertions and deletions, with the invariants that sections 6.2 and 6.3 promise.
#include <gtest/gtest.h>

#include <algorithm>

#include "histories.hpp"

namespace boxstream::papers::tests {
namespace {

template <class Dynamic>
class Dynamisation : public testing::Test {};
using Both = testing::Types<Binary, WorstCase>;
TYPED_TEST_SUITE(Dynamisation, Both);

/// Growing, shrinking to nothing, coming back, and standing still while all changes.
TYPED_TEST(Dynamisation, AnswersAsItsHistorySays) {
  for (const std::size_t at_first : {0u, 1u, 7u, 8u, 100u, 255u}) {
    SCOPED_TRACE(at_first);
    History<TypeParam> history(at_first, at_first);
    ASSERT_NO_FATAL_FAILURE(history.check());
    ASSERT_NO_FATAL_FAILURE(history.check_query());
    for (const double insertions : {0.9, 0.5, 0.1, 0.0, 1.0, 0.45})
      ASSERT_NO_FATAL_FAILURE(history.run(400, insertions));
  }
}

TYPED_TEST(Dynamisation, EmptyAndStaleHandles) {
  TypeParam dynamic;
  dynamic.query(touching(box_at(0, 0, 0, 9, 9, 9)), [](std::uint32_t) { ADD_FAILURE(); });
  EXPECT_FALSE(dynamic.erase(0));
  const auto handle = dynamic.insert(as_point(box_at(1, 1, 1), 77));
  Numbers found;
  dynamic.query(touching(box_at(0, 0, 0, 9, 9, 9)), [&](std::uint32_t number) { found.push_back(number); });
  EXPECT_EQ(found, Numbers{77});
  EXPECT_TRUE(dynamic.erase(handle));
  EXPECT_FALSE(dynamic.erase(handle));
  EXPECT_EQ(dynamic.size(), 0u);
  EXPECT_EQ(dynamic.stored(), 0u);
}

/// Identical boxes, which no split tells apart.
TYPED_TEST(Dynamisation, IdenticalBoxes) {
  const Aabb box = box_at(1, 1, 1, 1, 1, 1);
  TypeParam dynamic(points_of(std::vector<Aabb>(50, box)));
  std::vector<typename TypeParam::Handle> handles;
  for (std::uint32_t i = 0; i < 300; ++i) {
    handles.push_back(dynamic.insert(as_point(box, 50 + i)));
    if (i % 3 == 0) {
      ASSERT_TRUE(dynamic.erase(handles[i / 2]));
    }
    std::size_t found = 0;
    dynamic.query(touching(box_at(2, 2, 2)), [&](std::uint32_t) { ++found; });
    ASSERT_EQ(found, 50 + i + 1 - (i / 3 + 1));
    ASSERT_EQ(found, dynamic.size());
  }
}

/// However long the history, what is gone leaves no trace: handles are used again.
TYPED_TEST(Dynamisation, HandlesAreUsedAgain) {
  TypeParam dynamic;
  std::vector<typename TypeParam::Handle> handles;
  Random random(9);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    handles.push_back(dynamic.insert(as_point(random_box(random), i)));
    ASSERT_LT(handles.back(), 300u);
    if (handles.size() <= 64) continue;
    std::swap(handles[random.index(64)], handles.back());
    ASSERT_TRUE(dynamic.erase(handles.back()));
    handles.pop_back();
  }
}

/// Theorem 10: s insertions build each object into a part at most log s times, once a level.
TEST(BinaryStructure, BuildsEachObjectOnceALevel) {
  Binary binary;
  Random random(2);
  constexpr std::size_t s = 2048;
  for (std::uint32_t i = 0; i < s; ++i) binary.insert(as_point(random_box(random), i));
  EXPECT_EQ(binary.parts().size(), 12u);
  EXPECT_LE(binary.built(), s * 12);
  EXPECT_GE(binary.built(), s * 11 / 2);
}

/// Theorem 11: what is built anew was paid for by deletions.
TEST(BinaryStructure, BuildsAnewWhenHalfAreDeleted) {
  Random random(3);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back(random_box(random));
  Binary binary(points_of(boxes));
  EXPECT_EQ(binary.built(), 1000u);
  for (std::uint32_t i = 0; i < 499; ++i) ASSERT_TRUE(binary.erase(i));
  EXPECT_EQ(binary.stored(), 1000u);
  EXPECT_EQ(binary.built(), 1000u);
  ASSERT_TRUE(binary.erase(499));
  EXPECT_EQ(binary.stored(), 500u);
  EXPECT_EQ(binary.built(), 1500u);
  for (std::uint32_t i = 500; i < 1000; ++i) ASSERT_TRUE(binary.erase(i));
  EXPECT_EQ(binary.stored(), 0u);
  EXPECT_LT(binary.built(), 2000u);
}

/// Theorem 13, counted over long runs: the largest work of one operation grows as log^2 n, while the amortised variant
/// builds all of n at once from time to time.
TEST(WorstCaseStructure, NoOperationWaits) {
  Random random(4);
  WorstCase structure;
  std::vector<WorstCase::Handle> handles;
  std::uint64_t most = 0;
  const auto note = [&] {
    most = std::max(most, structure.last_work());
    ASSERT_NO_FATAL_FAILURE(check_invariants(structure));
  };
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    handles.push_back(structure.insert(as_point(random_box(random), i)));
    ASSERT_NO_FATAL_FAILURE(note());
  }
  EXPECT_LE(most, most_insertion_work(20'000));
  random.shuffle(handles);
  for (const auto handle : handles) {
    ASSERT_TRUE(structure.erase(handle));
    ASSERT_NO_FATAL_FAILURE(note());
  }
  EXPECT_LT(1000 * most, KdBuilder<6>::work_of(20'000));
  EXPECT_EQ(structure.size(), 0u);
}

/// What is deleted is gone within n / 4 operations after a quarter was, even if all of them are insertions.
TEST(WorstCaseStructure, CatchesUpWithInsertions) {
  Random random(6);
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1024; ++i) boxes.push_back(random_box(random));
  WorstCase structure(points_of(boxes));
  for (std::uint32_t i = 0; i < 256; ++i) ASSERT_TRUE(structure.erase(i));
  EXPECT_EQ(structure.stored(), 1024u);
  for (std::uint32_t i = 0; i < 768 / 4; ++i) structure.insert(as_point(random_box(random), 1024 + i));
  EXPECT_EQ(structure.size(), 768u + 192u);
  EXPECT_EQ(structure.stored(), structure.size());
}

}  // namespace
}  // namespace boxstream::papers::tests
