// SPDX-License-Identifier: MIT
// Sinks: the same pairs in the same order as a vector gets, stopped and failing at any time.
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "checks.hpp"
#include "executors.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Streaming : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Streaming, Scalars);

TYPED_TEST(Streaming, SameOrderAsAVectorInBatchesThatAreNotEmpty) {
  Detector detector;
  for (const auto& set : box_sets<TypeParam>()) {
    const auto a = set.make(std::min<std::size_t>(3000, set.largest), 1), b = set.make(500, 2);
    Pairs collected, streamed;
    std::size_t empty_batches = 0;
    const auto sink = [&](Span<const Pair> pairs) {
      empty_batches += pairs.empty() ? 1 : 0;
      streamed.insert(streamed.end(), pairs.begin(), pairs.end());
      return true;
    };
    detector.find_pairs(a, collected);
    const Stats stats = detector.stream_pairs(a, sink);
    EXPECT_EQ(streamed, collected) << set.name;
    EXPECT_EQ(stats.pairs, collected.size()) << set.name;
    streamed.clear();
    detector.find_pairs(a, b, collected);
    detector.stream_pairs(a, b, sink);
    EXPECT_EQ(streamed, collected) << set.name << ", two sets";
    EXPECT_EQ(empty_batches, 0u) << set.name;
  }
}

/// Stops at each batch in turn: no call follows the refusal, and what came before is a prefix of the whole.
template <class Search>
void expect_stops_at_once(const Pairs& whole, std::size_t most_stops, Search search) {
  for (std::size_t stop = 1; stop <= most_stops; ++stop) {
    Pairs streamed;
    std::size_t calls = 0;
    const Stats stats = search([&](Span<const Pair> pairs) {
      streamed.insert(streamed.end(), pairs.begin(), pairs.end());
      return ++calls != stop;
    });
    ASSERT_LE(calls, stop) << "called again after it returned false";
    ASSERT_EQ(stats.pairs, streamed.size());
    ASSERT_LE(streamed.size(), whole.size());
    ASSERT_TRUE(std::equal(streamed.begin(), streamed.end(), whole.begin()));
    if (calls < stop) {
      ASSERT_EQ(streamed.size(), whole.size());
      return;
    }
  }
}

TYPED_TEST(Streaming, StopsAtOnce) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)}) {
    Detector detector(DetectorOptions{executor});
    for (const auto& [name, n] : {std::pair("dense", 3000), std::pair("all_overlapping", 700), std::pair("ties", 2000),
                                  std::pair("dense", 20000), std::pair("rods_mixed", 20000)}) {
      SCOPED_TRACE(name);
      const auto a = box_set<TypeParam>(name).make(static_cast<std::size_t>(n), 1);
      const auto b = box_set<TypeParam>(name).make(400, 2);
      Pairs whole;
      detector.find_pairs(a, whole);
      expect_stops_at_once(whole, 40, [&](PairSink sink) { return detector.stream_pairs(a, sink); });
      detector.find_pairs(a, b, whole);
      expect_stops_at_once(whole, 40, [&](PairSink sink) { return detector.stream_pairs(a, b, sink); });
    }
  }
}

/// Every way of searching stops, wherever in it the sink refuses.
TYPED_TEST(Streaming, StopsAnywhere) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)}) {
    Detector detector(DetectorOptions{executor});
    for (const auto& set : box_sets_to_repeat<TypeParam>()) {
      SCOPED_TRACE(set.name);
      const std::size_t n = executor == nullptr ? 3000 : 20000;  // teams meet at large nodes only
      const auto a = set.make(std::min(n, set.largest), 1), b = set.make(std::min(n / 2, set.largest), 2);
      for (const bool two : {false, true}) {
        Pairs whole;
        const auto stream = [&](PairSink sink) {
          return two ? detector.stream_pairs(a, b, sink) : detector.stream_pairs(a, sink);
        };
        two ? detector.find_pairs(a, b, whole) : detector.find_pairs(a, whole);
        for (std::size_t seventh = 0; seventh < 7; ++seventh) {
          const std::size_t enough = whole.size() * seventh / 7;
          std::size_t streamed = 0, after = 0;
          bool in_order = true;
          stream([&](Span<const Pair> pairs) {
            after += streamed > enough ? 1 : 0;
            in_order = in_order &&
                       std::equal(pairs.begin(), pairs.end(), whole.begin() + static_cast<std::ptrdiff_t>(streamed));
            streamed += pairs.size();
            return streamed <= enough;
          });
          ASSERT_TRUE(in_order);
          ASSERT_EQ(after, 0u) << "called again after it returned false";
          ASSERT_EQ(streamed > enough, !whole.empty());
        }
      }
    }
  }
}

/// A caller that wants one pair need not wait for them all.
TYPED_TEST(Streaming, FirstBatchComesEarly) {
  Detector detector;
  const Boxes<TypeParam> boxes(20000, {{0, 0, 0}, {1, 1, 1}});
  std::size_t received = 0;
  const Stats stats = detector.stream_pairs(boxes, [&](Span<const Pair> pairs) {
    received += pairs.size();
    return false;
  });
  EXPECT_EQ(stats.pairs, received);
  EXPECT_LE(received, 1000u);
  EXPECT_LE(stats.tests, 20000u * 100);
}

struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TYPED_TEST(Streaming, SinkThatThrowsLeavesTheDetectorUsable) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)}) {
    Checker<TypeParam> checker(DetectorOptions{executor});
    for (const std::size_t n : {50, 700, 17000}) {
      const auto boxes = box_set<TypeParam>("dense").make(n, n);
      const auto others = box_set<TypeParam>("dense").make(n / 2, n);
      for (std::size_t last = 1; last < 40; last += 5) {
        std::size_t calls = 0;
        const auto sink = [&](Span<const Pair>) -> bool {
          if (++calls == last) throw Refusal("call " + std::to_string(last));
          return true;
        };
        try {
          if (last % 2 == 0)
            checker.detector().stream_pairs(boxes, others, sink);
          else
            checker.detector().stream_pairs(boxes, sink);
          EXPECT_LT(calls, last);
        } catch (const Refusal& refusal) {
          EXPECT_EQ(refusal.what(), "call " + std::to_string(last));
        }
        EXPECT_LE(calls, last) << "called again after it threw";
      }
      ASSERT_TRUE(checker.one_set(boxes, "dense, after the sink threw", n));
      ASSERT_TRUE(checker.two_sets(boxes, others, "dense, after the sink threw", n));
    }
  }
}

/// A sink may search on its own, with another Detector.
TYPED_TEST(Streaming, SinkMaySearch) {
  const auto boxes = box_set<TypeParam>("dense").make(1000, 1);
  const Pairs truth = brute_force(boxes);
  Detector outer, inner;
  Pairs streamed, found;
  outer.stream_pairs(boxes, [&](Span<const Pair> pairs) {
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    inner.find_pairs(boxes, found);
    EXPECT_EQ(found.size(), truth.size());
    return true;
  });
  expect_same_pairs(streamed, truth, boxes, "dense", 1);
}

TYPED_TEST(Streaming, DetectorsMove) {
  const auto boxes = box_set<TypeParam>("dense").make(2000, 1);
  const Pairs truth = brute_force(boxes);
  Detector first;
  Pairs found;
  first.find_pairs(boxes, found);
  const std::size_t scratch = first.scratch_bytes();
  EXPECT_GT(scratch, 0u);
  Detector second = std::move(first);
  EXPECT_EQ(second.scratch_bytes(), scratch);
  second.find_pairs(boxes, found);
  expect_same_pairs(found, truth, boxes, "dense", 1);
  first = Detector();
  first.find_pairs(boxes, found);
  expect_same_pairs(found, truth, boxes, "dense", 1);
}

}  // namespace
}  // namespace boxstream::tests
