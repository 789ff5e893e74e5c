// SPDX-License-Identifier: MIT
#include "core_distance.hpp"

#include <algorithm>

namespace boxstream::ccd {
namespace {

Vertex vertex_along(const ShapePair& pair, const Vec& direction) {
  Vertex v;
  v.a = pair.a.core_support(direction);
  v.b = pair.b.core_support(-direction);
  v.w = v.a - v.b;
  return v;
}

bool has_vertex(const Simplex& simplex, const Vec& w) {
  for (int i = 0; i < simplex.size; ++i)
    if (simplex[i].w == w) return true;
  return false;
}

}  // namespace

CoreDistance core_distance(const ShapePair& pair, int max_iterations, const Goal& goal) {
  CoreDistance result;
  result.direction = Vec::Zero();
  Vec towards = pair.b.centre() - pair.a.centre();
  if (!(towards.squaredNorm() > 0)) towards = Vec::UnitX();
  Simplex& simplex = result.simplex;
  simplex.add(vertex_along(pair, towards));
  simplex.weight[0] = 1;
  Vec nearest = simplex.point();
  result.upper = nearest.norm();
  // Negative until a plane separates the cores, so that cores that only touch are iterated until the plane fits.
  result.lower = -std::numeric_limits<double>::infinity();
  result.limit = true;

  for (int i = 0; i < max_iterations; ++i) {
    if (result.upper <= pair.noise) {
      result.overlap = true;
      result.limit = false;
      break;
    }
    const Vec direction = nearest / -result.upper;
    const Vertex added = vertex_along(pair, direction);
    if (const double apart = -added.w.dot(direction); apart > result.lower)
      result.lower = apart, result.direction = direction;
    const bool done = result.upper - result.lower <= pair.tolerance || result.lower > goal.enough_apart ||
                      result.upper <= goal.close_enough;
    // A repeated vertex: the limit of precision.
    if (done || has_vertex(simplex, added.w)) {
      result.limit = false;
      break;
    }
    Simplex next = simplex;
    next.add(added);
    if (reduce_to_nearest(next)) {
      simplex = next;
      result.overlap = true;
      result.limit = false;
      break;
    }
    const Vec point = next.point();
    if (!(point.norm() < result.upper)) {
      result.limit = false;
      break;
    }
    simplex = next;
    nearest = point;
    result.upper = nearest.norm();
  }
  if (result.overlap) result.upper = 0;
  result.lower = std::clamp(result.lower, 0.0, result.upper);
  result.on_a = simplex.mix(&Vertex::a);
  result.on_b = simplex.mix(&Vertex::b);
  return result;
}

}  // namespace boxstream::ccd
