// SPDX-License-Identifier: MIT
// CollisionManager: managed objects, and when boxes are read.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

template <class S>
void CollisionManager<S>::swap(CollisionManager& other) noexcept {
  using std::swap;
  swap(max_tree_nonbalanced_level, other.max_tree_nonbalanced_level);
  swap(tree_incremental_balance_pass, other.tree_incremental_balance_pass);
  swap(tree_topdown_balance_threshold, other.tree_topdown_balance_threshold);
  swap(tree_topdown_level, other.tree_topdown_level);
  swap(tree_init_level, other.tree_init_level);
  swap(octree_as_geometry_collide, other.octree_as_geometry_collide);
  swap(octree_as_geometry_distance, other.octree_as_geometry_distance);
  static_assert(std::is_nothrow_swappable_v<Set>);
  swap(set_, other.set_);
  swap(filter_, other.filter_);
  swap(source_, other.source_);
  swap(reach_, other.reach_);
  swap(reads_aabb_, other.reads_aabb_);
  swap(all_outdated_, other.all_outdated_);
  swap(warns_, other.warns_);
  swap(order_, other.order_);
}

template <class S>
CollisionManager<S>& CollisionManager<S>::operator=(CollisionManager&& other) noexcept {
  CollisionManager taken(std::move(other));
  swap(taken);
  return *this;
}

template <class S>
BasicAabb<S> CollisionManager<S>::read_otherwise(const Object& object) const {
  return detail::grown(detail::box_of(source_ != nullptr ? source_(object) : object.getAABB()), reach_);
}

template <class S>
void CollisionManager<S>::put(Object* object, bool is_static) {
  const Place place = set_.table().find(object);
  if (place == Set::none)
    set_.add(object, read(*object), detail::filter_of({}, is_static), is_static);
  else
    set_.set_box(place, read(*object));
}

template <class S>
void CollisionManager<S>::registerObject(Object* object) {
  put(object, false);
}

template <class S>
void CollisionManager<S>::registerObjects(const std::vector<Object*>& objects) {
  set_.reserve(objects.size());
  for (Object* const object : objects) put(object, false);
}

template <class S>
void CollisionManager<S>::registerStaticObjects(const std::vector<Object*>& objects) {
  set_.reserve(objects.size());
  for (Object* const object : objects) {
    put(object, true);
    setStatic(object);
  }
}

template <class S>
void CollisionManager<S>::unregisterObject(Object* object) {
  const Place place = set_.table().find(object);
  if (place != Set::none) set_.remove(place);
}

template <class S>
void CollisionManager<S>::update() {
  const auto& table = set_.table();
  for (Place place = 0; place < table.places(); ++place) {
    const Object* const object = managed(place);
    if (object != nullptr && (all_outdated_ || !table.is_static(place))) set_.set_box(place, read(*object));
  }
  all_outdated_ = false;
}

template <class S>
void CollisionManager<S>::update(Object* object) {
  const Place place = set_.table().find(object);
  if (place != Set::none) set_.set_box(place, read(*object));
}

template <class S>
void CollisionManager<S>::update(const std::vector<Object*>& objects) {
  for (Object* const object : objects) update(object);
}

template <class S>
void CollisionManager<S>::clear() {
  set_.clear();
  all_outdated_ = false;
}

template <class S>
void CollisionManager<S>::setMargin(S margin) {
  const boxstream::detail::DefaultFloatEnvironment environment;
  const S reach = margin > 0 ? std::min(margin / 2, std::numeric_limits<S>::max()) : S(0);
  all_outdated_ |= reach != reach_ && !empty();
  reach_ = reach;
  reads_aabb_ = source_ == nullptr && reach == 0;
}

template <class S>
void CollisionManager<S>::setBoxSource(BoxSource source) {
  all_outdated_ |= source != source_ && !empty();
  source_ = source;
  const boxstream::detail::DefaultFloatEnvironment environment;
  reads_aabb_ = source == nullptr && reach_ == 0;
}

template <class S>
void CollisionManager<S>::getObjects(std::vector<Object*>& objects) const {
  const auto& table = set_.table();
  objects.clear();
  objects.reserve(table.size());
  for (Place place = 0; place < table.places(); ++place)
    if (Object* const object = managed(place)) objects.push_back(object);
}

template <class S>
bool CollisionManager<S>::setGroups(Object* object, Groups groups) {
  const Place place = set_.table().find(object);
  if (place == Set::none) return false;
  const bool is_static = set_.table().is_static(place);
  set_.set_filter(place, detail::filter_of(groups, is_static), is_static);
  return true;
}

template <class S>
bool CollisionManager<S>::setStatic(Object* object, bool is_static) {
  const Place place = set_.table().find(object);
  if (place == Set::none) return false;
  const Groups groups = detail::groups_of(set_.table().filter(place), set_.table().is_static(place));
  set_.set_filter(place, detail::filter_of(groups, is_static), is_static);
  return true;
}

}  // namespace boxstream::fcl
