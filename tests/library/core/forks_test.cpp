// SPDX-License-Identifier: MIT
// Forks of a process that has a ThreadPool: the child has one thread, and searches on.
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <boxstream/detector.hpp>

#include "box_sets.hpp"
#include "many_sets.hpp"
#include "sanitized.hpp"
#include "thread_pool.hpp"

namespace boxstream::tests {
namespace {

constexpr unsigned most_seconds = 20;  // a child that hangs dies of its alarm

/// Ends a child with what a parent takes for right or wrong.
[[noreturn]] void leave(bool right) {
  _exit(right ? 0 : 1);
}

bool ended_right(pid_t child) {
  int status = -1;
  return waitpid(child, &status, 0) == child && status == 0;
}

/// Calls `child()` in the child of a fork.
template <class Child>
void expect_right_in_child(const Child& child) {
  const pid_t pid = fork();
  if (pid == 0) {
    alarm(most_seconds);
    leave(child());
  }
  EXPECT_TRUE(ended_right(pid));
}

/// `search(detector, sink)` forks in each of some calls of its sink; then parent and child have the same pairs each,
/// and may search again.
template <class Search>
void expect_same_in_both(const Search& search) {
  threads::ThreadPool pool(3);
  Pairs expected;
  const auto append_to = [](Pairs& pairs) {
    return [&pairs](Span<const Pair> some) {
      pairs.insert(pairs.end(), some.begin(), some.end());
      return true;
    };
  };
  Detector serial;
  search(serial, append_to(expected));
  for (const std::size_t last : {1, 2, 5, 9}) {
    Detector detector(DetectorOptions{&pool});
    Pairs found, again;
    std::size_t calls = 0;
    pid_t child = -1;
    search(detector, [&](Span<const Pair> pairs) {
      if (++calls == last && (child = fork()) == 0) alarm(most_seconds);
      return append_to(found)(pairs);
    });
    ASSERT_GE(calls, last);
    search(detector, append_to(again));
    const bool right = found == expected && again == expected;
    if (child == 0) leave(right && pool.is_forked() && pool.concurrency() == 1);
    EXPECT_TRUE(right && !pool.is_forked() && pool.concurrency() == 3);
    ASSERT_TRUE(ended_right(child));
  }
}

TEST(Forks, InASinkOfOneSet) {
  const auto boxes = box_set<float>("dense").make(17000, 11);
  expect_same_in_both([&](Detector& detector, auto sink) { detector.stream_pairs(boxes, sink); });
}

TEST(Forks, InASinkOfTwoSets) {
  const auto a = box_set<double>("dense").make(17000, 12), b = box_set<double>("dense").make(15000, 13);
  expect_same_in_both([&](Detector& detector, auto sink) { detector.stream_pairs(a, b, sink); });
}

TEST(Forks, InASinkOfManySets) {
  const auto sets = make_many<float>(std::vector<std::size_t>(3000, 20), 14);
  expect_same_in_both([&](Detector& detector, auto sink) { detector.stream_pairs(sets.boxes, sets.offsets, sink); });
}

/// The helpers of a search are wanted again after the fork, and those of others are not waited for.
TEST(Forks, InATaskOfTheCallingThread) {
  threads::ThreadPool pool(2);
  std::vector<std::atomic<int>> runs(4000);
  std::vector<pid_t> children;
  const auto caller = std::this_thread::get_id();
  const pid_t parent = getpid();
  pool.parallel_for(runs.size(), [&](std::size_t i) {
    std::this_thread::sleep_for(std::chrono::microseconds(10));
    if (i % 500 == 7 && std::this_thread::get_id() == caller && getpid() == parent) {
      const pid_t child = fork();
      if (child == 0) alarm(most_seconds);
      children.push_back(child);
    }
    ++runs[i];
  });
  bool once = true;
  for (const auto& r : runs) once &= r == 1;
  if (getpid() != parent) leave(once);
  EXPECT_TRUE(once);
  for (const pid_t child : children) EXPECT_TRUE(ended_right(child));
}

TEST(Forks, BetweenSearches) {
  const auto boxes = box_set<float>("sparse").make(20000, 15);
  threads::ThreadPool pool(3);
  Detector detector(DetectorOptions{&pool});
  Pairs expected;
  detector.find_pairs(boxes, expected);
  const auto finds_them = [&] {
    Pairs found;
    detector.find_pairs(boxes, found);
    return found == expected;
  };
  for (int round = 0; round < 5 && !HasFailure(); ++round)
    expect_right_in_child([&] {
      if (!finds_them()) return false;
      const pid_t grandchild = fork();
      if (grandchild == 0) leave(finds_them());
      return ended_right(grandchild) && finds_them();
    });
  EXPECT_TRUE(finds_them());
}

/// Its search ends with it in the child, which makes a Detector of its own.
TEST(Forks, WhileAnotherThreadSearches) {
  const auto boxes = box_set<float>("sparse").make(20000, 16);
  threads::ThreadPool pool(3);
  Pairs expected;
  Detector().find_pairs(boxes, expected);
  std::atomic<bool> done{false}, wrong{false};
  std::thread searching([&] {
    Detector detector(DetectorOptions{&pool});
    Pairs found;
    while (!done) {
      detector.find_pairs(boxes, found);
      if (found != expected) wrong = true;
    }
  });
  for (int round = 0; round < (sanitized ? 5 : 30) && !HasFailure(); ++round)
    expect_right_in_child([&] {
      Detector detector(DetectorOptions{&pool});
      Pairs found;
      detector.find_pairs(boxes, found);
      return found == expected;
    });
  done = true;
  searching.join();
  EXPECT_FALSE(wrong);
}

/// In a process of its own, the first fork comes as the first pool is made.
TEST(Forks, WhileOtherThreadsMakeAndEndPools) {
  std::atomic<bool> done{false};
  std::thread making([&] {
    while (!done) threads::ThreadPool pool(2);
  });
  for (int round = 0; round < (sanitized ? 5 : 50) && !HasFailure(); ++round)
    expect_right_in_child([] { return threads::ThreadPool(1).concurrency() == 1; });
  done = true;
  making.join();
}

}  // namespace
}  // namespace boxstream::tests
