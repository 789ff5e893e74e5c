// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "bvh/bvh_block.hpp"

namespace boxstream::detail {

template <class S>
class Bvh;

/// A walk over the boxes of an index that share a point with one box: pending inserts, then those of the tree. It knows
/// what it has yet to visit, and the leaf block that it has come to.
struct OverlapWalk {
  /// Children of one block.
  struct Open {
    std::uint32_t block;
    std::uint16_t level;
    std::uint16_t lanes;
  };
  static constexpr unsigned most_levels = 11;

  template <class S>
  explicit OverlapWalk(const Bvh<S>& bvh) : pending(bvh.tree_blocks()), has_tree(bvh.levels() != 0) {}

  std::size_t pending;  // the next block of them
  bool has_tree;        // whether the tree is still to be visited
  std::uint32_t block = 0;
  unsigned lanes = 0;  // those of the block that share a point with the box
  unsigned open_count = 0;
  Open open[most_levels];
};

/// Finds the next leaf block with boxes that touch `box`; false at the end. Lazy: nothing is searched ahead. `box` is
/// valid, and the same in all calls. Where the caller flushes denormal numbers to zero, a few more boxes are found.
bool find_next(const Bvh<float>& bvh, const Aabb& box, OverlapWalk& walk);
bool find_next(const Bvh<double>& bvh, const Aabb64& box, OverlapWalk& walk);

/// Which of a few boxes touch: bit j % 64 of word j / 64 of row i, for i < j.
struct FewPairs {
  static constexpr std::size_t most = 128;

  std::uint64_t rows[most][most / 64];
};

/// Of the boxes in `count` blocks.
void find_few_pairs(const BoxBlock<float>* blocks, std::size_t count, FewPairs& pairs);
void find_few_pairs(const BoxBlock<double>* blocks, std::size_t count, FewPairs& pairs);

}  // namespace boxstream::detail
