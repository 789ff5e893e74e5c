// SPDX-License-Identifier: MIT
// CollisionManager: what must hold between any two calls. For tests.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include <boxstream/fcl.hpp>

namespace boxstream::fcl::detail {

inline void check(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

template <class Object, class S>
void Roster<Object, S>::validate() const {
  const std::size_t n = objects_.size();
  check(boxes_.size() == n && filters_.size() == n && is_static_.size() == n, "roster: arrays of different length");
  std::size_t registered = 0;
  for (Place place = 0; place < n; ++place) {
    if (objects_[place] == nullptr) {
      check(!is_valid(boxes_[place]), "roster: a gap has a box");
      continue;
    }
    ++registered;
    check(find(objects_[place]) == place, "roster: an object does not lead to its place");
    check(has_filters_ || is_plain(filters_[place]), "roster: a special filter is not known of");
  }
  check(registered == size(), "roster: an object that has no place");
  for (const Place place : changes_) check(place < n, "roster: a change of nothing");
}

/// Of a view that is not fresh only what its World says of itself.
template <class Object, class S>
void View<Object, S>::validate(const Roster& roster) const {
  if (!world_) {
    check(ids_.empty(), "view: ids of no world");
    return;
  }
  world_->validate();
  if (!is_fresh(roster)) return;
  check(ids_.size() == roster.places(), "view: fresh, and of another size");
  check(world_->size() == roster.size(), "view: the World has some that are gone");
  for (Place place = 0; place < roster.places(); ++place) {
    const ProxyId id = ids_[place];
    if (roster.object(place) == nullptr) {
      check(!id, "view: a gap has an id");
      continue;
    }
    check(world_->contains(id), "view: an id that is stale");
    check(place_of_slot_[id.slot] == place, "view: an id does not lead to its place");
    const auto box = world_->box(id);
    check(box == roster.box(place) || (!is_valid(box) && !is_valid(roster.box(place))),
          "view: fresh, and has another box");
  }
}

template <class Object, class S>
void BoxSet<Object, S>::validate() const {
  roster_.validate();
  index_.validate(roster_);
  pairs_.validate(roster_);
  const std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known == 0) return;
  const auto row = static_cast<Place>(known >> 32), column = static_cast<Place>(known);
  check(row < column && column < roster_.places(), "set: a first pair of nothing");
  check(is_valid(roster_.box(row)) && is_valid(roster_.box(column)) && touch(roster_.box(row), roster_.box(column)) &&
            accepts(roster_.filter(row), roster_.filter(column)),
        "set: a first pair that is none");
}

}  // namespace boxstream::fcl::detail

namespace boxstream::fcl {

template <class S>
void CollisionManager<S>::validate() const {
  set_.validate();
}

}  // namespace boxstream::fcl
