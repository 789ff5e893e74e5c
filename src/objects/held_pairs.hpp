// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include <boxstream/detail/roster.hpp>
#include <boxstream/world.hpp>

#include "objects/turns.hpp"

namespace boxstream::detail {

/// A World that follows a roster and holds all its pairs. It is made and brought up to date by the first query that
/// needs it, whichever thread that comes from. From then on until the roster changes nothing in it is written, so it
/// may be read without a lock, from inside callbacks too.
///
/// The order of creation in the World is that of places.
template <class S>
class HeldPairs {
 public:
  using World = BasicWorld<S>;
  using Roster = detail::Roster<S>;
  using Place = typename Roster::Place;

  explicit HeldPairs(WorldOptions options = {}) : options_(options) {}

  bool is_fresh(const Roster& roster) const { return seen_.load(std::memory_order_acquire) == roster.last_change(); }

  /// Makes it fresh. `finish(world)` does what else it takes, and returns false if the World is of no use now: it
  /// is dropped then, until the roster changes. May throw, and is then tried anew by the next query.
  ///
  /// Queries that come meanwhile wait for it. But an Executor may do other jobs on any thread before it goes on, such
  /// queries among them, and they could wait for what lies below them on their stack. So where there is one they wait
  /// for a while at the most, and then get false: they have to do without.
  template <class Finish>
  bool refresh(const Roster& roster, Finish&& finish) const {
    if (is_fresh(roster)) return true;
    const Turns::Turn turn(turns_, options_.executor == nullptr, patience_for_each_box * roster.places());
    if (turn) catch_up(roster, finish);
    return bool(turn);
  }

  /// The next two need a fresh one. The first is null if the World was of no use.
  const World* world() const { return world_ ? &*world_ : nullptr; }
  Place place(ProxyId id) const { return place_of_slot_[id.slot]; }

  /// Before places change, too.
  void clear() noexcept { forget(); }

  void validate(const Roster& roster) const;

 private:
  // To find all pairs oneself takes 200 ns a box; more, as the other one may have to wait for a processor.
  static constexpr std::chrono::nanoseconds patience_for_each_box{1000};

  void forget() const noexcept {
    world_.reset();
    ids_.clear();
    place_of_slot_.clear();
    has_filters_ = false;
  }

  template <class Finish>
  void catch_up(const Roster& roster, Finish&& finish) const {
    if (is_fresh(roster)) return;
    if (!world_) world_.emplace(options_);
    take_in(roster);
    if (!finish(*world_)) forget();
    seen_.store(roster.last_change(), std::memory_order_release);
  }

  void take_in(const Roster& roster) const {
    const std::uint64_t seen = seen_.load(std::memory_order_relaxed);
    const auto known = static_cast<Place>(ids_.size());
    if (seen < roster.first_change() || roster.last_change() - seen > roster.places() / 4) {
      world_->move(ids_, {roster.boxes().data(), known});
      for (Place place = 0; place < known; ++place)
        if (roster.object(place) == nullptr) destroy(place);
      set_filters(roster, known);
    } else {
      if (!has_filters_) set_filters(roster, known);
      for (std::uint64_t i = seen; i != roster.last_change(); ++i) {
        const Place place = roster.change(i);
        if (place >= known) continue;
        if (roster.object(place) == nullptr) {
          destroy(place);
        } else {
          world_->move(ids_[place], roster.box(place));
          if (has_filters_) world_->set_filter(ids_[place], roster.filter(place));
        }
      }
    }
    add_newcomers(roster, known);
  }

  /// While all filters are plain the World has its own defaults, which cost it nothing.
  void set_filters(const Roster& roster, Place known) const {
    has_filters_ = !roster.special_filters().empty();
    if (!has_filters_) return;
    for (Place place = 0; place < known; ++place) world_->set_filter(ids_[place], roster.filter(place));
  }

  void destroy(Place place) const {
    if (ids_[place]) world_->destroy(ids_[place]);
    ids_[place] = {};
  }

  /// Those that went before anybody heard of them leave a gap here too.
  void add_newcomers(const Roster& roster, Place known) const {
    const std::size_t count = roster.places() - known;
    if (count == 0) return;
    // Slots are used again, so there are never more of them than places were created.
    if (const std::size_t slots = place_of_slot_.size() + count; slots > place_of_slot_.capacity())
      place_of_slot_.reserve(2 * slots);
    ids_.resize(known + count);
    const Span<const Filter> filters =
        has_filters_ ? roster.special_filters().subspan(known, count) : Span<const Filter>();
    try {
      world_->create({roster.boxes().data() + known, count}, filters, {ids_.data() + known, count});
    } catch (...) {
      ids_.resize(known);
      throw;
    }
    for (Place place = known; place < roster.places(); ++place) {
      const ProxyId id = ids_[place];
      if (id.slot >= place_of_slot_.size()) place_of_slot_.resize(id.slot + 1);
      place_of_slot_[id.slot] = place;
      if (roster.object(place) == nullptr) destroy(place);
    }
  }

  WorldOptions options_;
  mutable Turns turns_;
  mutable std::atomic<std::uint64_t> seen_{0};  // changes of the roster, 0: none ever
  mutable std::optional<World> world_;
  mutable std::vector<ProxyId> ids_;  // by place, null at a gap
  mutable std::vector<Place> place_of_slot_;
  mutable bool has_filters_ = false;
};

}  // namespace boxstream::detail
