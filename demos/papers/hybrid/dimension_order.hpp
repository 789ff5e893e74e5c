// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <boxstream/span.hpp>

#include "papers/hybrid/box.hpp"
#include "papers/hybrid/hybrid_search.hpp"

/// Which dimension is scanned and which ones have a tree: the knob that section 5 leaves to "prior knowledge", and the
/// restart in another dimension that it asks for where there is none.
namespace boxstream::papers {

/// of[d] is the dimension of the caller's boxes that the procedures take for their dimension d: [0] is scanned, [2] has
/// the first level of the tree, [1] the second. A permutation of 0, 1, 2.
struct DimensionOrder {
  std::array<int, 3> of{0, 1, 2};
  friend bool operator==(const DimensionOrder&, const DimensionOrder&) = default;
};

/// The same boxes with their dimensions in that order. Their pairs are the same.
std::vector<Box> reordered(Span<const Box> boxes, DimensionOrder order);

/// An order whose first tree divides the intervals: `first`, or, where its tree fails to, one with another dimension
/// there (2 and 1 exchanged, which leaves the scanned one as it is; then 2 and 0), or `first` again where all three
/// fail. Nothing is reported while it is looked for, so that a search that restarts finds no pair twice.
///
/// A tree fails to divide when a point, four levels below its root, still meets more than a quarter of all intervals on
/// average: sixteen nodes that divided them well would leave a sixteenth. O(n) for each tree that is tried.
DimensionOrder dividing_order(Span<const Box> intervals, Span<const Box> points, const HybridOptions& options,
                              DimensionOrder first);

}  // namespace boxstream::papers
