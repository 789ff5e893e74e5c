// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

// In each source file a type of its own: with and without TBB, CGAL's templates must not be taken for the same ones.
namespace {

/// A model of CGAL's concept BoxIntersectionBox_d: 28 bytes, its id explicit.
struct CgalBox {
  using NT = float;
  using ID = std::uint32_t;

  static int dimension() { return 3; }
  ID id() const { return index; }
  NT min_coord(int d) const { return box.min[d]; }
  NT max_coord(int d) const { return box.max[d]; }

  Aabb box;
  std::uint32_t index;
};

/// CGAL permutes its input, so each search starts from a fresh copy. Boxes of the same id are taken for one and the
/// same.
void copy_boxes(Span<const Aabb> boxes, std::uint32_t first_id, std::vector<CgalBox>& copy) {
  copy.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) copy[i] = {boxes[i], first_id + static_cast<std::uint32_t>(i)};
}

/// Which of them is best depends on the input.
constexpr std::size_t cgal_cutoffs[] = {10, 100, 300, 1000};

}  // namespace

}  // namespace boxstream::bench
