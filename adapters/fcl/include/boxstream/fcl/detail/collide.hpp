// SPDX-License-Identifier: MIT
// CollisionManager: which boxes touch.
#pragma once

#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

template <class S>
Filter CollisionManager<S>::filter_of_query(const Object* object) const {
  const auto& table = set_.table();
  if (table.special_filters().empty()) return Filter{};
  const Place place = table.find(object);
  if (place == Set::none) return Filter{};
  return detail::as_moving(table.filter(place), table.is_static(place));
}

template <class S>
void CollisionManager<S>::collide_with(Object* object, Filter filter, void* cdata, CollisionCallBack callback) const {
  if (set_.table().size() == 0) return;
  if (warns_) warn();
  if (reads_aabb_ && set_.is_clear(detail::copy_of(object->getAABB()))) return;
  set_.for_each_overlap(read(*object), filter, order_, [&](Place place) {
    Object* const mine = managed(place);
    return !passes(mine, object) || !callback(mine, object, cdata);
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
  set_.for_each_pair([&](Place a, Place b) {
    Object* const first = managed(a);
    Object* const second = managed(b);
    return !passes(first, second) || !callback(first, second, cdata);
  });
}

/// Calls `use(set)` with the boxes of another manager. For a manager of a foreign type they are read from its objects.
template <class S>
template <class Use>
void CollisionManager<S>::with_set_of(Base* other, Use&& use) const {
  if (const CollisionManager* const same = as_same_type(*other)) {
    use(same->set_);
    return;
  }
  std::vector<Object*> objects;
  other->getObjects(objects);
  Set set;
  set.reserve(objects.size());
  for (Object* const object : objects)
    if (set.table().find(object) == Set::none) set.add(object, read(*object), Filter{}, false);
  use(set);
}

template <class S>
void CollisionManager<S>::collide(Base* other, void* cdata, CollisionCallBack callback) const {
  if (other == this) return collide(cdata, callback);
  if (set_.table().size() == 0) return;
  if (warns_) warn();
  with_set_of(other, [&](const Set& others) {
    set_.for_each_pair(others, order_, [&](Place a, Place b) {
      Object* const mine = managed(a);
      Object* const theirs = object_at(others, b);
      return !passes(mine, theirs) || !callback(mine, theirs, cdata);
    });
  });
}

}  // namespace boxstream::fcl
