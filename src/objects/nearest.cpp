// SPDX-License-Identifier: MIT
// BasicObjectSet: distances and rays.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/has_order.hpp>
#include <boxstream/detail/lazy_float_environment.hpp>

#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "nearest/nearest_walk.hpp"
#include "objects/few_near_objects.hpp"
#include "objects/impl.hpp"

namespace boxstream {

namespace {

/// Passes boxes found by a walk to the visitor of a query, in the caller's floating-point environment.
template <class S>
class NearOffer {
 public:
  void go_out() { environment_.go_out(); }
  void come_in() { environment_.come_in(); }

 protected:
  bool is_nearer(const detail::NearLimit<S>& limit, S squared, const BasicAabb<S>& x, const BasicAabb<S>& y) {
    if (limit.is_clearly_above(squared)) return true;
    come_in();
    const bool is = limit.is_above(detail::distance_below(x, y));
    go_out();
    return is;
  }

 private:
  detail::LazyFloatEnvironment environment_;
};

/// For queries about one box.
template <class S>
class BoxOffer : public NearOffer<S> {
 public:
  using Visit = typename BasicObjectSet<S>::VisitNear;

  BoxOffer(const detail::ObjectTable<S>& table, const std::uint32_t* places, const BasicAabb<S>& box, Filter filter,
           const Visit& visit)
      : table_(table), places_(places), box_(box), filter_test_(filter, table.special_filters()), visit_(visit) {}

  void operator()(detail::NearLimit<S>& limit, std::uint32_t, std::uint32_t at, S squared) {
    const std::uint32_t place = places_[at];
    if (!filter_test_(place) || !this->is_nearer(limit, squared, box_, table_.box(place))) return;
    const S next = visit_(place);
    if (!limit.is(next)) limit.set(next);
  }

 private:
  const detail::ObjectTable<S>& table_;
  const std::uint32_t* const places_;  // of the index
  const BasicAabb<S>& box_;
  const detail::FilterTest filter_test_;
  const Visit& visit_;
};

/// One set of a walk for pairs, and the places of what is walked over.
template <class S>
struct Side {
  const detail::ObjectTable<S>& table;
  const std::uint32_t* places;
};

/// The places of two boxes of a walk, in order if they are of one table.
template <class S>
struct PairPlaces {
  std::uint32_t a, b;

  PairPlaces(const Side<S>& mine, std::uint32_t my_at, const Side<S>& theirs, std::uint32_t their_at)
      : a(mine.places[my_at]), b(theirs.places[their_at]) {
    if (&mine.table == &theirs.table && b < a) std::swap(a, b);
  }
};

constexpr std::uint64_t no_pair = detail::KnownFirst::unknown - 1;  // as a number of one

/// For queries about pairs. One pair, by its number, has been visited before.
template <class S>
class PairOffer : public NearOffer<S> {
 public:
  using Visit = typename BasicObjectSet<S>::VisitNearPair;

  PairOffer(const Side<S>& mine, const Side<S>& theirs, const Visit& visit, std::uint64_t visited = no_pair)
      : mine_(mine), theirs_(theirs), visit_(visit), visited_(visited) {}

  void operator()(detail::NearLimit<S>& limit, std::uint32_t my_at, std::uint32_t their_at, S squared) {
    const auto [a, b] = PairPlaces<S>(mine_, my_at, theirs_, their_at);
    if (!accepts(mine_.table.filter(a), theirs_.table.filter(b)) ||
        !this->is_nearer(limit, squared, mine_.table.box(a), theirs_.table.box(b)) ||
        detail::number_of_pair(a, b) == visited_)
      return;
    const S next = visit_(a, b);
    if (!limit.is(next)) limit.set(next);
  }

 private:
  const Side<S>& mine_;
  const Side<S>& theirs_;
  const Visit& visit_;
  const std::uint64_t visited_;
};

/// Keeps the nearest of the pairs that a walk finds, about. No code of a caller runs: which pair it is depends on boxes
/// and filters alone. In the default floating-point environment.
template <class S>
class NearestOffer {
 public:
  NearestOffer(const Side<S>& mine, const Side<S>& theirs, std::uint64_t& nearest)
      : mine_(mine), theirs_(theirs), nearest_(nearest) {}

  void operator()(detail::NearLimit<S>& limit, std::uint32_t my_at, std::uint32_t their_at, S squared) {
    const auto [a, b] = PairPlaces<S>(mine_, my_at, theirs_, their_at);
    if (!limit.is_clearly_above(squared) || !accepts(mine_.table.filter(a), theirs_.table.filter(b))) return;
    nearest_ = detail::number_of_pair(a, b);
    limit.set(std::sqrt(squared));
  }

 private:
  const Side<S>& mine_;
  const Side<S>& theirs_;
  std::uint64_t& nearest_;
};

/// The beginning of a query about pairs that has no limit yet: a pair that is the nearest of a few is visited, which
/// sets a limit for all others, or ends the query. The visitor has no part in which one it is, so it is kept for the
/// next query.
template <class S>
class Beginning {
 public:
  using Visit = typename BasicObjectSet<S>::VisitNearPair;

  Beginning(detail::KnownFirst& known, const detail::KnownFirst::Of& of, S limit, const Visit& visit)
      : known_(known), of_(of), limit_(limit), visit_(visit) {
    first_ = limit_.is_finite() ? no_pair : known.find(of);
    visit_first();
  }

  /// If it was not known: `walk(visits)` looks at a few pairs.
  template <class Walk>
  void find(const Side<S>& mine, const Side<S>& theirs, Walk&& walk) {
    if (is_known()) return;
    std::uint64_t nearest = no_pair;
    {
      const detail::DefaultFloatEnvironment environment;
      detail::NearVisits<S, NearestOffer<S>> visits(limit_, mine, theirs, nearest);
      walk(visits);
    }
    keep(first_ = nearest);
    visit_first();
  }
  bool is_known() const { return first_ != detail::KnownFirst::unknown; }
  /// For the next query.
  void keep(std::uint64_t pair) {
    if (pair != detail::KnownFirst::unknown) known_.keep(of_, pair);
  }

  const detail::NearLimit<S>& limit() const { return limit_; }
  bool is_all() const { return limit_.is_over(); }
  bool has_visited() const { return first_ < no_pair; }
  /// The number of the pair that was visited, if any.
  std::uint64_t visited() const { return first_; }

 private:
  void visit_first() {
    if (!has_visited()) return;
    const S next = visit_(static_cast<std::uint32_t>(first_ >> 32), static_cast<std::uint32_t>(first_));
    if (!limit_.is(next)) limit_.set(next);
  }

  detail::KnownFirst& known_;
  const detail::KnownFirst::Of of_;
  detail::NearLimit<S> limit_;
  const Visit& visit_;
  std::uint64_t first_;
};

}  // namespace

template <class S>
void BasicObjectSet<S>::for_each_near(const Box& box, Filter filter, S limit, VisitNear visit) const {
  if (table_.size() <= detail::most_of_few) return detail::visit_few_near(table_, box, filter, limit, visit);
  const detail::Bvh<S>& bvh = fresh_index();
  detail::NearVisits<S, BoxOffer<S>> visits(limit, table_, bvh.slots(), box, filter, visit);
  if (detail::has_order(box)) detail::visit_near(box, bvh, visits);
}

/// All pairs of the set, or with all of another one. One that touches, and often ends the query, is kept for the next
/// one, and one that is alone; else the nearest comes first anyway.
template <class S>
void BasicObjectSet<S>::visit_near_few(const BasicObjectSet& other, S limit, VisitNearPair visit) const {
  Beginning<S> begin(&other == this ? near_within_ : near_other_,
                     {other.number_, table_.last_change(), other.table_.last_change()}, limit, visit);
  const bool is_one = table_.size() + other.table_.size() == (&other == this ? 4 : 2);
  if (begin.is_all() || (is_one && begin.has_visited())) return;
  detail::FewNearPairs<S> pairs(table_, other.table_, begin.visited());
  if (!begin.is_known()) begin.keep(pairs.first(begin.limit()));
  pairs.visit(begin.limit(), visit);
}

template <class S>
void BasicObjectSet<S>::for_each_near_pair(S limit, VisitNearPair visit) const {
  if (table_.size() < 2) return;
  if (table_.size() * (table_.size() - 1) / 2 <= detail::thresholds.near_tests)
    return visit_near_few(*this, limit, visit);
  Beginning<S> begin(near_within_, {number_, table_.last_change(), table_.last_change()}, limit, visit);
  if (begin.is_all()) return;
  constexpr std::size_t few = detail::thresholds.few_near_objects, looked_at = detail::thresholds.first_near_blocks;
  // To compare all with all in blocks takes an eighth of a scan for each.
  if (table_.size() <= few && scans_next(table_.size() * table_.size() / detail::BoxBlock<S>::width)) {
    const detail::LivePlaces<S, few> places(table_);
    const Side<S> side{table_, places.data()};
    detail::LazyFloatEnvironment environment;
    const detail::FewBlocks<S, few> blocks(places.count(),
                                           [&](std::size_t i) -> const Box& { return table_.box(places[i]); });
    environment.go_out();
    begin.find(side, side, [&](auto& visits) {
      detail::visit_near_within(blocks.data(), std::min(blocks.count(), looked_at), visits);
    });
    if (begin.is_all()) return;
    detail::NearVisits<S, PairOffer<S>> visits(begin.limit(), side, side, visit, begin.visited());
    detail::visit_near(blocks.data(), blocks.count(), visits);
    return;
  }
  const detail::Bvh<S>& bvh = fresh_index();
  const Side<S> side{table_, bvh.slots()};
  // What was put into one block is likely to be near.
  begin.find(side, side, [&](auto& visits) {
    detail::visit_near_within(bvh.leaves(), std::min(bvh.leaf_blocks(), looked_at), visits);
  });
  if (begin.is_all()) return;
  detail::NearVisits<S, PairOffer<S>> visits(begin.limit(), side, side, visit, begin.visited());
  if (bvh.levels() == 0)
    detail::visit_near(bvh.leaves(), bvh.leaf_blocks(), visits);
  else
    detail::visit_near(detail::NearSide<S>(bvh), detail::NearSide<S>(bvh), visits);
}

template <class S>
void BasicObjectSet<S>::for_each_near_pair(const BasicObjectSet& other, S limit, VisitNearPair visit) const {
  if (&other == this) return for_each_near_pair(limit, visit);
  if (table_.size() == 0 || other.table_.size() == 0) return;
  if (table_.size() * other.table_.size() <= detail::thresholds.near_tests) return visit_near_few(other, limit, visit);
  Beginning<S> begin(near_other_, {other.number_, table_.last_change(), other.table_.last_change()}, limit, visit);
  if (begin.is_all()) return;
  const detail::Bvh<S>& mine = fresh_index();
  const detail::Bvh<S>& theirs = other.fresh_index();
  const Side<S> my_side{table_, mine.slots()}, their_side{other.table_, theirs.slots()};
  const detail::NearSide<S> x(mine), y(theirs);
  const bool are_lists = mine.levels() == 0 && theirs.levels() == 0;
  begin.find(my_side, their_side, [&](auto& visits) {
    const auto one = [](const detail::Bvh<S>& list) { return std::min<std::size_t>(list.leaf_blocks(), 1); };
    if (are_lists)
      detail::visit_near(mine.leaves(), one(mine), theirs.leaves(), one(theirs), visits);
    else
      detail::visit_near(x, y, visits, detail::thresholds.first_near_opened);
  });
  if (begin.is_all()) return;
  detail::NearVisits<S, PairOffer<S>> visits(begin.limit(), my_side, their_side, visit, begin.visited());
  if (are_lists)
    detail::visit_near(mine.leaves(), mine.leaf_blocks(), theirs.leaves(), theirs.leaf_blocks(), visits);
  else
    detail::visit_near(x, y, visits);
}

template <class S>
void BasicObjectSet<S>::for_each_hit(const BasicRay<S>& ray,
                                     FunctionRef<S(Place place, S enter, S length)> visit) const {
  if (table_.size() == 0) return;
  const detail::Bvh<S>& bvh = fresh_index();
  detail::DefaultFloatEnvironment environment;
  bvh.for_each_hit(detail::RaySlabs<S>(ray), [&](Place place, S enter, S length) {
    return environment.outside([&] { return visit(place, enter, length); });
  });
}

#define INSTANTIATE(S)                                                                                \
  template void BasicObjectSet<S>::visit_near_few(const BasicObjectSet&, S, VisitNearPair) const;     \
  template void BasicObjectSet<S>::for_each_near(const Box&, Filter, S, VisitNear) const;             \
  template void BasicObjectSet<S>::for_each_near_pair(S, VisitNearPair) const;                        \
  template void BasicObjectSet<S>::for_each_near_pair(const BasicObjectSet&, S, VisitNearPair) const; \
  template void BasicObjectSet<S>::for_each_hit(const BasicRay<S>&, FunctionRef<S(Place, S, S)>) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
