// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

/// A discretely oriented polytope: the intersection of K / 2 slabs whose normals are the same for all, so that two of
/// them are compared number by number like axis-aligned boxes. Normals have coordinates of -1, 0 and 1, as is usual:
/// the axes, with the diagonals of a cube (K = 14), with those of its faces (18), or both (26). The sum of the
/// coordinates is all it takes to project; merging is exact.
template <int K>
struct Dop {
  static_assert(K == 14 || K == 18 || K == 26);
  static constexpr std::size_t slabs = K / 2;

  std::array<double, slabs> low, high;  ///< of normal(i) p

  static Dop around(Points points);
  static Dop around(Span<const Dop> dops);
  static constexpr bool merges_exactly = true;
  static std::string name() { return std::to_string(K) + "-DOP"; }
  static Point normal(std::size_t slab);

  double excess(const Point& p) const;
  Aabb64 bounds() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
  double volume() const;
  double area() const;

  friend bool overlap(const Dop& a, const Dop& b) {
    for (std::size_t i = 0; i < slabs; ++i)
      if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
    return true;
  }
};
extern template struct Dop<14>;
extern template struct Dop<18>;
extern template struct Dop<26>;
static_assert(Volume<Dop<14>> && Volume<Dop<18>> && Volume<Dop<26>>);

}  // namespace boxstream::papers::volumes
