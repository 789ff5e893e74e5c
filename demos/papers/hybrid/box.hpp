// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace boxstream::papers {

/// Half-open: { x : lo <= x < hi }, and never empty: lo < hi.
/// The paper distinguishes intervals by their low ends alone, so an empty one would be found as a point of others.
struct Interval {
  std::int32_t lo, hi;
};

/// A box of the paper: the product of three half-open intervals with integer ends.
struct Box {
  Interval projections[3];
};

/// A box that may move in memory, because it takes its number with it.
struct NumberedBox {
  Interval projections[3];
  std::int32_t num;
};

/// lo[d] + side must be an int.
struct Cube {
  std::int32_t lo[3];
  std::int32_t side;
  std::int32_t num;
};

}  // namespace boxstream::papers
