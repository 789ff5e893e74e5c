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
  bool has_tree;        // which is yet to be visited
  std::uint32_t block = 0;
  unsigned lanes = 0;  // of it, which share a point with the box
  unsigned open_count = 0;
  Open open[most_levels];
};

/// Goes on to the next leaf block that has any; false at the end. Only what is asked for is looked for. `box` is valid,
/// and always the same. Where denormal numbers are taken for zero some more are found.
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
