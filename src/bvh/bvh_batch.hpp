// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>

#include "base/thresholds.hpp"
#include "bvh/bvh_block.hpp"

namespace boxstream::detail {

/// Boxes and what they are to be compared with, blocks or places, in two arrays.
struct Visits {
  std::uint32_t* boxes;
  std::uint32_t* blocks;
  std::size_t count;
};

/// Boxes against a tree, many at a time. All walks go down together: what is to be visited on a level is a list, from
/// which the list for the next level is written without branches. Loads overlap, because no visit depends on the one
/// before.
///
/// Lists are worked off in portions before they are added to, so that they take no more memory for boxes that touch
/// everything.
template <class S>
class BatchWalk {
 public:
  /// Gets boxes and the places of what they touch, in no particular order.
  using Sink = FunctionRef<void(const Visits& found)>;

  static constexpr std::size_t portion = thresholds.visits;
  /// Visits found by those of a portion at most, and what vectors may write beyond.
  static constexpr std::size_t list_size = (portion + 1) * BoxBlock<S>::width;

  /// `levels` are the first blocks of each level, leaves first. `boxes` are valid.
  void find(Span<const BoxBlock<S>* const> levels, Span<const BasicAabb<S>> boxes, Sink sink);

  /// The same for `count` blocks in a row, all of which are visited.
  void find_in_row(const BoxBlock<S>* blocks, std::size_t first, std::size_t count, Span<const BasicAabb<S>> boxes,
                   Sink sink);

 private:
  void descend(Span<const BoxBlock<S>* const> levels, std::size_t level, Span<const BasicAabb<S>> boxes,
               const Visits& visits, Sink sink);
  Visits list(std::size_t level) { return {&lists_[2 * level * list_size], &lists_[(2 * level + 1) * list_size], 0}; }

  std::vector<std::uint32_t> lists_;
};

/// The inner loop: for each visit (box, block), (box, 8 * block + lane) for each lane that the box touches. `found` has
/// room for eight for each visit and for eight more, and its count is set.
void visit_blocks(const Visits& visits, const BoxBlock<float>* blocks, const Aabb* boxes, Visits& found);
void visit_blocks(const Visits& visits, const BoxBlock<double>* blocks, const Aabb64* boxes, Visits& found);

extern template class BatchWalk<float>;
extern template class BatchWalk<double>;

}  // namespace boxstream::detail
