// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/detail/few_objects.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/known_first.hpp>
#include <boxstream/detail/made_once.hpp>
#include <boxstream/detail/movable.hpp>
#include <boxstream/detail/object_table.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/ray.hpp>

namespace boxstream {

namespace detail {

template <class S>
class Bvh;

/// The bounds of all boxes, and the number of the change of the table that they belong to; 0: not known.
template <class S>
struct KnownBounds {
  MovableAtomic<std::uint64_t> change{0};
  BasicAabb<S> box{};  // written before `change`

  bool are_of(const ObjectTable<S>& table) const {
    return change.load(std::memory_order_acquire) == table.last_change();
  }
};

}  // namespace detail

/// The objects of an engine and their boxes, for adapters: overlaps, pairs, distances and rays. Indices and pairs are
/// brought up to date when a query needs them.
///
///     ObjectSet set;
///     set.add(&body, box_of(body), Filter{}, false);
///     set.for_each_pair([&](ObjectSet::Place a, ObjectSet::Place b) { ...; return true; });
///
/// Objects are addresses that are never dereferenced, each in the set once. A *place* is the index of an object in a
/// table in the order of adding; it is valid until `remove`, `clear` or `shrink_to_fit`, even if that throws. The bit
/// `is_static` is kept for the caller.
///
/// Boxes touch if they share a point, sides included. A box with min > max on some axis, or a NaN, touches nothing; one
/// with infinite bounds is as good as any. Objects pair if their filters accept each other.
///
/// The first query that needs an index, or a World that holds all pairs, makes it; later queries bring it up to date.
/// Where a scan of all boxes is cheaper, both are left as they are. With few objects, pairs are never held, and near
/// objects are found without an index; with up to eight, what touches a box and what is near it as well,
/// and `remove` drops both.
///
/// @par Memory
/// In bytes an object, of doubles (floats): at most 90 (66) after `reserve` or `shrink_to_fit`, up to half as much
/// again without; with an index at most 165 (110). What holds all pairs takes as much as a World of them: as one after
/// `shrink_to_fit` while nothing moves.
///
/// @par Threads
/// Const members may run at the same time on any number of threads. Everything else needs exclusive access. No lock is
/// held while a visitor or an Executor runs: both may query this set, on the same thread too. Visitors may throw, and
/// must not change the set.
///
/// @par Order
/// The order of visits depends only on the calls of this set and the other one so far: where calls at once make an
/// index, on which does. Pairs of one set are sorted by places, of the
/// first, then of the second. With `Order::places` all queries except those for distances visit in order of places: a
/// query then collects its hits first, and pairs of two sets are found object by object, which takes longer.
///
/// @par Errors
/// std::bad_alloc from any call. A change has then done nothing; a query may have visited some objects.
///
/// @par Floating point
/// Results do not depend on the environment, and only flags change. Visitors run in the caller's.
template <class S>
class BOXSTREAM_API BasicObjectSet {
 public:
  using Box = BasicAabb<S>;
  using Place = std::uint32_t;
  using Table = detail::ObjectTable<S>;

  static constexpr Place none = Table::none;

  enum class Order { any, places };

  /// `executor` is borrowed for the life of the set and runs the search for all pairs. Of concurrent queries for all
  /// pairs the first one uses it. The others wait for its result; those that must not, to avoid a deadlock, search on
  /// their own thread. Null: everything runs on the calling thread.
  explicit BasicObjectSet(Executor* executor = nullptr) noexcept;
  /// With `Method::hybrid` all pairs of one set, or of two, are found by the paper's tree, however few objects there
  /// are; but not those of two sets in the order of places, nor so many of one set that they are not held.
  explicit BasicObjectSet(const DetectorOptions& options) noexcept;
  ~BasicObjectSet();
  /// A moved-from set can only be assigned to or destroyed.
  BasicObjectSet(BasicObjectSet&&) noexcept;
  BasicObjectSet& operator=(BasicObjectSet&&) noexcept;

  /// The table of objects, by place.
  const Table& table() const { return table_; }

  void reserve(std::size_t more) { table_.reserve(more); }
  /// The object must not be in the set.
  void add(void* object, const Box& box, Filter filter, bool is_static);
  void set_box(Place place, const Box& box) noexcept {
    if (table_.set_box(place, box)) forget_first_pair();
  }
  void set_filter(Place place, Filter filter, bool is_static) noexcept {
    table_.set_filter(place, filter, is_static);
    forget_first_pair();
  }
  void remove(Place place) noexcept;
  void clear() noexcept;
  /// Gives back all memory but that of the objects that are here. The next queries make what they need anew. May throw
  /// std::bad_alloc, and has then given back a part.
  void shrink_to_fit();

  using Visit = FunctionRef<bool(Place)>;
  using VisitPair = FunctionRef<bool(Place, Place)>;

  /// True if it is known without a query that nothing touches `box`. Any box is legal.
  bool is_clear(const Box& box) const {
    if (!known_.are_of(table_) || !detail::DefaultFloatEnvironment::is_here()) return false;
    for (int d = 0; d < 3; ++d)
      if (box.max[d] < known_.box.min[d] || known_.box.max[d] < box.min[d]) return true;
    return false;
  }

  /// Objects that touch `box` and whose filters accept `filter`. This query and the next ones end when a visitor
  /// returns false.
  template <class Visitor>
  void for_each_overlap(const Box& box, Filter filter, Order order, Visitor&& visit) const {
    if (table_.size() <= detail::most_of_few)
      detail::visit_few_overlaps(table_, box, filter, visit);
    else
      visit_overlaps(box, filter, order, visit);
  }
  /// All pairs.
  void for_each_pair(VisitPair visit) const;
  /// Pairs of an object of this set and one of `other`, which must be another set.
  template <class Visitor>
  void for_each_pair(const BasicObjectSet& other, Order order, Visitor&& visit) const {
    if (table_.size() == 0 || other.table_.size() == 0) return;
    const bool are_few = table_.size() <= detail::most_of_few && other.table_.size() <= detail::most_of_few;
    if (are_few && options_.method == Method::planned)
      detail::visit_few_pairs(table_, other.table_, visit);
    else
      visit_pairs(other, order, visit);
  }

  /// Return the limit of distances from now on. Zero, negative numbers and NaN end the query. After a higher limit than
  /// before, objects that were left out may stay out.
  using VisitNear = FunctionRef<S(Place)>;
  using VisitNearPair = FunctionRef<S(Place, Place)>;

  /// Objects nearer to `box` than the limit: see World::query_nearest_box.
  void for_each_near(const Box& box, Filter filter, S limit, VisitNear visit) const;
  /// Without a limit they begin with the nearest pair of a few, which is kept for later queries until a set changes.
  void for_each_near_pair(S limit, VisitNearPair visit) const;
  void for_each_near_pair(const BasicObjectSet& other, S limit, VisitNearPair visit) const;

  /// Objects that a ray meets: see World::query_ray.
  void for_each_hit(const BasicRay<S>& ray, FunctionRef<S(Place place, S enter, S length)> visit) const;

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  struct BOXSTREAM_LOCAL Impl;

  void forget_first_pair() noexcept { first_pair_.store(0, std::memory_order_relaxed); }
  BOXSTREAM_LOCAL Impl& impl() const;
  BOXSTREAM_LOCAL bool scans_next(std::uint64_t boxes) const;
  BOXSTREAM_LOCAL const detail::Bvh<S>& fresh_index() const;
  void visit_overlaps(const Box& box, Filter filter, Order order, Visit visit) const;
  void visit_pairs(const BasicObjectSet& other, Order order, VisitPair visit) const;
  BOXSTREAM_LOCAL bool scan(Place first, const Box& box, Filter filter, Visit visit) const;
  BOXSTREAM_LOCAL Place scan_rows(VisitPair visit, bool& going_on) const;
  BOXSTREAM_LOCAL void close_gaps();
  BOXSTREAM_LOCAL void forget_views() noexcept;
  BOXSTREAM_LOCAL bool joins(const BasicObjectSet& other) const;
  BOXSTREAM_LOCAL bool asks_by_rows(const BasicObjectSet& other) const;
  BOXSTREAM_LOCAL void visit_very_few(VisitPair visit) const;
  BOXSTREAM_LOCAL void visit_few(VisitPair visit) const;
  BOXSTREAM_LOCAL bool visit_known(Place row, Place column, std::uint64_t& known, VisitPair visit) const;
  BOXSTREAM_LOCAL void visit_near_few(const BasicObjectSet& other, S limit, VisitNearPair visit) const;
  BOXSTREAM_LOCAL void join(const BasicObjectSet& other, VisitPair visit) const;
  BOXSTREAM_LOCAL bool visit_rows(Place first, Place last, const BasicObjectSet& columns, VisitPair visit) const;

  detail::ObjectTable<S> table_;
  DetectorOptions options_;
  mutable detail::MadeOnce<Impl> impl_;  // for queries that need more than the table
  mutable detail::KnownBounds<S> known_;
  mutable detail::MovableAtomic<std::uint64_t> first_pair_{
      0};  // row and column in the upper and lower half; 0: unknown
  detail::OwnNumber number_;
  mutable detail::KnownFirst near_within_, near_other_;
};

using ObjectSet = BasicObjectSet<float>;
using ObjectSet64 = BasicObjectSet<double>;

extern template class BasicObjectSet<float>;
extern template class BasicObjectSet<double>;

}  // namespace boxstream
