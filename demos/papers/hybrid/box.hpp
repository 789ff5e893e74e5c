// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>
#include <cstdint>
#include <vector>

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

// The procedures work on arrays of elements; one of these gives the box that an element stands for.

/// The elements are the boxes themselves.
struct Structures {
  static std::int32_t lo(const NumberedBox& box, int d) { return box.projections[d].lo; }
  static std::int32_t hi(const NumberedBox& box, int d) { return box.projections[d].hi; }
  static std::int32_t lo(const Cube& cube, int d) { return cube.lo[d]; }
  static std::int32_t hi(const Cube& cube, int d) { return cube.lo[d] + cube.side; }
  template <class Element>
  static std::uint32_t number(const Element& element) {
    return static_cast<std::uint32_t>(element.num);
  }
};

/// What a pointer was on the paper's 32-bit machines: four bytes that say which box of an array.
using Pointer = std::uint32_t;

/// The elements are pointers into an array of boxes, whose places are their numbers.
struct Pointers {
  const Box* boxes;

  std::int32_t lo(Pointer p, int d) const { return boxes[p].projections[d].lo; }
  std::int32_t hi(Pointer p, int d) const { return boxes[p].projections[d].hi; }
  static std::uint32_t number(Pointer p) { return p; }
};

}  // namespace boxstream::papers
