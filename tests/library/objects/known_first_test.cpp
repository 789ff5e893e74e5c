// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boxstream/detail/known_first.hpp>

#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

namespace boxstream::detail {
namespace {

TEST(KnownFirst, OfTheSameSetsAndChanges) {
  KnownFirst first;
  const KnownFirst::Of of{3, 20, 30};
  EXPECT_EQ(first.find(of), KnownFirst::unknown);
  first.keep(of, 0);
  EXPECT_EQ(first.find(of), 0u);
  for (const KnownFirst::Of& another : {KnownFirst::Of{4, 20, 30}, {3, 21, 30}, {3, 20, 31}})
    EXPECT_EQ(first.find(another), KnownFirst::unknown);
  KnownFirst moved(std::move(first));
  EXPECT_EQ(moved.find(of), KnownFirst::unknown);
  moved.keep(of, 7);
  moved = KnownFirst();
  EXPECT_EQ(moved.find(of), KnownFirst::unknown);
}

/// No thread finds a pair that was kept of something else.
TEST(KnownFirst, ManyThreads) {
  KnownFirst first;
  std::atomic<std::uint64_t> found{0}, wrong{0};
  std::vector<std::thread> threads;
  for (std::uint64_t thread = 0; thread < 4; ++thread)
    threads.emplace_back([&, thread] {
      for (std::uint64_t i = 0; i < 40000; ++i) {
        const std::uint64_t x = 1 + (i / 4 + thread) % 5;  // in fours: a thread that runs alone finds what it kept
        const KnownFirst::Of of{x, 10 * x, 100 * x};
        const std::uint64_t pair = first.find(of);
        found += pair != KnownFirst::unknown;
        wrong += pair != KnownFirst::unknown && pair != 1000 * x;
        if (i % 3 != 0) first.keep(of, 1000 * x);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(found, 0u);
  EXPECT_EQ(wrong, 0u);
}

TEST(OwnNumber, IsItsOwn) {
  OwnNumber a, b;
  EXPECT_NE(std::uint64_t{a}, std::uint64_t{b});
  const std::uint64_t number = a;
  const OwnNumber moved = std::move(a);
  EXPECT_EQ(std::uint64_t{moved}, number);
}

}  // namespace
}  // namespace boxstream::detail
