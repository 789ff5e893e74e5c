// SPDX-License-Identifier: MIT
// What queries of distances hold at a time: every allocation of this program is counted.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>

#include <boxstream/world.hpp>

#include "heap_watch.hpp"

namespace boxstream::tests {

namespace {

void fill(World64& world, std::size_t n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 100);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = place(random), y = place(random), z = place(random);
    world.create({{x, y, z}, {x + 1, y + 1, z + 1}});
  }
  (void)world.bounds();  // makes the index
}

/// What a query holds beyond what the World did before.
template <class Query>
std::size_t most_bytes(Query&& query) {
  heap_watch::reset_peak();
  const std::int64_t before = heap_watch::live_bytes();
  query();
  return static_cast<std::size_t>(heap_watch::peak_bytes() - before);
}

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::size_t bytes_per_pair = 16;
constexpr std::size_t copies = 3;  // while they are sorted, and while a vector grows

}  // namespace

TEST(NearestMemory, NothingGrowsWithTheNumberOfPairs) {
  constexpr std::size_t n = 2000;
  World64 world;
  fill(world, n);
  std::size_t pairs = 0;
  double last = 0;
  const std::size_t bytes = most_bytes([&] {
    world.nearest_pairs(inf, [&](ProxyPair, double distance) {
      EXPECT_LE(last, distance);
      last = distance;
      ++pairs;
      return inf;
    });
  });
  EXPECT_EQ(pairs, n * (n - 1) / 2);
  EXPECT_LE(bytes, 64 * n * copies * bytes_per_pair + 100000) << "a band has room for 64 pairs a proxy";
  EXPECT_LT(bytes, pairs * bytes_per_pair / 4);
}

TEST(NearestMemory, ManyBoxesAndALimitThatNeverFalls) {
  constexpr std::size_t n = 20000;
  World64 world;
  fill(world, n);
  std::size_t pairs = 0;
  const std::size_t bytes =
      most_bytes([&] { world.nearest_pairs(inf, [&](ProxyPair, double) { return ++pairs == 1200000 ? 0 : inf; }); });
  EXPECT_EQ(pairs, 1200000u);
  EXPECT_LE(bytes, (std::size_t{1} << 20) * copies * bytes_per_pair + 1000000);
}

// All boxes at one place, so that no distance tells any two pairs apart.
TEST(NearestMemory, CopiesAreStreamed) {
  constexpr std::size_t n = 3000;
  World64 world;
  for (std::size_t i = 0; i < n; ++i) world.create({{0, 0, 0}, {1, 1, 1}});
  (void)world.bounds();
  std::size_t pairs = 0;
  const std::size_t bytes =
      most_bytes([&] { world.nearest_pairs(1, [&](ProxyPair, double) { return ++pairs, 1.0; }); });
  EXPECT_EQ(pairs, n * (n - 1) / 2);
  EXPECT_LT(bytes, 100 * n);
}

TEST(NearestMemory, WarmQueriesDoNotAllocate) {
  World64 world;
  fill(world, 1000);
  const auto query = [&] {
    std::size_t visits = 0;
    world.nearest_pairs(inf, [&](ProxyPair pair, double) {
      world.query_nearest_box(world.box(pair.a), inf, [&](ProxyId, double distance) { return distance > 3 ? 0 : inf; });
      return ++visits == 1000 ? 0 : inf;
    });
  };
  query();
  const std::uint64_t before = heap_watch::allocations();
  query();
  EXPECT_EQ(heap_watch::allocations(), before);
}

}  // namespace boxstream::tests
