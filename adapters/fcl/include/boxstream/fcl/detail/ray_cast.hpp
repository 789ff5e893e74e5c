// SPDX-License-Identifier: MIT
// CollisionManager: which boxes a segment meets.
#pragma once

#include <algorithm>
#include <vector>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/fcl.hpp>
#include <boxstream/ray.hpp>

namespace boxstream::fcl {

template <class S>
void CollisionManager<S>::rayCast(const ::fcl::Vector3<S>& from, const ::fcl::Vector3<S>& to, RayVisitor visit) const {
  if (empty()) return;
  if (warns_) warn();
  struct Hit {
    S enter;
    Place place;
  };
  std::vector<Hit> hits;
  const S origin[3] = {from[0], from[1], from[2]};
  S direction[3], length = 1;
  {
    const boxstream::detail::DefaultFloatEnvironment environment;
    for (int d = 0; d < 3; ++d) direction[d] = to[d] - from[d];
    const auto is_infinite = [](S x) { return x == x && x - x != 0; };
    if (is_infinite(direction[0]) || is_infinite(direction[1]) || is_infinite(direction[2])) {
      // The way from one end of the range to the other is no number, but half of it is.
      for (int d = 0; d < 3; ++d) direction[d] = to[d] / 2 - from[d] / 2;
      length = 2;
    }
  }
  set_.for_each_hit(BasicRay<S>::along(origin, direction, length), [&](Place place, S enter, S rest) {
    hits.push_back({enter / length, place});
    return rest;
  });
  std::sort(hits.begin(), hits.end(),
            [](const Hit& x, const Hit& y) { return x.enter != y.enter ? x.enter < y.enter : x.place < y.place; });
  for (const Hit& hit : hits)
    if (visit(managed(hit.place), hit.enter)) return;
}

}  // namespace boxstream::fcl
