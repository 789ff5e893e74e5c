// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <boxstream/stats.hpp>

#include "search/arena.hpp"
#include "search/pair_buffer.hpp"
#include "search/source.hpp"
#include "search/tree.hpp"

namespace boxstream::detail {

/// A search between two sets, and what it works with.
struct CrossSearch {
  Arena& arena;
  PairBuffer& pairs;
  Stats& stats;
  KeyKind kinds[3];

  /// Finds the pairs between `a` and `b`, which come first and second in them. Few boxes are compared with all of the
  /// other set, block by block. Of larger sets, boxes that cannot meet any of the other are culled, where these are
  /// many, before `tree` joins what is left. False when the buffer's owner wants to stop.
  template <class S>
  bool join(const BoxSource<S>& a, const BoxSource<S>& b, Tree& tree);

  /// The same of parts of sets, as records: there is no comparing block by block.
  bool join(const RecordSource& a, const RecordSource& b, Tree& tree);

 private:
  template <class S>
  bool join_few(const BoxSource<S>& few, const BoxSource<S>& many, bool few_first);

  /// Nothing where culling is not worthwhile.
  template <class Source>
  std::optional<bool> join_culled(const Source& a, const Source& b, Tree& tree, bool& was_tried);
};

}  // namespace boxstream::detail
