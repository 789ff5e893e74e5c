// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <boxstream/executor.hpp>
#include <boxstream/fcl/detail/movable.hpp>
#include <boxstream/fcl/detail/places.hpp>
#include <boxstream/fcl/detail/roster.hpp>
#include <boxstream/fcl/detail/view.hpp>
#include <boxstream/world.hpp>

namespace boxstream::fcl::detail {

/// The boxes of one manager, and which of them touch: a roster and two Worlds that follow it, one for queries by a box,
/// one that holds all pairs from update to update. A World that no query needs is never made.
///
/// Whatever way is taken to find them, places and pairs come in order: what a caller sees is a function of the boxes
/// and the order of registration. Visitors return false to stop, may query the set, and may throw.
///
/// Const members may run at the same time; everything else needs the set to itself.
template <class Object, class S>
class BoxSet {
 public:
  using Box = BasicAabb<S>;
  using World = BasicWorld<S>;
  using Roster = detail::Roster<Object, S>;

  explicit BoxSet(Executor* executor) : pairs_(WorldOptions{executor}) {}

  const Roster& roster() const { return roster_; }
  void reserve(std::size_t more) { roster_.reserve(more); }
  void add(Object* object, const Box& box, Filter filter, bool is_static) {
    roster_.reserve(1);
    roster_.add(object, box, filter, is_static);
    forget_first_pair();
  }
  void set_box(Place place, const Box& box) {
    if (roster_.set_box(place, box)) forget_first_pair();
  }
  void set_filter(Place place, Filter filter, bool is_static) {
    roster_.set_filter(place, filter, is_static);
    forget_first_pair();
  }

  void remove(Place place) noexcept {
    roster_.remove(place);
    forget_first_pair();
    if (roster_.gaps() <= 32 + roster_.size()) return;
    index_.drop_gaps(roster_);
    pairs_.drop_gaps(roster_);
    roster_.compact();
  }

  void clear() noexcept {
    index_.clear();
    pairs_.clear();
    roster_.clear();
    forget_first_pair();
  }

  /// Calls `visit(place)` for each box that touches `box` and whose filter goes with `filter`, in order.
  template <class Visit>
  void for_each_overlap(const Box& box, Filter filter, Visit&& visit) const;

  /// The same as they are found: for callers that put them in order themselves.
  template <class Visit>
  void for_each_overlap_in_any_order(const Box& box, Filter filter, Visit&& visit) const;

  /// Calls `visit(place, place)` for each pair that touches, ordered by the first, then the second.
  template <class Visit>
  void for_each_pair(Visit&& visit) const;

  /// The index for all other queries, or null if a look at each box is cheaper.
  const World* index() const {
    if (roster_.size() <= few || scanning_is_cheaper()) return nullptr;
    return &fresh_index();
  }
  const World& fresh_index() const {
    index_.refresh(roster_, [this](World&) {
      scanned_.store(0, std::memory_order_relaxed);
      return true;
    });
    return *index_.world();
  }
  Place place_in_index(ProxyId id) const { return index_.place(id); }

  void validate() const;

  /// Boxes that are faster looked at one by one than put into an index: 64 take as long as one query of it.
  static constexpr std::size_t few = 64;

 private:
  // Finding all pairs takes as long as looking at 20 to 50 rows. All rows of 90 boxes are faster looked at.
  static constexpr std::uint64_t rows_at_first = 4;
  static constexpr std::uint64_t rows_for_the_hasty = 16;
  static constexpr std::uint64_t rows_for_the_thorough = 1;
  static constexpr std::uint64_t looks_at_all = 4096;
  static constexpr Place small_set = 16384;

  void forget_first_pair() { first_pair_.store(0, std::memory_order_relaxed); }
  /// Looks at the boxes from `first` on.
  template <class Visit>
  bool scan(Place first, const Box& box, Filter filter, Visit&& visit) const;
  template <class Visit>
  Place scan_rows(Visit&& visit, bool& going_on) const;
  template <class Visit>
  void visit_rows(Place first, Visit&& visit) const;
  bool find_pairs(const View<Object, S>& view) const;
  template <class Visit>
  void visit_pairs(const View<Object, S>& view, Place first, Visit&& visit) const;
  bool scanning_is_cheaper() const;

  Roster roster_;
  View<Object, S> index_;
  View<Object, S> pairs_;
  mutable MovableAtomic<std::uint64_t> scanned_{0};
  mutable MovableAtomic<std::uint64_t> rows_to_try_{rows_at_first};
  mutable MovableAtomic<std::uint64_t> first_pair_{0};  // row and column in the upper and lower half; 0: not known
};

/// A look at a box costs 1 to 2 ns; to take a change into the index 10 to 30, to build it 100 to 200 a box. Looks are
/// counted until they have cost as much, so that at the worst twice the cheaper way is spent; of large sets, where one
/// query by looking takes thousands of times as long as by the index, a sixth as much.
template <class Object, class S>
bool BoxSet<Object, S>::scanning_is_cheaper() const {
  if (index_.is_fresh(roster_)) return false;
  const std::uint64_t build = roster_.places() <= small_set ? 96 : 16;
  const std::uint64_t refresh = index_.pending(roster_) * (index_.is_started() ? 16 : build);
  return scanned_.fetch_add(roster_.places(), std::memory_order_relaxed) + roster_.places() <= refresh;
}

template <class Object, class S>
template <class Visit>
bool BoxSet<Object, S>::scan(Place first, const Box& box, Filter filter, Visit&& visit) const {
  const Box* const boxes = roster_.boxes().data();
  const GoesWith goes_with(filter, roster_.special_filters());
  // What is found may be kept for a query in another environment.
  boxstream::detail::DefaultFloatEnvironment environment;
  if (!is_valid(box)) return true;
  for (Place place = first; place < roster_.places(); ++place)
    // An unbounded box seems to touch those that are inside out, gaps included.
    if (touch(boxes[place], box) && is_valid(boxes[place]) && goes_with(place) &&
        !environment.outside([&] { return visit(place); }))
      return false;
  return true;
}

template <class Object, class S>
template <class Visit>
void BoxSet<Object, S>::for_each_overlap(const Box& box, Filter filter, Visit&& visit) const {
  if (!is_valid(box)) return;
  const World* const world = index();
  if (world == nullptr) {
    scan(0, box, filter, visit);
    return;
  }
  // To be put in order they must all be known. A query that meets much of the set is better off looking at all in
  // order: it delivers at once, and finds something to deliver soon.
  const std::size_t most = 256 + roster_.places() / 16;
  const GoesWith goes_with(filter, roster_.special_filters());
  Places found;
  world->query_box(box, [&](ProxyId id) {
    const Place place = index_.place(id);
    if (goes_with(place)) found.add(place);
    return found.size() <= most;
  });
  if (found.size() > most) {
    scan(0, box, filter, visit);
    return;
  }
  found.sort();
  for (const Place place : found)
    if (!visit(place)) return;
}

template <class Object, class S>
template <class Visit>
void BoxSet<Object, S>::for_each_overlap_in_any_order(const Box& box, Filter filter, Visit&& visit) const {
  if (!is_valid(box)) return;
  const World* const world = index();
  if (world == nullptr) {
    scan(0, box, filter, visit);
    return;
  }
  const GoesWith goes_with(filter, roster_.special_filters());
  world->query_box(box, [&](ProxyId id) {
    const Place place = index_.place(id);
    return !goes_with(place) || visit(place);
  });
}

/// The first rows of the matrix of pairs, as far as they cost little beside finding all pairs at once. Who only wants
/// to know if there is any, or has few objects, needs nothing else; who asks again gets the first pair at once. More
/// rows are tried for those who stopped the last time. Returns the first row not looked at.
template <class Object, class S>
template <class Visit>
Place BoxSet<Object, S>::scan_rows(Visit&& visit, bool& going_on) const {
  const std::uint64_t places = roster_.places();
  const bool try_all = places * places / 2 <= looks_at_all;
  const std::uint64_t budget = try_all ? looks_at_all : rows_to_try_.load(std::memory_order_relaxed) * places;
  std::uint64_t looks = 0;
  going_on = true;
  Place row = 0, column = 1;
  std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known != 0) {
    row = static_cast<Place>(known >> 32);
    column = static_cast<Place>(known);
    going_on = visit(row, column++);
  }
  for (; going_on && row < roster_.places(); ++row, column = row + 1) {
    const Box& box = roster_.box(row);
    if (!is_valid(box)) continue;
    looks += places - column;
    if (looks > budget && column == row + 1) break;
    going_on = scan(column, box, roster_.filter(row), [&](Place place) {
      if (known == 0) first_pair_.store(known = std::uint64_t{row} << 32 | place, std::memory_order_relaxed);
      return visit(row, place);
    });
  }
  return row;
}

/// Row by row, with memory for one row.
template <class Object, class S>
template <class Visit>
void BoxSet<Object, S>::visit_rows(Place first, Visit&& visit) const {
  bool going_on = true;
  for (Place row = first; going_on && row < roster_.places(); ++row)
    for_each_overlap(roster_.box(row), roster_.filter(row),
                     [&](Place place) { return place <= row || (going_on = visit(row, place)); });
}

/// Makes the World of a view hold all pairs, or be none if there are too many to hold them: then they are better found
/// again, row by row, in memory for n boxes. False if the view is not to be had: another query is at it.
template <class Object, class S>
bool BoxSet<Object, S>::find_pairs(const View<Object, S>& view) const {
  return view.refresh(roster_, [this](World& world) {
    const std::uint64_t most = (std::uint64_t{1} << 20) + 32 * std::uint64_t{roster_.places()};
    world.limit_begun(most);
    try {
      return world.update().pairs <= most;
    } catch (const std::length_error&) {
      return false;
    }
  });
}

/// Those of rows from `first` on.
template <class Object, class S>
template <class Visit>
void BoxSet<Object, S>::visit_pairs(const View<Object, S>& view, Place first, Visit&& visit) const {
  const World* const held = view.world();
  if (held == nullptr) return visit_rows(first, visit);
  held->stream_pairs([&](Span<const ProxyPair> pairs) {
    for (const ProxyPair pair : pairs) {
      const Place row = view.place(pair.a);
      if (row < first || visit(row, view.place(pair.b))) continue;
      rows_to_try_.store(rows_for_the_hasty, std::memory_order_relaxed);
      return false;
    }
    return true;
  });
}

template <class Object, class S>
template <class Visit>
void BoxSet<Object, S>::for_each_pair(Visit&& visit) const {
  if (roster_.size() < 2) return;
  Place first = 0;
  if (!pairs_.is_fresh(roster_)) {
    bool going_on = true;
    first = scan_rows(visit, going_on);
    if (!going_on) rows_to_try_.store(rows_for_the_hasty, std::memory_order_relaxed);
    if (!going_on || first == roster_.places()) return;
  }
  rows_to_try_.store(rows_for_the_thorough, std::memory_order_relaxed);
  if (find_pairs(pairs_)) return visit_pairs(pairs_, first, visit);
  // A view of its own, and no executor: nothing that could call another query.
  const View<Object, S> own;
  find_pairs(own);
  visit_pairs(own, first, visit);
}

}  // namespace boxstream::fcl::detail
