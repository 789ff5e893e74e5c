// SPDX-License-Identifier: MIT
// CollisionManager: which boxes a segment meets.
#pragma once

#include <algorithm>
#include <vector>

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
  const S direction[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  set_.fresh_index().query_ray(BasicRay<S>::along(origin, direction, S(1)), [&](ProxyId id, S enter, S length) {
    hits.push_back({enter, set_.place_in_index(id)});
    return length;
  });
  std::sort(hits.begin(), hits.end(),
            [](const Hit& x, const Hit& y) { return x.enter != y.enter ? x.enter < y.enter : x.place < y.place; });
  for (const Hit& hit : hits)
    if (visit(set_.roster().object(hit.place), hit.enter)) return;
}

}  // namespace boxstream::fcl
