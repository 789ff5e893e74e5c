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

void fill(World64& world, std::size_t n, double extent) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, extent);
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
}  // namespace

TEST(NearestMemory, NothingIsHeld) {
  constexpr std::size_t n = 2000;
  for (const double extent : {0., 100.}) {  // copies of one box, or scattered
    World64 world;
    fill(world, n, extent);
    std::size_t pairs = 0;
    const std::size_t bytes =
        most_bytes([&] { world.nearest_pairs(inf, [&](ProxyPair, double) { return ++pairs, inf; }); });
    EXPECT_EQ(pairs, n * (n - 1) / 2);
    EXPECT_EQ(bytes, 0u);
  }
}

TEST(NearestMemory, QueriesDoNotAllocate) {
  World64 world;
  fill(world, 1000, 100);
  std::size_t visits = 0;
  const std::uint64_t before = heap_watch::allocations();
  world.nearest_pairs(inf, [&](ProxyPair pair, double) {
    world.query_nearest_box(world.box(pair.a), 3, [&](ProxyId, double) { return 3; });
    return ++visits == 1000 ? 0 : inf;
  });
  EXPECT_EQ(heap_watch::allocations(), before);
}

}  // namespace boxstream::tests
