// SPDX-License-Identifier: MIT
// CollisionManager: pairs by the distance of their boxes, near ones first. The limit of every query is what the
// callbacks were last left in `dist`, whatever that is.
#pragma once

#include <limits>

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

template <class S>
void CollisionManager<S>::distance_to(Object* object, Filter filter, void* cdata, DistanceCallBack callback) const {
  if (empty()) return;
  if (warns_) warn();
  const auto& roster = set_.roster();
  S dist = std::numeric_limits<S>::max();
  set_.fresh_index().query_nearest_box(read(*object), dist, [&](ProxyId id, S) {
    const Place place = set_.place_in_index(id);
    Object* const managed = roster.object(place);
    if (!accepts(filter, roster.filter(place)) || !passes(managed, object)) return dist;
    return callback(managed, object, cdata, dist) ? S(-1) : dist;
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
  if (size() < 2) return;
  if (warns_) warn();
  S dist = std::numeric_limits<S>::max();
  set_.fresh_index().nearest_pairs(dist, [&](ProxyPair pair, S) {
    Object* const first = set_.roster().object(set_.place_in_index(pair.a));
    Object* const second = set_.roster().object(set_.place_in_index(pair.b));
    if (!passes(first, second)) return dist;
    return callback(first, second, cdata, dist) ? S(-1) : dist;
  });
}

template <class S>
void CollisionManager<S>::distance(Base* other, void* cdata, DistanceCallBack callback) const {
  if (other == this) return distance(cdata, callback);
  if (empty()) return;
  if (warns_) warn();
  with_set_of(other, [&](const Set& others) {
    if (others.roster().size() == 0) return;
    S dist = std::numeric_limits<S>::max();
    set_.fresh_index().nearest_pairs(others.fresh_index(), dist, [&](ProxyPair pair, S) {
      Object* const mine = set_.roster().object(set_.place_in_index(pair.a));
      Object* const theirs = others.roster().object(others.place_in_index(pair.b));
      if (!passes(mine, theirs)) return dist;
      return callback(mine, theirs, cdata, dist) ? S(-1) : dist;
    });
  });
}

}  // namespace boxstream::fcl
