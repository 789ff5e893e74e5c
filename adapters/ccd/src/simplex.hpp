// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "placed_shape.hpp"

namespace boxstream::ccd {

/// A point of A - B together with the points of A and B that it is made of.
struct Vertex {
  Vec w;
  Vec a;
  Vec b;
};

/// One to four vertices and the weights of one point of their hull.
struct Simplex {
  std::array<Vertex, 4> vertex;
  std::array<double, 4> weight{};
  int size = 0;

  void add(const Vertex& v) { vertex[static_cast<std::size_t>(size++)] = v; }
  const Vertex& operator[](int i) const { return vertex[static_cast<std::size_t>(i)]; }
  Vec point() const { return mix(&Vertex::w); }
  Vec mix(Vec Vertex::*part) const;
};

/// Keeps the vertices that the point of the hull nearest to the origin needs, with its weights. True if the hull is a
/// tetrahedron with the origin inside. Degenerate simplices are legal: the best of their faces counts.
bool reduce_to_nearest(Simplex& simplex);

}  // namespace boxstream::ccd
