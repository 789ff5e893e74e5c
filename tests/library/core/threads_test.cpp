// SPDX-License-Identifier: MIT
// Real threads, for the thread sanitizer as well: executors, and Detectors side by side.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "golden_file.hpp"
#include "many_sets.hpp"
#include "same_pairs.hpp"
#include "sanitized.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Threads : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Threads, Scalars);

TYPED_TEST(Threads, SameOrderAndCountsForAnyNumber) {
  // Races do not depend on the data as results do.
  std::vector<const char*> names = {"sparse", "rods_mixed"};
  if (!sanitized)
    names.insert(names.end(), {"dense", "slices_y", "six_decades", "ties", "touching_lattice", "invalid_among_valid",
                               "dust_and_planes", "comb_and_plates_z"});
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const auto& set = box_set<TypeParam>(name);
    const auto a = set.make(std::min<std::size_t>(17000, set.largest), 1), b = set.make(2000, 2);
    Detector serial;
    const auto expected = search_all<TypeParam>(serial, a, b);
    const auto expect_same = [&](Executor& executor, int rounds) {
      Detector detector(DetectorOptions{&executor});
      for (int round = 0; round < rounds; ++round) expect_same_search(search_all<TypeParam>(detector, a, b), expected);
    };
    for (const unsigned threads : {1, 2, 3, 4, 7, 64}) {
      SCOPED_TRACE(std::to_string(threads) + " threads");
      ThreadExecutor executor(threads);
      expect_same(executor, 2);
    }
    ThreadExecutor late(4, true);
    expect_same(late, 1);
    ReversedExecutor reversed(5);
    expect_same(reversed, 1);
    ShuffledExecutor shuffled(64);
    expect_same(shuffled, 3);
  }
}

/// From this number of boxes on a search is shared, and not below: it depends on how soon threads start.
TEST(ThreadsStart, SaysFromWhichSizeSearchesAreShared) {
  constexpr struct {
    std::uint32_t nanoseconds;
    std::size_t least;
  } cases[] = {{0, 2000}, {3000, 2000}, {50000, 16384}, {100000, 32768}};
  for (const auto& each : cases) {
    SCOPED_TRACE(std::to_string(each.nanoseconds) + " ns");
    for (const std::size_t boxes : {each.least - 1, each.least}) {
      std::vector<std::size_t> sizes(100, boxes / 100);
      sizes.back() += boxes % 100;
      const auto sets = make_many<float>(sizes, 1);
      InlineExecutor executor(4, each.nanoseconds);
      PairsOfSets found, expected;
      Detector(DetectorOptions{&executor}).find_pairs(sets.boxes, sets.offsets, found);
      Detector().find_pairs(sets.boxes, sets.offsets, expected);
      EXPECT_EQ(executor.calls() != 0, boxes == each.least);
      expect_same_sets(found, expected, "many sets");
    }
  }
  for (const auto& [nanoseconds, shared] : {std::pair{3000u, true}, {50000u, false}}) {
    InlineExecutor executor(4, nanoseconds);
    Pairs pairs;
    Detector(DetectorOptions{&executor}).find_pairs(box_set<float>("dense").make(6000, 1), pairs);
    EXPECT_EQ(executor.calls() != 0, shared);
  }
}

TYPED_TEST(Threads, SameForFewBoxesAndHoweverSoonThreadsStart) {
  std::vector<const char*> names = {"dense"};
  if (!sanitized) names.insert(names.end(), {"sparse", "rods_mixed", "invalid_among_valid"});
  for (const char* name : names)
    for (const std::size_t n :
         sanitized ? std::vector<std::size_t>{3001} : std::vector<std::size_t>{2000, 3001, 9000}) {
      SCOPED_TRACE(name + (" " + std::to_string(n)));
      const auto a = box_set<TypeParam>(name).make(n, 1), b = box_set<TypeParam>(name).make(n / 2, 2);
      Detector serial;
      const auto expected = search_all<TypeParam>(serial, a, b);
      for (const unsigned threads : {2, 3, 64})
        for (const std::uint32_t start : {0, 20000, 1000000}) {
          InlineExecutor executor(threads, start);
          Detector detector(DetectorOptions{&executor});
          expect_same_search(search_all<TypeParam>(detector, a, b), expected);
        }
      for (const unsigned threads : {2, 4}) {
        ThreadExecutor executor(threads);
        Detector detector(DetectorOptions{&executor});
        expect_same_search(search_all<TypeParam>(detector, a, b), expected);
      }
    }
}

/// Large enough that children, and the joins of large boxes, are shared by the threads too, and that ranges are many.
TYPED_TEST(Threads, SameWhenThreadsShareInnerNodes) {
  const std::vector<unsigned> counts = sanitized ? std::vector<unsigned>{3} : std::vector<unsigned>{2, 7, 64};
  std::vector<const char*> names = {"rods_mixed"};
  if (!sanitized) names.push_back("sparse");
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const auto a = box_set<TypeParam>(name).make(70000, 1), b = box_set<TypeParam>(name).make(40000, 2);
    Detector serial;
    const auto expected = search_all<TypeParam>(serial, a, b);
    for (const unsigned threads : counts) {
      SCOPED_TRACE(std::to_string(threads) + " threads");
      ThreadExecutor executor(threads);
      Detector detector(DetectorOptions{&executor});
      expect_same_search(search_all<TypeParam>(detector, a, b), expected);
    }
    if (sanitized) continue;
    ReversedExecutor reversed(2);
    Detector detector(DetectorOptions{&reversed});
    expect_same_search(search_all<TypeParam>(detector, a, b), expected);
  }
}

/// Small sets are shared by threads; those that are large have all of them.
TYPED_TEST(Threads, SameForManySets) {
  std::vector<std::size_t> sizes = uneven_sizes(1200, 7);
  sizes.insert(sizes.begin() + 700, {17000, 0, 3});
  const auto sets = make_many<TypeParam>(sizes, 7);
  PairsOfSets expected, found;
  Detector().find_pairs(sets.boxes, sets.offsets, expected);
  for (const unsigned threads : {2, 3, 64})
    for (const bool late : {false, true}) {
      ThreadExecutor executor(threads, late);
      Detector detector(DetectorOptions{&executor});
      detector.find_pairs(sets.boxes, sets.offsets, found);
      expect_same_sets(found, expected, std::to_string(threads) + " threads");
      Pairs streamed;
      detector.stream_pairs(sets.boxes, sets.offsets, [&](Span<const Pair> pairs) {
        streamed.insert(streamed.end(), pairs.begin(), pairs.end());
        return true;
      });
      EXPECT_EQ(streamed, expected.pairs);
    }
}

/// Tasks that find more than they may hold back: three groups of boxes in one place with 2 million pairs each, far from
/// each other, where a stream may hold 2 million.
TYPED_TEST(Threads, SameWhenPairsOverflowTheRoom) {
  Boxes<TypeParam> boxes = box_set<TypeParam>("sparse").make(20000, 1);
  for (const std::size_t group : {0, 7000, 14000})
    for (std::size_t i = 0; i < 2000; ++i) boxes[group + i] = boxes[group];
  Detector serial;
  const auto expected = search_all<TypeParam>(serial, boxes, {});
  const auto expect_same = [&](Executor& executor) {
    Detector parallel(DetectorOptions{&executor});
    expect_same_search(search_all<TypeParam>(parallel, boxes, {}), expected);
  };
  ThreadExecutor threads(4);
  expect_same(threads);
  if (sanitized) return;  // nothing to see in executors without threads
  ReversedExecutor reversed(4);
  expect_same(reversed);
  ShuffledExecutor shuffled(4);
  for (int round = 0; round < 3; ++round) expect_same(shuffled);
}

/// However the tasks are spread, and though threads hand each other's pairs on.
TYPED_TEST(Threads, SinkRunsOnTheCallingThread) {
  const auto boxes = box_set<TypeParam>("dense").make(30000, 1);
  ThreadExecutor threads(4);
  Detector detector(DetectorOptions{&threads});
  const auto caller = std::this_thread::get_id();
  std::size_t elsewhere = 0, calls = 0;
  detector.stream_pairs(boxes, [&](Span<const Pair>) {
    ++calls;
    elsewhere += std::this_thread::get_id() == caller ? 0 : 1;
    return true;
  });
  EXPECT_GT(calls, 10u);
  EXPECT_EQ(elsewhere, 0u);
}

/// An executor whose caller only waits.
TYPED_TEST(Threads, SameWhenTheCallerTakesNoPart) {
  class Elsewhere final : public Executor {
   public:
    unsigned concurrency() const override { return 3; }
    void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
      std::thread([&] { ThreadExecutor(3).parallel_for(count, task); }).join();
    }
  } executor;
  const auto a = box_set<TypeParam>("dense").make(17000, 1), b = box_set<TypeParam>("dense").make(2000, 2);
  Detector serial, parallel(DetectorOptions{&executor});
  expect_same_search(search_all<TypeParam>(parallel, a, b), search_all<TypeParam>(serial, a, b));
}

/// A sink that stops, or throws, after each number of calls: what it got by then is the beginning of the whole.
TYPED_TEST(Threads, SinkMayStopOrThrowAnyTime) {
  const auto boxes = box_set<TypeParam>("dense").make(17000, 1);
  Pairs expected;
  Detector().find_pairs(boxes, expected);
  ThreadExecutor threads(4);
  ReversedExecutor reversed(4);
  for (Executor* executor : {static_cast<Executor*>(&threads), static_cast<Executor*>(&reversed)}) {
    Detector detector(DetectorOptions{executor});
    for (const bool throws : {false, true})
      for (const std::size_t last_call : {1, 2, 5, 20}) {
        Pairs got;
        std::size_t calls = 0;
        bool threw = false;
        try {
          const Stats stats = detector.stream_pairs(boxes, [&](Span<const Pair> pairs) {
            got.insert(got.end(), pairs.begin(), pairs.end());
            if (++calls != last_call) return true;
            if (throws) throw std::runtime_error("enough");
            return false;
          });
          EXPECT_EQ(stats.pairs, got.size());
        } catch (const std::runtime_error&) {
          threw = true;
        }
        EXPECT_EQ(threw, throws);
        EXPECT_EQ(calls, last_call);
        ASSERT_LE(got.size(), expected.size());
        EXPECT_TRUE(std::equal(got.begin(), got.end(), expected.begin()));
      }
    Pairs again;
    detector.find_pairs(boxes, again);
    EXPECT_EQ(again, expected);
  }
}

/// An executor may have more threads than it says.
TYPED_TEST(Threads, MoreThreadsThanPromised) {
  class Modest final : public Executor {
   public:
    unsigned concurrency() const override { return 2; }
    void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
      ThreadExecutor(8).parallel_for(count, task);
    }
  } executor;
  const auto a = box_set<TypeParam>("dense").make(17000, 1), b = box_set<TypeParam>("dense").make(2000, 2);
  Detector serial, parallel(DetectorOptions{&executor});
  const auto expected = search_all<TypeParam>(serial, a, b);
  expect_same_search(search_all<TypeParam>(parallel, a, b), expected);
}

/// Two Detectors at work at once share nothing; nor do the one-off calls.
TYPED_TEST(Threads, DetectorsSideBySide) {
  const auto a = box_set<TypeParam>("dense").make(17000, 1), b = box_set<TypeParam>("dense").make(2000, 2);
  Detector serial;
  const auto expected = search_all<TypeParam>(serial, a, b);
  std::vector<SearchRecord> found(4);
  std::vector<Pairs> one_off(found.size());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < found.size(); ++t)
    threads.emplace_back([&, t] {
      ThreadExecutor executor(2);
      Detector detector(DetectorOptions{t % 2 == 0 ? nullptr : &executor});
      for (int round = 0; round < 3; ++round) found[t] = search_all<TypeParam>(detector, a, b);
      one_off[t] = find_pairs(Span<const BasicAabb<TypeParam>>(b));
    });
  for (std::thread& thread : threads) thread.join();
  const Pairs truth = brute_force(b);
  for (std::size_t t = 0; t < found.size(); ++t) {
    expect_same_search(found[t], expected);
    expect_same_pairs(one_off[t], truth, b, "dense", 2);
  }
}

TEST(ThreadsGolden, OrderIsTheRecordedOneWithThreads) {
  if (sanitized) GTEST_SKIP() << "compared without sanitizers; with them, other tests compare with one thread";
  for (const unsigned threads : {1, 2, 3, 4}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    ThreadExecutor executor(threads);
    expect_golden_order(&executor);
  }
}

}  // namespace
}  // namespace boxstream::tests
