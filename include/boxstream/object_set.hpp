// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/movable.hpp>
#include <boxstream/detail/roster.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/ray.hpp>

namespace boxstream {

namespace detail {

template <class S>
class Bvh;

/// The bounds of all boxes as they were after a change of the roster; 0: not known.
template <class S>
struct KnownBounds {
  MovableAtomic<std::uint64_t> change{0};
  BasicAabb<S> box{};  // written before `change`

  bool are_of(const Roster<S>& roster) const { return change.load(std::memory_order_acquire) == roster.last_change(); }
};

}  // namespace detail

/// The objects of an engine and their boxes, for adapters: what touches a box, what touches what, and how near things
/// are, without a word of when to look for it.
///
///     ObjectSet set;
///     set.add(&body, box_of(body), Filter{}, false);
///     set.for_each_pair([&](ObjectSet::Place a, ObjectSet::Place b) { ...; return true; });
///
/// Objects are addresses that are never dereferenced, each in the set once. They have *places*: numbers in the order of
/// adding, which hold until something is removed. The bit `is_static` is kept for the caller.
///
/// Boxes touch if they share a point, sides included. A box with min > max on some axis, or a NaN, touches nothing; one
/// with infinite bounds is as good as any. Objects pair if their filters accept each other.
///
/// An index, and a World that holds all pairs, are made by the first query that needs them, and follow what has changed
/// since. Where a look at each box is cheaper they are left as they are. Of few objects pairs are never held, and near
/// ones are found without an index.
///
/// Threads: const members may run at the same time from any number of threads, right after a change too. Everything
/// else needs the set to itself. No lock is held while a visitor runs, nor while an Executor does: both may query
/// this set, on the same thread too. Visitors may throw, and must not change the set.
/// Order: visitors get what is found in an order that depends on nothing but the calls of this set so far; pairs of one
/// set come by places, of the first, then the second. By `Order::places` all queries but those for distances give order
/// of places: all that a box touches is then found before the first is visited, and pairs of two sets are looked for
/// object by object, which takes up to four times as long.
/// Errors: std::bad_alloc from any call. What changes the set has then done nothing; a query may have visited some.
/// Nothing depends on the floating-point environment, nor changes it but for flags; visitors run in the caller's.
template <class S>
class BasicObjectSet {
 public:
  using Box = BasicAabb<S>;
  using Place = std::uint32_t;
  using Roster = detail::Roster<S>;

  static constexpr Place none = Roster::none;

  enum class Order { any, places };

  /// `executor` is borrowed for the life of the set and runs the search for all pairs. Of queries for all pairs that
  /// come at the same time the first uses it; others wait for that, but those that it could be waiting for: they do
  /// without. Null: everything is done by the calling thread.
  explicit BasicObjectSet(Executor* executor = nullptr) noexcept;
  ~BasicObjectSet();
  /// Leaves a set that can only be assigned to, or go.
  BasicObjectSet(BasicObjectSet&&) noexcept;
  BasicObjectSet& operator=(BasicObjectSet&&) noexcept;

  const Roster& roster() const { return roster_; }

  void reserve(std::size_t more) { roster_.reserve(more); }
  /// The object is not in the set.
  void add(void* object, const Box& box, Filter filter, bool is_static);
  void set_box(Place place, const Box& box) noexcept {
    if (roster_.set_box(place, box)) forget_first_pair();
  }
  void set_filter(Place place, Filter filter, bool is_static) noexcept {
    roster_.set_filter(place, filter, is_static);
    forget_first_pair();
  }
  void remove(Place place) noexcept;
  void clear() noexcept;

  using Visit = FunctionRef<bool(Place)>;
  using VisitPair = FunctionRef<bool(Place, Place)>;

  /// True if nothing touches `box` and that is known beforehand, so that a query for it can be spared. Any box will do.
  bool is_clear(const Box& box) const {
    if (!known_.are_of(roster_) || !detail::DefaultFloatEnvironment::is_here()) return false;
    for (int d = 0; d < 3; ++d)
      if (box.max[d] < known_.box.min[d] || known_.box.max[d] < box.min[d]) return true;
    return false;
  }

  /// What touches `box` and goes with `filter`. False from a visitor ends this query and those that follow.
  void for_each_overlap(const Box& box, Filter filter, Order order, Visit visit) const;
  /// All pairs.
  void for_each_pair(VisitPair visit) const;
  /// Pairs of an object of this set and one of the other, which is another one.
  void for_each_pair(const BasicObjectSet& other, Order order, VisitPair visit) const;

  /// The limit of distances from now on: zero, less and NaN end the query; more than before does not bring back what
  /// was left out.
  using VisitNear = FunctionRef<S(Place)>;
  using VisitNearPair = FunctionRef<S(Place, Place)>;

  /// What is nearer to `box` than the limit, as World::query_nearest_box.
  void for_each_near(const Box& box, Filter filter, S limit, VisitNear visit) const;
  void for_each_near_pair(S limit, VisitNearPair visit) const;
  void for_each_near_pair(const BasicObjectSet& other, S limit, VisitNearPair visit) const;

  /// What a ray meets, as World::query_ray.
  void for_each_hit(const BasicRay<S>& ray, FunctionRef<S(Place place, S enter, S length)> visit) const;

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  struct Impl;

  void forget_first_pair() noexcept { first_pair_.store(0, std::memory_order_relaxed); }
  const detail::Bvh<S>& fresh_index() const;
  bool scan(Place first, const Box& box, Filter filter, Visit visit) const;
  Place scan_rows(VisitPair visit, bool& going_on) const;
  void visit_few(VisitPair visit) const;
  bool visit_rows(Place first, Place last, const BasicObjectSet& columns, VisitPair visit) const;

  detail::Roster<S> roster_;
  Executor* executor_;
  std::unique_ptr<Impl> impl_;  // null while nothing was ever added
  mutable detail::KnownBounds<S> known_;
  mutable detail::MovableAtomic<std::uint64_t> first_pair_{
      0};  // row and column in the upper and lower half; 0: unknown
};

using ObjectSet = BasicObjectSet<float>;
using ObjectSet64 = BasicObjectSet<double>;

extern template class BasicObjectSet<float>;
extern template class BasicObjectSet<double>;

}  // namespace boxstream
