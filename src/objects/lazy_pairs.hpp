// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include <boxstream/detail/object_table.hpp>
#include <boxstream/world.hpp>

#include "objects/exclusive_section.hpp"

namespace boxstream::detail {

/// A World that holds all pairs of an object table. The first query that needs it makes it or brings it up to date, on
/// any thread. After that, until the table changes, it is read-only: queries read it without a lock, from callbacks
/// too.
///
/// Proxies are created in order of places.
template <class S>
class LazyPairs {
 public:
  using World = BasicWorld<S>;
  using ObjectTable = detail::ObjectTable<S>;
  using Place = typename ObjectTable::Place;

  explicit LazyPairs(WorldOptions options = {}) : options_(options) {}

  bool is_fresh(const ObjectTable& table) const { return seen_.load(std::memory_order_acquire) == table.last_change(); }

  /// Applies the changes of the table, then calls `finish(world)`. If that returns false, the World is dropped until
  /// the table changes. May throw; the next query tries again.
  ///
  /// Concurrent queries wait. With an Executor there is a timeout, after which they get false: an Executor may run such
  /// a query on a thread whose stack holds the refresh that the query would wait for.
  template <class Finish>
  bool refresh(const ObjectTable& table, Finish&& finish) const {
    if (is_fresh(table)) return true;
    const ExclusiveSection::Entry entry(section_, options_.executor != nullptr, timeout_per_box * table.places());
    if (entry) bring_up_to_date(table, finish);
    return bool(entry);
  }

  /// Both need `is_fresh`. Null if `finish` returned false.
  const World* world() const { return world_ ? &*world_ : nullptr; }
  Place place(ProxyId id) const { return place_of_slot_[id.slot]; }

  /// When places are about to change: the first change of the table that the World has not seen; 0 if there is none, or
  /// too old a one.
  std::uint64_t seen(const ObjectTable& table) const {
    const std::uint64_t seen = seen_.load(std::memory_order_relaxed);
    return !world_ || seen < table.first_change() ? 0 : seen;
  }
  /// Places change.
  void follow(const std::vector<Place>& to) noexcept {
    Place count = 0;
    for (Place from = 0; from < ids_.size(); ++from) {
      if (to[from] == ObjectTable::none) continue;
      if (ids_[from]) place_of_slot_[ids_[from].slot] = to[from];
      ids_[to[from]] = ids_[from];
      ++count;
    }
    ids_.resize(count);
  }

  void clear() noexcept { forget(); }

  void validate(const ObjectTable& table) const;

 private:
  // A search for all pairs takes 200 ns a box; more, because the other thread may wait for a processor.
  static constexpr std::chrono::nanoseconds timeout_per_box{1000};

  void forget() const noexcept {
    world_.reset();
    ids_.clear();
    place_of_slot_.clear();
    has_filters_ = false;
  }

  template <class Finish>
  void bring_up_to_date(const ObjectTable& table, Finish&& finish) const {
    if (is_fresh(table)) return;
    const bool is_new = !world_;
    if (is_new) world_.emplace(options_);
    apply_changes(table);
    if (!finish(*world_)) {
      forget();
    } else if (is_new) {  // all pairs have begun at once, and many sets are asked once or do not move
      world_->update();   // which forgets what began
      world_->shrink_to_fit();
    }
    seen_.store(table.last_change(), std::memory_order_release);
  }

  void apply_changes(const ObjectTable& table) const {
    const std::uint64_t seen = seen_.load(std::memory_order_relaxed);
    const auto known = static_cast<Place>(ids_.size());
    if (seen < table.first_change() || table.last_change() - seen > table.places() / 4) {
      world_->move(ids_, {table.boxes().data(), known});
      for (Place place = 0; place < known; ++place)
        if (table.object(place) == nullptr) destroy(place);
      set_filters(table, known);
    } else {
      if (!has_filters_) set_filters(table, known);
      for (std::uint64_t i = seen; i != table.last_change(); ++i) {
        const Place place = table.change(i);
        if (place >= known) continue;  // new, or no more
        if (table.object(place) == nullptr) {
          destroy(place);
        } else {
          world_->move(ids_[place], table.box(place));
          if (has_filters_) world_->set_filter(ids_[place], table.filter(place));
        }
      }
    }
    insert_new(table, known);
  }

  /// While all filters are the default one, none are set: that costs the World nothing.
  void set_filters(const ObjectTable& table, Place known) const {
    has_filters_ = !table.special_filters().empty();
    if (!has_filters_) return;
    for (Place place = 0; place < known; ++place) world_->set_filter(ids_[place], table.filter(place));
  }

  void destroy(Place place) const {
    if (ids_[place]) world_->destroy(ids_[place]);
    ids_[place] = {};
  }

  /// Creates proxies for places from `known` on. Objects that were removed before leave a gap here too.
  void insert_new(const ObjectTable& table, Place known) const {
    const std::size_t count = table.places() - known;
    if (count == 0) return;
    // Slots are used again, so there are never more of them than places were created.
    if (const std::size_t slots = place_of_slot_.size() + count; slots > place_of_slot_.capacity())
      place_of_slot_.reserve(2 * slots);
    ids_.resize(known + count);
    const Span<const Filter> filters =
        has_filters_ ? table.special_filters().subspan(known, count) : Span<const Filter>();
    try {
      world_->create({table.boxes().data() + known, count}, filters, {ids_.data() + known, count});
    } catch (...) {
      ids_.resize(known);
      throw;
    }
    for (Place place = known; place < table.places(); ++place) {
      const ProxyId id = ids_[place];
      if (id.slot >= place_of_slot_.size()) place_of_slot_.resize(id.slot + 1);
      place_of_slot_[id.slot] = place;
      if (table.object(place) == nullptr) destroy(place);
    }
  }

  WorldOptions options_;
  mutable ExclusiveSection section_;
  mutable std::atomic<std::uint64_t> seen_{0};  // change of the table that it is up to date with; 0: none
  mutable std::optional<World> world_;
  mutable std::vector<ProxyId> ids_;  // by place, null at a gap
  mutable std::vector<Place> place_of_slot_;
  mutable bool has_filters_ = false;
};

}  // namespace boxstream::detail
