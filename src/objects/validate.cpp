// SPDX-License-Identifier: MIT
#include <cstddef>

#include "base/check.hpp"
#include "objects/impl.hpp"

namespace boxstream {

namespace detail {

template <class S>
void Roster<S>::validate() const {
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
template <class S>
void HeldPairs<S>::validate(const Roster& roster) const {
  if (!world_) {
    check(ids_.empty(), "held pairs: ids of no World");
    return;
  }
  world_->validate();
  if (!is_fresh(roster)) return;
  check(ids_.size() == roster.places(), "held pairs: fresh, and of another size");
  check(world_->size() == roster.size(), "held pairs: the World has some that are gone");
  for (Place place = 0; place < roster.places(); ++place) {
    const ProxyId id = ids_[place];
    if (roster.object(place) == nullptr) {
      check(!id, "held pairs: a gap has an id");
      continue;
    }
    check(world_->contains(id), "held pairs: an id that is stale");
    check(place_of_slot_[id.slot] == place, "held pairs: an id does not lead to its place");
    const auto box = world_->box(id);
    check(box == roster.box(place) || (!is_valid(box) && !is_valid(roster.box(place))),
          "held pairs: fresh, and has another box");
  }
}

template void Roster<float>::validate() const;
template void Roster<double>::validate() const;

}  // namespace detail

template <class S>
void BasicObjectSet<S>::validate() const {
  roster_.validate();
  if (impl_ == nullptr) return;
  impl_->index.validate(roster_, known_);
  impl_->pairs.validate(roster_);
  const std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known == 0) return;
  const auto row = static_cast<Place>(known >> 32), column = static_cast<Place>(known);
  detail::check(row < column && column < roster_.places(), "objects: a first pair of nothing");
  detail::check(is_valid(roster_.box(row)) && is_valid(roster_.box(column)) &&
                    overlaps(roster_.box(row), roster_.box(column)) &&
                    accepts(roster_.filter(row), roster_.filter(column)),
                "objects: a first pair that is none");
}

template void BasicObjectSet<float>::validate() const;
template void BasicObjectSet<double>::validate() const;

}  // namespace boxstream
