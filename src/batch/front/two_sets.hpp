// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/cuts/wide_tree.hpp"
#include "batch/records/pair_buffer.hpp"
#include "batch/records/source.hpp"

namespace boxstream::detail {

/// A search between two sets, and what it works with.
struct CrossSearch {
  Arena& arena;
  PairBuffer& pairs;
  Stats& stats;
  KeyKind kinds[3];
  Faces faces;

  /// Finds the pairs between `a` and `b`, which come first and second in them. Few boxes are compared with all of the
  /// other set, block by block. Of larger sets, boxes that cannot meet any of the other are culled, where these are
  /// many, before `tree` joins what is left. False when the buffer's owner wants to stop.
  template <class S>
  bool join(const BoxSource<S>& a, const BoxSource<S>& b, WideTree& tree);
};

}  // namespace boxstream::detail
