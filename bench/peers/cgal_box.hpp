// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>

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

/// Which of them is best depends on the input; its user would have to know beforehand.
constexpr std::size_t cgal_cutoffs[] = {10, 100, 300, 1000};

}  // namespace

}  // namespace boxstream::bench
