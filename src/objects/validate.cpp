// SPDX-License-Identifier: MIT
#include <cstddef>

#include "base/check.hpp"
#include "objects/impl.hpp"

namespace boxstream {

namespace detail {

template <class S>
void ObjectTable<S>::validate() const {
  const std::size_t n = objects_.size();
  check(boxes_.size() == n && filters_.size() == n && is_static_.size() == n, "table: arrays of different length");
  std::size_t registered = 0;
  for (Place place = 0; place < n; ++place) {
    if (objects_[place] == nullptr) {
      check(!is_valid(boxes_[place]), "table: a gap has a box");
      continue;
    }
    ++registered;
    check(find(objects_[place]) == place, "table: an object does not lead to its place");
    check(has_filters_ || is_plain(filters_[place]), "table: a special filter is not known of");
  }
  check(registered == size(), "table: an object that has no place");
  for (const Place place : changes_) check(place < n || place == none, "table: a change of nothing");
}

/// If it is not fresh, checks its World only.
template <class S>
void LazyPairs<S>::validate(const ObjectTable& table) const {
  if (!world_) {
    check(ids_.empty(), "held pairs: ids of no World");
    return;
  }
  world_->validate();
  if (!is_fresh(table)) return;
  check(ids_.size() == table.places(), "held pairs: fresh, and of another size");
  check(world_->size() == table.size(), "held pairs: the World has some that are gone");
  for (Place place = 0; place < table.places(); ++place) {
    const ProxyId id = ids_[place];
    if (table.object(place) == nullptr) {
      check(!id, "held pairs: a gap has an id");
      continue;
    }
    check(world_->contains(id), "held pairs: an id that is stale");
    check(place_of_slot_[id.slot] == place, "held pairs: an id does not lead to its place");
    const auto box = world_->box(id);
    check(box == table.box(place) || (!is_valid(box) && !is_valid(table.box(place))),
          "held pairs: fresh, and has another box");
  }
}

template void ObjectTable<float>::validate() const;
template void ObjectTable<double>::validate() const;

}  // namespace detail

template <class S>
void BasicObjectSet<S>::validate() const {
  table_.validate();
  detail::check(table_.size() > detail::most_of_few || table_.gaps() == 0, "objects: gaps among few");
  if (const Impl* const made = impl_.made()) {
    made->index.validate(table_, known_);
    made->pairs.validate(table_);
  }
  const std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known == 0) return;
  const auto row = static_cast<Place>(known >> 32), column = static_cast<Place>(known);
  detail::check(row < column && column < table_.places(), "objects: a first pair of nothing");
  detail::check(is_valid(table_.box(row)) && is_valid(table_.box(column)) &&
                    overlaps(table_.box(row), table_.box(column)) && accepts(table_.filter(row), table_.filter(column)),
                "objects: a first pair that is none");
}

template void BasicObjectSet<float>::validate() const;
template void BasicObjectSet<double>::validate() const;

}  // namespace boxstream
