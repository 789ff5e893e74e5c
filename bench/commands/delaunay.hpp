// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <boxstream/near.hpp>

namespace boxstream::bench {

/// Fixed-radius near neighbours in the plane by way of a Delaunay triangulation, CGAL's with exact predicates: the
/// points within a distance of one of them are connected in it, so that a walk from each point finds its neighbours.
/// That is what Dickerson and Eppstein start from, and what "Reporting intersections among thick objects" compares
/// itself with.
class Delaunay {
 public:
  struct Times {
    double triangulation_ms, all_ms;
  };

  /// Pairs of points at most `distance` apart, each once, the smaller index in `a`; what `pairs` held is gone. Radii
  /// and z are ignored. Throws std::runtime_error if two points are the same, which the triangulation has once.
  static Times find_pairs(Span<const Ball> points, float distance, std::vector<Pair>& pairs);
};

}  // namespace boxstream::bench
