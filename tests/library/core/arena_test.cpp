// SPDX-License-Identifier: MIT
// Scratch memory: no two blocks overlap, and little more memory is held than is in use.
#include "base/arena.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "random.hpp"

namespace boxstream::tests {
namespace {

using detail::Arena;

/// Allocates blocks and inner frames at random, and sees at the end of each frame that its blocks are as they were.
void use(Arena& arena, Random& random, int depth, std::size_t longest) {
  const Arena::Frame frame(arena);
  struct Block {
    std::size_t* values;
    std::size_t size, mark;
  };
  std::vector<Block> blocks;
  for (std::size_t i = random.index(6); i > 0; --i) {
    const std::size_t size = 1 + random.index(longest), mark = random.index(1u << 20);
    blocks.push_back({arena.allocate<std::size_t>(size), size, mark});
    std::fill_n(blocks.back().values, size, mark);
    if (depth > 0) use(arena, random, depth - 1, longest);
  }
  for (const Block& block : blocks)
    ASSERT_EQ(std::count(block.values, block.values + block.size, block.mark), static_cast<std::ptrdiff_t>(block.size));
}

TEST(Arena, BlocksAreNobodyElses) {
  Random random(3);
  Arena kept;
  for (const std::size_t longest : {20, 3000, 30000})
    for (int round = 0; round < 30; ++round) {
      Arena fresh;
      use(fresh, random, 3, longest);
      use(kept, random, 3, longest);
      if (round % 10 == 9) kept.settle(kept.peak());
    }
}

/// Each block is longer than those before it, which are gone: one of them is there at a time.
TEST(Arena, LongerAndLongerBlocksTakeTheMemoryOfTheLongest) {
  Arena arena;
  const Arena::Frame outer(arena);
  arena.allocate<char>(50000);
  constexpr std::size_t longest = 900000;
  for (std::size_t size = 70000; size <= longest; size += 30000) {
    const Arena::Frame frame(arena);
    arena.allocate<char>(size);
    EXPECT_LE(arena.capacity(), 70000 + size);
  }
}

}  // namespace
}  // namespace boxstream::tests
