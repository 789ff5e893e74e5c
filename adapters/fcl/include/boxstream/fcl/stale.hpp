// SPDX-License-Identifier: MIT
// CollisionManager: boxes that somebody forgot to bring up to date.
#pragma once

#include <cstdio>

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

template <class S>
std::size_t CollisionManager<S>::findStale(FunctionRef<void(const Object*, Stale)> visit) const {
  std::size_t count = 0;
  const auto& roster = set_.roster();
  for (Place place = 0; place < roster.places(); ++place) {
    const Object* const object = roster.object(place);
    if (object == nullptr) continue;
    // Users may make boxes larger than computeAABB() does, so only a box that is too small is wrong.
    Object computed = *object;
    computed.computeAABB();
    const Box is = detail::box_of(object->getAABB(), S(0));
    const Box ought = detail::box_of(computed.getAABB(), S(0));
    const bool contains = !is_valid(ought) || (is_valid(is) && merged(is, ought) == is);
    if (contains && read(*object) == roster.box(place)) continue;
    visit(object, contains ? Stale::not_updated : Stale::not_computed);
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
