// SPDX-License-Identifier: MIT
// The order of pairs and the counts are a function of the input alone. Executors with real threads: threads_test.cpp.
#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "golden_file.hpp"
#include "same_pairs.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Determinism : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Determinism, Scalars);

TYPED_TEST(Determinism, SameOverRepeatsAndOverFreshAndWarmDetectors) {
  Detector warm;
  for (const auto& set : box_sets_to_repeat<TypeParam>()) {
    SCOPED_TRACE(set.name);
    const auto a = set.make(std::min<std::size_t>(3000, set.largest), 1), b = set.make(400, 2);
    const auto first = search_all<TypeParam>(warm, a, b);
    expect_same_search(search_all<TypeParam>(warm, a, b), first);
    Detector fresh;
    expect_same_search(search_all<TypeParam>(fresh, a, b), first);
  }
}

/// Executors that run everything on one thread, in an order of their own and with any claim to concurrency.
TYPED_TEST(Determinism, SameOverExecutors) {
  InlineExecutor one(1), two(2), many(64);
  ReversedExecutor reversed(4);
  ShuffledExecutor shuffled(3);
  Detector serial;
  for (const auto& set : box_sets_to_repeat<TypeParam>()) {
    SCOPED_TRACE(set.name);
    const std::size_t n = std::min<std::size_t>(17000, set.largest);
    const auto a = set.make(n, 1), b = set.make(n / 5, 2);
    const auto expected = search_all<TypeParam>(serial, a, b);
    for (Executor* executor : std::initializer_list<Executor*>{&one, &two, &many, &reversed, &shuffled}) {
      Detector detector(DetectorOptions{executor});
      expect_same_search(search_all<TypeParam>(detector, a, b), expected);
    }
  }
  EXPECT_GT(two.calls(), 0u) << "no search was handed to the executor: the comparison proves nothing";
}

/// Where there are more pairs than the room for all tasks holds (2^21, and one for each box), and no task may pass its
/// own on because none runs on the calling thread: one stops half way, and is done again without the pairs that it
/// held.
TYPED_TEST(Determinism, SameWhenPairsOverflowTheTasks) {
  const std::size_t n = 40000;
  Boxes<TypeParam> boxes = box_set<TypeParam>("sparse").make(n, 1);
  for (std::size_t i = 0; i < 1500; ++i) boxes[i] = boxes[0];
  for (std::size_t i = 20000; i < 22200; ++i) boxes[i] = boxes[20000];
  Detector serial;
  ElsewhereExecutor elsewhere(8);
  Detector parallel(DetectorOptions{&elsewhere});
  const Boxes<TypeParam> few(boxes.begin(), boxes.begin() + 1200);
  const auto expected = search_all<TypeParam>(serial, boxes, few);
  EXPECT_GT(expected.pairs[0].size(), (std::size_t{1} << 21) + n) << "no task overflows: the comparison proves nothing";
  expect_same_search(search_all<TypeParam>(parallel, boxes, few), expected);
}

TEST(DeterminismGolden, OrderIsTheRecordedOne) {
  if (sanitized) GTEST_SKIP() << "compared without sanitizers, and with them with an executor";
  expect_golden_order(nullptr);
}

TEST(DeterminismGolden, OrderIsTheRecordedOneWithAnExecutor) {
  ReversedExecutor reversed(4);
  expect_golden_order(&reversed);
}

/// The order of the input decides the order of pairs, never which they are.
TYPED_TEST(Determinism, ShuffledInputGivesTheSameSet) {
  Random random(1);
  Detector detector;
  for (const char* name : {"dense", "ties", "rods_mixed", "slices_y", "touching_lattice"}) {
    const auto boxes = box_set<TypeParam>(name).make(2000, 1);
    const Pairs truth = brute_force(boxes);
    for (int round = 0; round < 5; ++round) {
      std::vector<std::uint32_t> order(boxes.size());
      std::iota(order.begin(), order.end(), 0u);
      random.shuffle(order);
      Boxes<TypeParam> shuffled;
      for (const std::uint32_t i : order) shuffled.push_back(boxes[i]);
      Pairs found;
      detector.find_pairs(shuffled, found);
      for (Pair& pair : found) {
        pair = {order[pair.a], order[pair.b]};
        if (pair.b < pair.a) std::swap(pair.a, pair.b);
      }
      ASSERT_TRUE(expect_same_pairs(found, truth, boxes, name, 1));
    }
  }
}

}  // namespace
}  // namespace boxstream::tests
