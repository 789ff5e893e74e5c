// SPDX-License-Identifier: MIT
#include "base/first_block.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace boxstream::detail {
namespace {

using Block = FirstBlock<64>;
template <class T>
using Vector = std::vector<T, Block::Allocator<T>>;

TEST(FirstBlock, HasWhatFitsInIt) {
  Block block;
  void* const first = block.take(3, 1);
  void* const second = block.take(8, 8);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(second) % 8, 0u);
  EXPECT_EQ(static_cast<std::byte*>(second) - static_cast<std::byte*>(first), 8);
  EXPECT_EQ(block.take(49, 1), nullptr);
  void* const last = block.take(48, 1);
  EXPECT_NE(last, nullptr);
  EXPECT_EQ(block.take(1, 1), nullptr);
  const int elsewhere = 0;
  EXPECT_FALSE(block.give_back(&elsewhere));
  EXPECT_TRUE(block.give_back(second));
  EXPECT_EQ(block.take(8, 8), nullptr) << "not while another is there";
  EXPECT_TRUE(block.give_back(first));
  EXPECT_TRUE(block.give_back(last));
  EXPECT_EQ(block.take(64, 1), first);
}

TEST(FirstBlock, VectorsGrowOutOfIt) {
  Block block;
  Vector<std::uint32_t> numbers{Block::Allocator<std::uint32_t>(block)};
  Vector<std::uint64_t> others{Block::Allocator<std::uint64_t>(block)};
  for (std::uint32_t i = 0; i < 100; ++i) {
    numbers.push_back(i);
    others.push_back(i);
  }
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0u), 4950u);
  EXPECT_EQ(std::accumulate(others.begin(), others.end(), std::uint64_t{0}), 4950u);
  EXPECT_NE(block.take(64, 1), nullptr) << "all of it is free again";
}

}  // namespace
}  // namespace boxstream::detail
