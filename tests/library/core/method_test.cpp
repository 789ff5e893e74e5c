// SPDX-License-Identifier: MIT
// The paper's tree as a method of a Detector: the same pairs by any cutoff, in an order of its own that nothing
// changes. Other tests search by it as well: Checker.
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "hard_boxes.hpp"
#include "many_sets.hpp"
#include "same_pairs.hpp"
#include "sanitized.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

constexpr std::uint32_t by_sample = 0;

DetectorOptions hybrid(std::uint32_t cutoff = by_sample, Executor* executor = nullptr) {
  DetectorOptions options;
  options.executor = executor;
  options.method = Method::hybrid;
  options.cutoff = cutoff;
  return options;
}

template <class S>
class Hybrid : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Hybrid, Scalars);

TYPED_TEST(Hybrid, EqualsBruteForceWithAnyCutoff) {
  const std::size_t n = sanitized ? 400 : 1200;
  for (const auto& set : box_sets<TypeParam>()) {
    const auto a = set.make(n, 1), b = set.make(n / 4, 2);
    const Pairs within = brute_force(a), between = brute_force(a, b), reversed = brute_force(b, a);
    for (const std::uint32_t cutoff : {by_sample, 1u, 8u, 100u, 5000u}) {
      Detector detector(hybrid(cutoff));
      Pairs found;
      const std::string scene = set.name + ", cutoff " + std::to_string(cutoff);
      const Stats stats = detector.find_pairs(a, found);
      expect_same_pairs(found, within, a, scene, 1);
      EXPECT_EQ(stats.pairs, within.size());
      EXPECT_EQ(stats.invalid, count_invalid(a));
      detector.find_pairs(a, b, found);
      expect_same_pairs(found, between, a, b, scene, 1);
      EXPECT_EQ(detector.find_pairs(b, a, found).invalid, count_invalid(a) + count_invalid(b));
      expect_same_pairs(found, reversed, b, a, scene, 1);
    }
  }
}

/// The inputs that mislead plans mislead samples too: what a scan leaves goes to the bounded tree.
TYPED_TEST(Hybrid, FindsThePairsOfHardBoxesAndComparesFew) {
  const std::size_t n = sanitized ? 1000 : 8000;
  Detector planned, paper(hybrid());
  for (const batches::HardFamily& family : batches::hard_families()) {
    SCOPED_TRACE(family.name);
    const auto boxes = hard_boxes<TypeParam>(family, n, 1);
    const auto first = every_other(boxes, 0), second = every_other(boxes, 1);
    Pairs expected, found;
    const auto check = [&](const Stats& stats) {
      std::sort(expected.begin(), expected.end());
      std::sort(found.begin(), found.end());
      EXPECT_TRUE(found == expected) << found.size() << " pairs of " << expected.size();
      EXPECT_LE(work_by_bound(stats), 4);
    };
    planned.find_pairs(boxes, expected);
    check(paper.find_pairs(boxes, found));
    planned.find_pairs(first, second, expected);
    check(paper.find_pairs(first, second, found));
  }
}

/// It is the tree that does it, and a cutoff of all boxes is one scan.
TYPED_TEST(Hybrid, CutsWhatScansDoNotTellApart) {
  const auto boxes = box_set<TypeParam>("dense").make(5000, 1);
  Pairs found;
  const Stats fine = Detector(hybrid(100)).find_pairs(boxes, found);
  EXPECT_GT(fine.nodes, 20u);
  const Stats whole = Detector(hybrid(5001)).find_pairs(boxes, found);
  EXPECT_EQ(whole.nodes, 0u);
  EXPECT_EQ(whole.cells, 1u);
  EXPECT_GT(whole.tests, fine.tests * 3 / 2);
}

TYPED_TEST(Hybrid, FiltersAreThoseOfTheTruth) {
  const auto a = box_set<TypeParam>("dense").make(900, 1), b = box_set<TypeParam>("dense").make(500, 2);
  Filters of_a(a.size()), of_b(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) of_a[i] = {1u << i % 3, static_cast<std::uint32_t>(i % 7)};
  for (std::size_t i = 0; i < b.size(); ++i) of_b[i] = {1u << i % 4, static_cast<std::uint32_t>(i % 5)};
  for (const std::uint32_t cutoff : {by_sample, 30u}) {
    Detector detector(hybrid(cutoff));
    Pairs found;
    detector.find_pairs(a, found, of_a);
    expect_same_pairs(found, brute_force(a, of_a), a, "dense", 1);
    detector.find_pairs(a, b, found, of_a, of_b);
    expect_same_pairs(found, brute_force(a, b, of_a, of_b), a, b, "dense", 1);
    detector.find_pairs(a, b, found, {}, of_b);
    expect_same_pairs(found, brute_force(a, b, {}, of_b), a, b, "dense", 1);
  }
}

/// Tiny ones, empty ones and one that threads share.
TYPED_TEST(Hybrid, ManySetsAreSearchesOfTheirOwn) {
  std::vector<std::size_t> sizes = uneven_sizes(40, 1);
  sizes.insert(sizes.end(), {0, 1, 2, 20000, 5, 0});
  const auto sets = make_many<TypeParam>(sizes, 1);
  InlineExecutor several(3);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)}) {
    Detector together(hybrid(by_sample, executor)), alone(hybrid());
    PairsOfSets found;
    const Stats stats = together.find_pairs(sets.boxes, sets.offsets, found, sets.filters);
    EXPECT_EQ(stats.pairs, found.pairs.size());
    EXPECT_EQ(stats.invalid, count_invalid(sets.boxes));
    for (std::size_t i = 0; i < sets.size(); ++i) {
      Pairs expected;
      alone.find_pairs(sets.set(i), expected, sets.filters_of(i));
      ASSERT_EQ(found.offsets[i + 1] - found.offsets[i], expected.size()) << "set " << i;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const Pair pair = found.pairs[found.offsets[i] + k];
        const auto first = static_cast<std::uint32_t>(sets.offsets[i]);
        ASSERT_EQ((Pair{pair.a - first, pair.b - first}), expected[k]) << "set " << i;
      }
    }
  }
}

/// Pairs, their order and all counts, collected and streamed, on one thread and as tasks of executors.
TYPED_TEST(Hybrid, OrderIsThatOfOneThread) {
  InlineExecutor two(2), many(64);
  ReversedExecutor reversed(4);
  ShuffledExecutor shuffled(3);
  ElsewhereExecutor elsewhere(8);
  for (const auto& set : box_sets_to_repeat<TypeParam>()) {
    const std::size_t n = std::min<std::size_t>(17000, set.largest);
    const auto a = set.make(n, 1), b = set.make(n / 5, 2);
    for (const std::uint32_t cutoff : {by_sample, 200u}) {
      SCOPED_TRACE(set.name + ", cutoff " + std::to_string(cutoff));
      Detector serial(hybrid(cutoff));
      const auto expected = search_all<TypeParam>(serial, a, b);
      EXPECT_EQ(expected.pairs[0], expected.pairs[2]);
      EXPECT_EQ(expected.pairs[1], expected.pairs[3]);
      expect_same_search(search_all<TypeParam>(serial, a, b), expected);
      for (Executor* executor : std::initializer_list<Executor*>{&two, &many, &reversed, &shuffled, &elsewhere}) {
        Detector detector(hybrid(cutoff, executor));
        expect_same_search(search_all<TypeParam>(detector, a, b), expected);
      }
    }
  }
  EXPECT_GT(two.calls(), 0u);
}

/// Tasks that find no room for their pairs are done again, and must find the same in the same order.
TYPED_TEST(Hybrid, SameWhenPairsOverflowTheTasks) {
  Boxes<TypeParam> boxes = box_set<TypeParam>("sparse").make(40000, 1);
  // Two heaps, of boxes that begin in another order on each axis, so that cuts move them.
  const auto heap = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i < end; ++i) {
      boxes[i] = boxes[begin];
      for (std::size_t d = 0; d < 3; ++d) boxes[i].min[d] -= static_cast<TypeParam>((i * (37 + 2 * d)) % 101) / 100000;
    }
  };
  heap(0, 1500);
  heap(20000, 22200);
  ElsewhereExecutor elsewhere(8);
  Detector serial(hybrid()), parallel(hybrid(by_sample, &elsewhere));
  Pairs expected, streamed;
  serial.find_pairs(boxes, expected);
  parallel.stream_pairs(boxes, [&](Span<const Pair> pairs) {
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    return true;
  });
  EXPECT_TRUE(streamed == expected);
}

TYPED_TEST(Hybrid, StopsWhereTheSinkRefusesOrThrows) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)})
    for (const std::uint32_t cutoff : {by_sample, 50u}) {
      Detector detector(hybrid(cutoff, executor));
      const auto a = box_set<TypeParam>("dense").make(20000, 1), b = box_set<TypeParam>("dense").make(9000, 2);
      for (const bool two : {false, true}) {
        const auto stream = [&](PairSink sink) {
          return two ? detector.stream_pairs(a, b, sink) : detector.stream_pairs(a, sink);
        };
        Pairs whole;
        two ? detector.find_pairs(a, b, whole) : detector.find_pairs(a, whole);
        for (std::size_t seventh = 0; seventh < 7; ++seventh) {
          const std::size_t enough = whole.size() * seventh / 7;
          Pairs streamed;
          std::size_t after = 0;
          const Stats stats = stream([&](Span<const Pair> pairs) {
            after += streamed.size() > enough ? 1 : 0;
            streamed.insert(streamed.end(), pairs.begin(), pairs.end());
            return streamed.size() <= enough;
          });
          EXPECT_EQ(after, 0u) << "called again after it returned false";
          EXPECT_EQ(stats.pairs, streamed.size());
          ASSERT_LE(streamed.size(), whole.size());
          EXPECT_TRUE(std::equal(streamed.begin(), streamed.end(), whole.begin()));
          EXPECT_THROW(stream([](Span<const Pair>) -> bool { throw std::runtime_error("no more"); }),
                       std::runtime_error);
        }
        Pairs again;
        two ? detector.find_pairs(a, b, again) : detector.find_pairs(a, again);
        EXPECT_TRUE(again == whole);
      }
    }
}

TYPED_TEST(Hybrid, TellsOfWhatItCannotTake) {
  Detector detector(hybrid());
  Pairs found;
  EXPECT_EQ(detector.find_pairs(Boxes<TypeParam>(), found).boxes, 0u);
  EXPECT_EQ(detector.find_pairs(Boxes<TypeParam>(), Boxes<TypeParam>(7), found).boxes, 7u);
  EXPECT_THROW(detector.find_pairs(Boxes<TypeParam>(7), found, Filters(6)), std::invalid_argument);
}

}  // namespace
}  // namespace boxstream::tests
