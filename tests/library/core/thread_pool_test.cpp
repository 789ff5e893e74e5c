// SPDX-License-Identifier: MIT
// The threads of the Python package and the benchmarks, awake and asleep. For the thread sanitizer as well.
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <boxstream/detector.hpp>

#include "box_sets.hpp"
#include "sanitized.hpp"
#include "thread_pool.hpp"

namespace boxstream::tests {
namespace {

constexpr std::chrono::milliseconds until_asleep{5};

void expect_each_once(Executor& executor, std::size_t count) {
  std::vector<std::atomic<int>> calls(count);
  executor.parallel_for(count, [&](std::size_t i) { ++calls[i]; });
  for (const std::atomic<int>& c : calls) ASSERT_EQ(c, 1);
}

TEST(ThreadPool, RunsEachTaskOnceAwakeAndAsleep) {
  for (const unsigned threads : {1, 2, 3, 9}) {
    threads::ThreadPool pool(threads);
    EXPECT_EQ(pool.concurrency(), threads);
    for (int round = 0; round < 200; ++round) {
      for (const std::size_t count : {0, 1, 2, 50}) expect_each_once(pool, count);
      if (round % 20 == 0) std::this_thread::sleep_for(until_asleep);
      pool.start_nanoseconds();
    }
  }
}

/// Tries for as long as a busy machine may take.
template <class Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition())
    if (std::chrono::steady_clock::now() > end) return false;
  return true;
}

TEST(ThreadPool, StartsSlowlyAsleepAndIsWokenWhereItIsAskedOften) {
  threads::ThreadPool pool(2);
  EXPECT_TRUE(comes_true([&] {
    std::this_thread::sleep_for(until_asleep);
    return pool.start_nanoseconds() == 50000;
  }));
  EXPECT_TRUE(comes_true([&] { return pool.start_nanoseconds() < 50000; }));
}

TEST(ThreadPool, IsMadeAndEndedAtOnce) {
  for (int round = 0; round < 50; ++round) {
    threads::ThreadPool pool(4);
    if (round % 2 == 0) expect_each_once(pool, 3);
    if (round % 10 == 0) std::this_thread::sleep_for(until_asleep);
  }
}

/// One of the searches gets the threads; results are the same.
TEST(ThreadPool, ServesSearchesSideBySide) {
  threads::ThreadPool pool(3);
  const auto boxes = box_set<float>("sparse").make(4000, 1);
  std::vector<Pair> expected;
  Detector().find_pairs(boxes, expected);
  std::vector<std::thread> callers;
  std::atomic<int> wrong{0};
  for (int caller = 0; caller < 3; ++caller)
    callers.emplace_back([&, caller] {
      Detector detector(DetectorOptions{&pool});
      std::vector<Pair> found;
      for (int round = 0; round < (sanitized ? 10 : 100); ++round) {
        if (round % 25 == caller) std::this_thread::sleep_for(until_asleep);
        detector.find_pairs(boxes, found);
        wrong += found != expected;
      }
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(wrong, 0);
}

/// Tasks that take far longer than a thread looks out for more.
TEST(ThreadPool, WaitsForLongTasks) {
  threads::ThreadPool pool(2);
  std::atomic<int> done{0};
  for (int round = 0; round < 5; ++round)
    pool.parallel_for(2, [&](std::size_t i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(i == 0 ? 1 : 4));
      ++done;
    });
  EXPECT_EQ(done, 10);
}

}  // namespace
}  // namespace boxstream::tests
