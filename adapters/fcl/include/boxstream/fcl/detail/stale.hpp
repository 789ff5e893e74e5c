// SPDX-License-Identifier: MIT
// CollisionManager: boxes that were not brought up to date.
#pragma once

#include <cstdio>

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

/// Users may make boxes larger than computeAABB() does, so only one that is too small is wrong.
template <class S>
bool CollisionManager<S>::is_computed(const Object& object) {
  Object copy = object;
  copy.computeAABB();
  const Box is = detail::box_of(object.getAABB());
  const Box ought = detail::box_of(copy.getAABB());
  return !is_valid(ought) || (is_valid(is) && merged(is, ought) == is);
}

template <class S>
std::size_t CollisionManager<S>::findStale(FunctionRef<void(const Object*, Stale)> visit) const {
  std::size_t count = 0;
  const auto& table = set_.table();
  for (Place place = 0; place < table.places(); ++place) {
    const Object* const object = managed(place);
    if (object == nullptr) continue;
    const bool computed = source_ != nullptr || is_computed(*object);
    const Box now = read(*object);
    const Box& then = table.box(place);
    if (computed && (now == then || (!is_valid(now) && !is_valid(then)))) continue;
    visit(object, computed ? Stale::not_updated : Stale::not_computed);
    ++count;
  }
  return count;
}

template <class S>
void CollisionManager<S>::warn() const {
  std::size_t not_computed = 0;
  const std::size_t count =
      findStale([&](const Object*, Stale stale) { not_computed += stale == Stale::not_computed; });
  if (count == 0) return;
  std::fprintf(stderr,
               "boxstream::fcl: %zu of %zu boxes are stale: %zu wait for computeAABB(), %zu for the manager's update\n",
               count, size(), not_computed, count - not_computed);
}

}  // namespace boxstream::fcl
