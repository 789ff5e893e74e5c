// SPDX-License-Identifier: MIT
// BasicObjectSet: distances and rays.
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "base/keys.hpp"
#include "base/lazy_float_environment.hpp"
#include "base/thresholds.hpp"
#include "nearest/few_near.hpp"
#include "nearest/nearest_walk.hpp"
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

/// For queries about pairs.
template <class S>
class PairOffer : public NearOffer<S> {
 public:
  using Visit = typename BasicObjectSet<S>::VisitNearPair;
  /// One set of a walk, and the places of what is walked over.
  struct Side {
    const detail::ObjectTable<S>& table;
    const std::uint32_t* places;
  };

  PairOffer(const Side& mine, const Side& theirs, const Visit& visit) : mine_(mine), theirs_(theirs), visit_(visit) {}

  void operator()(detail::NearLimit<S>& limit, std::uint32_t my_at, std::uint32_t their_at, S squared) {
    std::uint32_t a = mine_.places[my_at], b = theirs_.places[their_at];
    if (!accepts(mine_.table.filter(a), theirs_.table.filter(b)) ||
        !this->is_nearer(limit, squared, mine_.table.box(a), theirs_.table.box(b)))
      return;
    if (&mine_.table == &theirs_.table && b < a) std::swap(a, b);
    const S next = visit_(a, b);
    if (!limit.is(next)) limit.set(next);
  }

 private:
  const Side& mine_;
  const Side& theirs_;
  const Visit& visit_;
};

}  // namespace

template <class S>
void BasicObjectSet<S>::for_each_near(const Box& box, Filter filter, S limit, VisitNear visit) const {
  if (table_.size() == 0) return;
  constexpr std::size_t few = detail::thresholds.scanned_objects;
  if (table_.size() <= few) {
    const detail::LivePlaces<S, few> places(table_);
    detail::NearVisits<S, BoxOffer<S>> visits(limit, table_, places.data(), box, filter, visit);
    const auto box_of = [&](std::size_t i) -> const Box& { return table_.box(places[i]); };
    if (detail::has_order(box)) detail::visit_near_few(box, places.count(), box_of, visits);
    return;
  }
  const detail::Bvh<S>& bvh = fresh_index();
  detail::NearVisits<S, BoxOffer<S>> visits(limit, table_, bvh.slots(), box, filter, visit);
  if (detail::has_order(box)) detail::visit_near(box, bvh, visits);
}

/// All pairs of the set, or with all of another one.
template <class S>
void BasicObjectSet<S>::visit_near_few(const BasicObjectSet& other, S limit, VisitNearPair visit) const {
  constexpr std::size_t most = detail::thresholds.near_tests;
  const bool is_same = &other == this;
  const detail::LivePlaces<S, most> mine(table_), theirs(other.table_);
  const typename PairOffer<S>::Side my_side{table_, mine.data()}, their_side{other.table_, theirs.data()};
  detail::NearVisits<S, PairOffer<S>> visits(limit, my_side, their_side, visit);
  visits.come_in();
  detail::FewNear<S> pairs;
  for (std::uint32_t a = 0; a < mine.count(); ++a) {
    const Box& box = table_.box(mine[a]);
    if (!detail::has_order(box)) continue;
    for (std::uint32_t b = is_same ? a + 1 : 0; b < theirs.count(); ++b)
      if (const Box& other_box = other.table_.box(theirs[b]); detail::has_order(other_box))
        pairs.add(a, box, b, other_box);
  }
  pairs.visit(visits);
}

template <class S>
void BasicObjectSet<S>::for_each_near_pair(S limit, VisitNearPair visit) const {
  if (table_.size() < 2) return;
  if (table_.size() * (table_.size() - 1) / 2 <= detail::thresholds.near_tests)
    return visit_near_few(*this, limit, visit);
  constexpr std::size_t few = detail::thresholds.few_near_objects;
  // To compare all with all in blocks takes an eighth of a scan for each.
  if (table_.size() > few || !scans_next(table_.size() * table_.size() / detail::BoxBlock<S>::width))
    return for_each_near_pair(*this, limit, visit);
  const detail::LivePlaces<S, few> places(table_);
  const typename PairOffer<S>::Side side{table_, places.data()};
  detail::NearVisits<S, PairOffer<S>> visits(limit, side, side, visit);
  const detail::FewBlocks<S, few> blocks(places.count(),
                                         [&](std::size_t i) -> const Box& { return table_.box(places[i]); });
  detail::visit_near(blocks.data(), blocks.count(), visits);
}

template <class S>
void BasicObjectSet<S>::for_each_near_pair(const BasicObjectSet& other, S limit, VisitNearPair visit) const {
  if (table_.size() == 0 || other.table_.size() == 0) return;
  if (&other != this && table_.size() * other.table_.size() <= detail::thresholds.near_tests)
    return visit_near_few(other, limit, visit);
  const detail::Bvh<S>& mine = fresh_index();
  const detail::Bvh<S>& theirs = other.fresh_index();
  const typename PairOffer<S>::Side my_side{table_, mine.slots()}, their_side{other.table_, theirs.slots()};
  detail::NearVisits<S, PairOffer<S>> visits(limit, my_side, their_side, visit);
  if (mine.levels() == 0 && theirs.levels() == 0) {
    if (&mine == &theirs)
      detail::visit_near(mine.leaves(), mine.leaf_blocks(), visits);
    else
      detail::visit_near(mine.leaves(), mine.leaf_blocks(), theirs.leaves(), theirs.leaf_blocks(), visits);
    return;
  }
  detail::visit_near(detail::NearSide<S>(mine), detail::NearSide<S>(theirs), visits);
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
