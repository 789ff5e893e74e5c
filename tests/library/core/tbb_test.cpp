// SPDX-License-Identifier: MIT
// The Executor on oneTBB. Not for the thread sanitizer, which does not see into oneTBB and takes its hand-overs for
// races; the threads of threads_test.cpp are for that.
#include <atomic>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <boxstream/tbb.hpp>

#include "box_sets.hpp"
#include "holding.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

class Tbb : public testing::Test {
  // As many as the tests ask for, on machines with fewer cores too.
  const tbb::global_control threads_{tbb::global_control::max_allowed_parallelism, 5};
};

TEST_F(Tbb, RunsEachTaskOnce) {
  TbbExecutor executor(4);
  EXPECT_EQ(executor.concurrency(), 4u);
  EXPECT_GE(TbbExecutor().concurrency(), 1u);
  for (const std::size_t count : {0, 1, 2, 3, 100, 10000}) {
    std::vector<std::atomic<int>> runs(count);
    executor.parallel_for(count, [&](std::size_t i) { ++runs[i]; });
    for (const auto& r : runs) EXPECT_EQ(r, 1);
  }
}

TEST_F(Tbb, RefusesNumbersOfThreadsThatNoMachineHas) {
  for (const int threads : {0, -2, -2000000000, TbbExecutor::most_threads + 1, std::numeric_limits<int>::max()})
    EXPECT_THROW(TbbExecutor{threads}, std::invalid_argument) << threads;
  EXPECT_EQ(TbbExecutor(TbbExecutor::most_threads).concurrency(), unsigned{TbbExecutor::most_threads});
}

TEST_F(Tbb, ResultsAreThoseOfOneThread) {
  for (const char* name : {"sparse", "dense", "rods_mixed", "invalid_among_valid"}) {
    SCOPED_TRACE(name);
    const auto a = box_set<float>(name).make(40000, 1), b = box_set<float>(name).make(20000, 2);
    Detector serial;
    const auto expected = search_all<float>(serial, a, b);
    for (const int threads : {1, 2, 5}) {
      TbbExecutor executor(threads);
      Detector detector({&executor});
      expect_same_search(search_all<float>(detector, a, b), expected);
    }
  }
}

TEST_F(Tbb, OneExecutorServesManyDetectors) {
  const auto a = box_set<float>("dense").make(20000, 1), b = box_set<float>("dense").make(2000, 2);
  Detector serial;
  const auto expected = search_all<float>(serial, a, b);
  TbbExecutor executor(3);
  std::vector<SearchRecord> found(3);
  std::vector<std::thread> threads;
  for (SearchRecord& record : found)
    threads.emplace_back([&] {
      Detector detector({&executor});
      record = search_all<float>(detector, a, b);
    });
  for (std::thread& thread : threads) thread.join();
  for (const SearchRecord& record : found) expect_same_search(record, expected);
}

TEST_F(Tbb, WhatASinkThrowsEndsWhereItIsCaught) {
  const auto boxes = box_set<float>("dense").make(20000, 4);
  TbbExecutor executor(3);
  Detector detector({&executor});
  for (const int last : {1, 3})
    expect_gone_once_caught([&](auto raise) {
      detector.stream_pairs(boxes, [&, calls = 0](Span<const Pair>) mutable {
        if (++calls == last) raise();
        return true;
      });
    });
}

}  // namespace
}  // namespace boxstream::tests
