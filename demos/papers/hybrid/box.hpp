// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

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

/// Each box with its place as its number, in memory for just as many.
inline std::vector<NumberedBox> numbered(Span<const Box> boxes) {
  std::vector<NumberedBox> copies;
  copies.reserve(boxes.size());
  for (const Box& box : boxes)
    copies.push_back(
        {{box.projections[0], box.projections[1], box.projections[2]}, static_cast<std::int32_t>(copies.size())});
  return copies;
}

}  // namespace boxstream::papers
