// SPDX-License-Identifier: MIT
#include <boxstream/object_set.hpp>

#include <algorithm>
#include <bit>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boxstream/detail/few_objects.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/has_order.hpp>

#include "base/thresholds.hpp"
#include "bvh/overlap_walk.hpp"
#include "objects/impl.hpp"
#include "world/state/proxies.hpp"

namespace boxstream {

namespace {

// A search for all pairs takes as long as 20 to 50 rows.
constexpr std::uint64_t rows_after_early_stop = 16;
constexpr std::uint64_t rows_after_full_visit = 1;

}  // namespace

template <class S>
BasicObjectSet<S>::BasicObjectSet(Executor* executor) noexcept : options_{executor} {}
template <class S>
BasicObjectSet<S>::BasicObjectSet(const DetectorOptions& options) noexcept : options_(options) {}
template <class S>
BasicObjectSet<S>::~BasicObjectSet() = default;
template <class S>
BasicObjectSet<S>::BasicObjectSet(BasicObjectSet&&) noexcept = default;
template <class S>
BasicObjectSet<S>& BasicObjectSet<S>::operator=(BasicObjectSet&&) noexcept = default;

template <class S>
void BasicObjectSet<S>::add(void* object, const Box& box, Filter filter, bool is_static) {
  table_.reserve(1);
  table_.add(object, box, filter, is_static);
  forget_first_pair();
}

/// Few objects have no gaps among them, so that what each query takes is a matter of how many there are.
template <class S>
void BasicObjectSet<S>::remove(Place place) noexcept {
  forget_first_pair();
  if (table_.size() <= detail::most_of_few + 1) {
    table_.take_out(place);
    forget_views();
    return;
  }
  table_.remove(place);
  if (table_.gaps() <= detail::thresholds.most_gaps + table_.size() / 2) return;
  try {
    close_gaps();
  } catch (const std::bad_alloc&) {
    // They stay until the next object leaves.
  }
}

/// The views are renumbered too: removals that they have not seen stay as gaps, unless those would be most of all gaps.
/// Views that are too far behind are rebuilt.
template <class S>
void BasicObjectSet<S>::close_gaps() {
  Impl* const made = impl_.made();
  std::uint64_t index_seen = made != nullptr ? made->index.seen(table_, known_) : 0;
  std::uint64_t pairs_seen = made != nullptr ? made->pairs.seen(table_) : 0;
  const auto first_unseen = [&] {
    const std::uint64_t now = table_.last_change();
    return std::min(index_seen != 0 ? index_seen : now, pairs_seen != 0 ? pairs_seen : now);
  };
  std::vector<Place> to = table_.compacted(first_unseen());
  const auto closed = static_cast<std::size_t>(std::count(to.begin(), to.end(), none));
  if (closed < table_.gaps() / 2) {
    index_seen = pairs_seen = 0;
    to = table_.compacted(table_.last_change());
  }
  table_.compact(to);
  if (made == nullptr) return;
  if (index_seen != 0)
    made->index.follow(to);
  else
    made->index.forget(known_);
  if (pairs_seen != 0)
    made->pairs.follow(to);
  else
    made->pairs.clear();
}

template <class S>
void BasicObjectSet<S>::shrink_to_fit() {
  impl_.reset();
  known_.change.store(0, std::memory_order_relaxed);
  forget_first_pair();
  if (table_.gaps() != 0) {
    table_.compact(table_.compacted(table_.last_change()));
    table_.forget_changes();  // as places have changed, and what follows may throw
  }
  table_.shrink_to_fit();
}

template <class S>
void BasicObjectSet<S>::forget_views() noexcept {
  Impl* const made = impl_.made();
  if (made == nullptr) return;
  made->index.forget(known_);
  made->pairs.clear();
}

template <class S>
void BasicObjectSet<S>::clear() noexcept {
  forget_views();
  table_.clear();
  forget_first_pair();
}

/// Tests the boxes from `first` on, in order. Returns false if `visit` did.
template <class S>
bool BasicObjectSet<S>::scan(Place first, const Box& box, Filter filter, Visit visit) const {
  const Box* const boxes = table_.boxes().data();
  const detail::FilterTest filter_test(filter, table_.special_filters());
  // Hits may be kept for a query in another environment.
  detail::DefaultFloatEnvironment environment;
  if (!detail::has_order(box)) return true;
  for (Place place = first; place < table_.places(); ++place)
    // An unbounded box seems to touch inverted boxes, gaps included.
    if (detail::touch(boxes[place], box) && detail::has_order(boxes[place]) && filter_test(place) &&
        !environment.outside([&] { return visit(place); }))
      return false;
  return true;
}

template <class S>
void BasicObjectSet<S>::visit_overlaps(const Box& box, Filter filter, Order order, Visit visit) const {
  if (!detail::has_valid_keys(box)) return;
  if (scans_next(table_.places())) {
    scan(0, box, filter, visit);
    return;
  }
  const detail::Bvh<S>& bvh = fresh_index();
  if (order == Order::places) {
    detail::ScratchPlaces found(impl().spare);
    for_each_overlap(box, filter, Order::any, [&](Place place) {
      found->push_back(place);
      return true;
    });
    std::sort(found->begin(), found->end());
    for (auto place = found->begin(); place != found->end() && visit(*place);) ++place;
    return;
  }
  const detail::FilterTest filter_test(filter, table_.special_filters());
  bvh.for_each_overlap(box, [&](Place place) {
    return !detail::overlap_by_keys(box, table_.box(place)) || !filter_test(place) || visit(place);
  });
}

/// Visits a pair that touches if the filters accept it, unless it is the one that was known from the beginning. The
/// first pair is kept for the next query, which may stop there.
template <class S>
inline bool BasicObjectSet<S>::visit_known(Place row, Place column, std::uint64_t& known, VisitPair visit) const {
  const std::uint64_t number = detail::number_of_pair(row, column);
  if (number == known || !accepts(table_.filter(row), table_.filter(column))) return true;
  if (known == 0) first_pair_.store(known = number, std::memory_order_relaxed);
  return visit(row, column);
}

/// All are compared one by one.
template <class S>
void BasicObjectSet<S>::visit_very_few(VisitPair visit) const {
  std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known != 0 && !visit(static_cast<Place>(known >> 32), static_cast<Place>(known))) return;
  detail::visit_few_pairs(table_, table_,
                          [&](Place row, Place column) { return visit_known(row, column, known, visit); });
}

template <class S>
void BasicObjectSet<S>::visit_few(VisitPair visit) const {
  std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known != 0 && !visit(static_cast<Place>(known >> 32), static_cast<Place>(known))) return;
  constexpr std::size_t most = detail::FewPairs::most;
  const detail::LivePlaces<S, most> places(table_);
  detail::FewPairs pairs;
  {
    const detail::DefaultFloatEnvironment environment;
    const detail::FewBlocks<S, most> blocks(places.count(),
                                            [&](std::size_t i) -> const Box& { return table_.box(places[i]); });
    detail::find_few_pairs(blocks.data(), blocks.count(), pairs);
  }
  for (std::size_t i = 0; i < places.count(); ++i)
    for (std::size_t word = i / 64; word < most / 64; ++word)
      for (std::uint64_t left = pairs.rows[i][word]; left != 0; left &= left - 1) {
        const Place row = places[i], column = places[64 * word + static_cast<unsigned>(std::countr_zero(left))];
        if (!visit_known(row, column, known, visit)) return;
      }
}

/// Visits the first rows of the matrix of pairs, as long as they are cheap compared to a search for all pairs. That is
/// enough for queries that stop at the first pair. The first pair is kept for the next query. If the last query was
/// stopped early, more rows are tried. Returns the first row not visited.
template <class S>
typename BasicObjectSet<S>::Place BasicObjectSet<S>::scan_rows(VisitPair visit, bool& going_on) const {
  const std::uint64_t places = table_.places();
  const std::uint64_t budget = impl().rows_to_try.load(std::memory_order_relaxed) * places;
  std::uint64_t tests = 0;
  going_on = true;
  Place row = 0, column = 1;
  std::uint64_t known = first_pair_.load(std::memory_order_relaxed);
  if (known != 0) {
    row = static_cast<Place>(known >> 32);
    column = static_cast<Place>(known);
    going_on = visit(row, column++);
  }
  for (; going_on && row < table_.places(); ++row, column = row + 1) {
    const Box& box = table_.box(row);
    if (!detail::has_valid_keys(box)) continue;
    tests += places - column;
    if (tests > budget && column == row + 1) break;
    going_on = scan(column, box, table_.filter(row), [&](Place place) {
      if (known == 0) first_pair_.store(known = detail::number_of_pair(row, place), std::memory_order_relaxed);
      return visit(row, place);
    });
  }
  return row;
}

/// Visits pairs row by row, in order, with memory for one row. Returns false if `visit` did.
template <class S>
bool BasicObjectSet<S>::visit_rows(Place first, Place last, const BasicObjectSet& columns, VisitPair visit) const {
  bool going_on = true;
  for (Place row = first; going_on && row < last; ++row)
    columns.for_each_overlap(table_.box(row), table_.filter(row), Order::places, [&](Place column) {
      return (&columns == this && column <= row) || (going_on = visit(row, column));
    });
  return going_on;
}

/// Brings `pairs` up to date. If there are too many pairs they are not held. False if another query is doing this and
/// must not be waited for.
template <class S>
static bool find_pairs(const detail::LazyPairs<S>& pairs, const detail::ObjectTable<S>& table) {
  return pairs.refresh(table, [&](BasicWorld<S>& world) {
    const std::uint64_t most =
        detail::thresholds.held_pairs + detail::thresholds.held_pairs_of_place * std::uint64_t{table.places()};
    world.set_max_begun(most);
    try {
      return world.update().pairs <= most;
    } catch (const std::length_error&) {
      return false;
    }
  });
}

template <class S>
void BasicObjectSet<S>::for_each_pair(VisitPair visit) const {
  if (table_.size() < 2) return;
  const bool is_planned = options_.method == Method::planned;
  if (is_planned && table_.size() <= detail::most_of_few) return visit_very_few(visit);
  if (is_planned && table_.size() <= detail::thresholds.few_objects) return visit_few(visit);
  Impl& impl = this->impl();
  Place first = 0;
  if (is_planned && !impl.pairs.is_fresh(table_)) {
    bool going_on = true;
    first = scan_rows(visit, going_on);
    if (!going_on) impl.rows_to_try.store(rows_after_early_stop, std::memory_order_relaxed);
    if (!going_on || first == table_.places()) return;
  }
  impl.rows_to_try.store(rows_after_full_visit, std::memory_order_relaxed);
  const auto visit_held = [&](const detail::LazyPairs<S>& pairs) {
    const BasicWorld<S>* const held = pairs.world();
    if (held == nullptr) {
      visit_rows(first, table_.places(), *this, visit);
      return;
    }
    held->stream_pairs([&](Span<const ProxyPair> portion) {
      for (const ProxyPair pair : portion) {
        const Place row = pairs.place(pair.a);
        if (row < first || visit(row, pairs.place(pair.b))) continue;
        impl.rows_to_try.store(rows_after_early_stop, std::memory_order_relaxed);
        return false;
      }
      return true;
    });
  };
  if (find_pairs(impl.pairs, table_)) return visit_held(impl.pairs);
  // A World of its own, without an executor, so that nothing calls another query.
  DetectorOptions alone = options_;
  alone.executor = nullptr;
  const detail::LazyPairs<S> own(detail::world_options(alone));
  find_pairs(own, table_);
  visit_held(own);
}

template <class S>
void BasicObjectSet<S>::visit_pairs(const BasicObjectSet& other, Order order, VisitPair visit) const {
  const Table& rows = table_;
  const Table& columns = other.table_;
  if (order == Order::places) {
    visit_rows(0, rows.places(), other, visit);
    return;
  }
  bool going_on = true;
  if (options_.method == Method::hybrid || joins(other)) {
    join(other, visit);
  } else if (asks_by_rows(other)) {
    for (Place row = 0; going_on && row < rows.places(); ++row)
      if (!other.is_clear(rows.box(row)))
        other.for_each_overlap(rows.box(row), rows.filter(row), order,
                               [&](Place column) { return going_on = visit(row, column); });
  } else {
    for (Place column = 0; going_on && column < columns.places(); ++column)
      if (!is_clear(columns.box(column)))
        for_each_overlap(columns.box(column), columns.filter(column), order,
                         [&](Place row) { return going_on = visit(row, column); });
  }
}

/// True if a batch is the way to all pairs with another set. To ask about the objects of the smaller one takes half as
/// long where the larger one has three times as many and an index, and that is made once batches have cost as much.
template <class S>
bool BasicObjectSet<S>::joins(const BasicObjectSet& other) const {
  // What a batch takes longer for a box of the larger set, in scans of a box.
  constexpr std::uint64_t excess = 8;
  const bool has_more = table_.size() > other.table_.size();
  const BasicObjectSet& larger = has_more ? *this : other;
  const std::size_t more = larger.table_.size(), fewer = (has_more ? other : *this).table_.size();
  const bool are_many = std::uint64_t{more} * fewer > detail::thresholds.few_tests;
  return are_many && more / 8 < fewer && (more / 3 < fewer || larger.scans_next(excess * more));
}

/// True if the objects of this set are to be asked about in the other one: those of the smaller in the larger, unless
/// the index of that would have to be refreshed for them and to ask the other way round is cheaper.
template <class S>
bool BasicObjectSet<S>::asks_by_rows(const BasicObjectSet& other) const {
  // In scans of a box. Less than a query costs, as a refresh may find that most boxes have moved.
  constexpr std::uint64_t query = 2, refresh = 16;
  const bool has_more = table_.size() > other.table_.size();
  const BasicObjectSet &larger = has_more ? *this : other, &smaller = has_more ? other : *this;
  const auto is_ready = [](const BasicObjectSet& set) {
    return set.table_.size() <= detail::most_of_few || set.known_.are_of(set.table_);
  };
  const std::uint64_t more = query * (larger.table_.size() - smaller.table_.size()) +
                             (is_ready(smaller) ? 0 : refresh * smaller.table_.size());
  const bool by_smaller = is_ready(larger) || !larger.scans_next(more);
  return by_smaller != has_more;
}

/// One batch, on the calling thread.
template <class S>
void BasicObjectSet<S>::join(const BasicObjectSet& other, VisitPair visit) const {
  DetectorOptions alone = options_;
  alone.executor = nullptr;
  const auto pass_on = [&](Span<const Pair> pairs) {
    for (const Pair p : pairs)
      if (accepts(table_.filter(p.a), other.table_.filter(p.b)) && !visit(p.a, p.b)) return false;
    return true;
  };
  Detector(alone).stream_pairs(Span<const Box>(table_.boxes()), Span<const Box>(other.table_.boxes()), pass_on);
}

template class BasicObjectSet<float>;
template class BasicObjectSet<double>;

}  // namespace boxstream
