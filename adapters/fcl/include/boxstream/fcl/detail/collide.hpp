// SPDX-License-Identifier: MIT
// CollisionManager: which boxes touch.
#pragma once

#include <boxstream/fcl.hpp>
#include <boxstream/fcl/detail/cross_pairs.hpp>

namespace boxstream::fcl {

template <class S>
Filter CollisionManager<S>::filter_of_query(const Object* object) const {
  const auto& roster = set_.roster();
  if (roster.special_filters().empty()) return Filter{};
  const Place place = roster.find(object);
  if (place == Set::Roster::none) return Filter{};
  return detail::as_moving(roster.filter(place), roster.is_static(place));
}

template <class S>
void CollisionManager<S>::collide_with(Object* object, Filter filter, void* cdata, CollisionCallBack callback) const {
  if (empty()) return;
  if (warns_) warn();
  set_.for_each_overlap(read(*object), filter, [&](Place place) {
    Object* const managed = set_.roster().object(place);
    return !passes(managed, object) || !callback(managed, object, cdata);
  });
}

template <class S>
void CollisionManager<S>::collide(Object* object, void* cdata, CollisionCallBack callback) const {
  collide_with(object, filter_of_query(object), cdata, callback);
}

template <class S>
void CollisionManager<S>::collide(Object* object, Groups groups, void* cdata, CollisionCallBack callback) const {
  collide_with(object, detail::filter_of(groups, false), cdata, callback);
}

template <class S>
void CollisionManager<S>::collide(void* cdata, CollisionCallBack callback) const {
  if (warns_) warn();
  const auto& roster = set_.roster();
  set_.for_each_pair([&](Place a, Place b) {
    Object* const first = roster.object(a);
    Object* const second = roster.object(b);
    return !passes(first, second) || !callback(first, second, cdata);
  });
}

/// Calls `use(set)` with the boxes of another manager. Those of a foreign type have no say in how they keep theirs, so
/// their objects are asked.
template <class S>
template <class Use>
void CollisionManager<S>::with_set_of(Base* other, Use&& use) const {
  std::vector<Object*> objects;
  if (const CollisionManager* const same = as_same_type(*other, objects)) {
    use(same->set_);
    return;
  }
  Set set(nullptr);
  set.reserve(objects.size());
  for (Object* const object : objects)
    if (set.roster().find(object) == Set::Roster::none) set.add(object, read(*object), Filter{}, false);
  use(set);
}

template <class S>
void CollisionManager<S>::collide(Base* other, void* cdata, CollisionCallBack callback) const {
  if (other == this) return collide(cdata, callback);
  if (empty()) return;
  if (warns_) warn();
  with_set_of(other, [&](const Set& others) {
    detail::for_each_cross_pair(set_, others, [&](Place a, Place b) {
      Object* const mine = set_.roster().object(a);
      Object* const theirs = others.roster().object(b);
      return !passes(mine, theirs) || !callback(mine, theirs, cdata);
    });
  });
}

}  // namespace boxstream::fcl
