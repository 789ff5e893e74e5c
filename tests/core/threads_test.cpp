// SPDX-License-Identifier: MIT
// Real threads, for the thread sanitizer as well: executors, and Detectors side by side.
#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "golden_file.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Threads : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Threads, Scalars);

TYPED_TEST(Threads, SameOrderAndCountsForAnyNumber) {
  // Races do not depend on the data as results do, and the sanitizer makes threads slow to start.
#if defined(__SANITIZE_THREAD__)
  const std::vector<const char*> names = {"sparse", "rods_mixed"};
#else
  const std::vector<const char*> names = {"sparse",           "dense",
                                          "rods_mixed",       "slices_y",
                                          "six_decades",      "ties",
                                          "touching_lattice", "invalid_among_valid",
                                          "dust_and_planes",  "comb_and_plates_z"};
#endif
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const auto& set = box_set<TypeParam>(name);
    const auto a = set.make(std::min<std::size_t>(17000, set.largest), 1), b = set.make(2000, 2);
    Detector serial;
    const auto expected = search_all<TypeParam>(serial, a, b);
    for (const unsigned threads : {1, 2, 3, 4, 8, 64}) {
      SCOPED_TRACE(std::to_string(threads) + " threads");
      ThreadExecutor executor(threads);
      Detector detector(DetectorOptions{&executor});
      expect_same_search(search_all<TypeParam>(detector, a, b), expected);
      expect_same_search(search_all<TypeParam>(detector, a, b), expected);
    }
    ThreadExecutor late(4, true);
    Detector detector(DetectorOptions{&late});
    expect_same_search(search_all<TypeParam>(detector, a, b), expected);
  }
}

/// Tasks that find more than they may hold back.
TYPED_TEST(Threads, SameWhenPairsOverflowTheTasks) {
  Boxes<TypeParam> boxes = box_set<TypeParam>("sparse").make(20000, 1);
  for (std::size_t i = 0; i < 800; ++i) boxes[i] = boxes[0];
  for (std::size_t i = 10000; i < 10600; ++i) boxes[i] = boxes[10000];
  Detector serial;
  ThreadExecutor executor(4);
  Detector parallel(DetectorOptions{&executor});
  const Boxes<TypeParam> few(boxes.begin(), boxes.begin() + 1000);
  expect_same_search(search_all<TypeParam>(parallel, boxes, few), search_all<TypeParam>(serial, boxes, few));
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
  ThreadExecutor executor(3);
  Detector detector(DetectorOptions{&executor});
  expect_golden_order(detector);
}

}  // namespace
}  // namespace boxstream::tests
