// SPDX-License-Identifier: MIT
// CollisionManager: pairs by the distance of their boxes, near ones first. The limit of a query is the last
// value of `dist` after a callback.
#pragma once

#include <limits>

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

template <class S>
void CollisionManager<S>::distance_to(Object* object, Filter filter, void* cdata, DistanceCallBack callback) const {
  if (set_.table().size() == 0) return;
  if (warns_) warn();
  S dist = std::numeric_limits<S>::max();
  set_.for_each_near(read(*object), filter, dist, [&](Place place) {
    Object* const mine = managed(place);
    if (!passes(mine, object)) return dist;
    return callback(mine, object, cdata, dist) ? S(-1) : dist;
  });
}

template <class S>
void CollisionManager<S>::distance(Object* object, void* cdata, DistanceCallBack callback) const {
  distance_to(object, filter_of_query(object), cdata, callback);
}

template <class S>
void CollisionManager<S>::distance(Object* object, Groups groups, void* cdata, DistanceCallBack callback) const {
  distance_to(object, detail::filter_of(groups, false), cdata, callback);
}

template <class S>
void CollisionManager<S>::distance(void* cdata, DistanceCallBack callback) const {
  if (set_.table().size() < 2) return;
  if (warns_) warn();
  S dist = std::numeric_limits<S>::max();
  set_.for_each_near_pair(dist, [&](Place a, Place b) {
    Object* const first = managed(a);
    Object* const second = managed(b);
    if (!passes(first, second)) return dist;
    return callback(first, second, cdata, dist) ? S(-1) : dist;
  });
}

template <class S>
void CollisionManager<S>::distance(Base* other, void* cdata, DistanceCallBack callback) const {
  if (other == this) return distance(cdata, callback);
  if (set_.table().size() == 0) return;
  if (warns_) warn();
  with_set_of(other, [&](const Set& others) {
    S dist = std::numeric_limits<S>::max();
    set_.for_each_near_pair(others, dist, [&](Place a, Place b) {
      Object* const mine = managed(a);
      Object* const theirs = object_at(others, b);
      if (!passes(mine, theirs)) return dist;
      return callback(mine, theirs, cdata, dist) ? S(-1) : dist;
    });
  });
}

}  // namespace boxstream::fcl
