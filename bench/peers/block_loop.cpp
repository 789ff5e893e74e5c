// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <memory>

#include "peers/cross.hpp"

// Compiled for several processors, the best one being chosen when it runs, as our own vector code is.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define BOXSTREAM_BENCH_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BOXSTREAM_BENCH_CLONES
#endif

namespace boxstream::bench {

namespace {

/// Up to 512 boxes as six columns.
struct Block {
  static constexpr std::size_t size = 512;
  float low[3][size], high[3][size];
};

/// Which boxes of the block `box` meets, one number each; how many.
BOXSTREAM_BENCH_CLONES std::int32_t match(const Block& block, std::size_t count, const Aabb& box, std::int32_t* hits) {
  const float x0 = box.min[0], y0 = box.min[1], z0 = box.min[2], x1 = box.max[0], y1 = box.max[1], z1 = box.max[2];
  std::int32_t total = 0;
  for (std::size_t j = 0; j < count; ++j) {
    hits[j] = (block.low[0][j] <= x1) & (x0 <= block.high[0][j]) & (block.low[1][j] <= y1) & (y0 <= block.high[1][j]) &
              (block.low[2][j] <= z1) & (z0 <= block.high[2][j]);
    total += hits[j];
  }
  return total;
}

}  // namespace

CrossSearch make_block_loop() {
  struct Scratch {
    Block block;
    std::int32_t hits[Block::size];
  };
  return [scratch = std::make_shared<Scratch>()](Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) {
    auto& [block, hits] = *scratch;
    pairs.clear();
    const bool a_is_few = a.size() < b.size();
    const Span<const Aabb> few = a_is_few ? a : b, many = a_is_few ? b : a;
    for (std::size_t first = 0; first < many.size(); first += Block::size) {
      const std::size_t count = std::min(Block::size, many.size() - first);
      for (std::size_t j = 0; j < count; ++j)
        for (int d = 0; d < 3; ++d) {
          block.low[d][j] = many[first + j].min[d];
          block.high[d][j] = many[first + j].max[d];
        }
      for (std::uint32_t i = 0; i < few.size(); ++i) {
        if (match(block, count, few[i], hits) == 0) continue;
        for (std::size_t j = 0; j < count; ++j) {
          const auto other = static_cast<std::uint32_t>(first + j);
          if (hits[j] != 0) pairs.push_back(a_is_few ? Pair{i, other} : Pair{other, i});
        }
      }
    }
  };
}

}  // namespace boxstream::bench
