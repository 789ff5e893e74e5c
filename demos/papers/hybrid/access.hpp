// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "papers/hybrid/box.hpp"

/// The procedures work on arrays of elements; one of these gives the box that an element stands for.
namespace boxstream::papers {

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
