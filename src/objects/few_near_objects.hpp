// SPDX-License-Identifier: MIT
// Distances of so few objects that they are compared one by one.
#pragma once

#include <cstdint>

#include <boxstream/detail/few_objects.hpp>
#include <boxstream/detail/has_order.hpp>
#include <boxstream/detail/lazy_float_environment.hpp>
#include <boxstream/detail/object_table.hpp>

#include "base/thresholds.hpp"
#include "nearest/few_near.hpp"
#include "objects/impl.hpp"

namespace boxstream::detail {

/// A lower bound of the distance of two boxes, in the caller's environment.
template <class S>
S outside_distance_below(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  const LazyFloatEnvironment environment;
  return distance_below(a, b);
}

/// The objects nearer to a box than the limit; `visit(place)` returns the limit from now on.
template <class S, class Visit>
void visit_few_near(const ObjectTable<S>& table, const BasicAabb<S>& box, Filter filter, S limit, const Visit& visit) {
  static_assert(most_of_few <= FewNear<S>::most);
  FewNear<S> near;
  {
    const LazyFloatEnvironment environment;
    if (!has_order(box)) return;
    for (std::uint32_t place = 0; place < table.size(); ++place) {
      const BasicAabb<S>& mine = table.box(place);
      if (has_order(mine) && accepts(filter, table.filter(place))) near.add(place, about_squared(mine, box));
    }
  }
  const auto distance_of = [&](unsigned place) { return outside_distance_below(table.box(place), box); };
  near.visit(NearLimit<S>(limit), distance_of, visit);
}

/// Pairs of objects of two tables, or of one.
template <class S>
class FewNearPairs {
 public:
  using Table = ObjectTable<S>;

  /// Of all but one pair, by its number.
  FewNearPairs(const Table& rows, const Table& columns, std::uint64_t but) : rows_(rows), columns_(columns) {
    const LazyFloatEnvironment environment;
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
      if (!has_order(rows.box(row))) continue;
      for (std::uint32_t column = &rows == &columns ? row + 1 : 0; column < columns.size(); ++column)
        if (has_order(columns.box(column)) && accepts(rows.filter(row), columns.filter(column)) &&
            number_of_pair(row, column) != but)
          add(row, column);
    }
  }

  /// The number of one that is nearer than the limit and comes first, or KnownFirst::unknown.
  std::uint64_t first(const NearLimit<S>& limit) const {
    const unsigned i = near_.first(limit);
    return i < near_.count() ? number_of_pair(pairs_[i].row, pairs_[i].column) : KnownFirst::unknown;
  }

  /// Those nearer to each other than the limit; `visit(row, column)` returns the limit from now on.
  template <class Visit>
  void visit(const NearLimit<S>& limit, const Visit& visit) {
    const auto distance_of = [&](unsigned i) {
      return outside_distance_below(rows_.box(pairs_[i].row), columns_.box(pairs_[i].column));
    };
    near_.visit(limit, distance_of, [&](unsigned i) { return visit(pairs_[i].row, pairs_[i].column); });
  }

 private:
  static_assert(thresholds.near_tests <= FewNear<S>::most);
  struct PairOfPlaces {
    std::uint32_t row, column;
  };

  void add(std::uint32_t row, std::uint32_t column) {
    const unsigned number = near_.count();
    pairs_[number] = {row, column};
    near_.add(number, about_squared(rows_.box(row), columns_.box(column)));
  }

  const Table& rows_;
  const Table& columns_;
  PairOfPlaces pairs_[thresholds.near_tests];
  FewNear<S> near_;
};

}  // namespace boxstream::detail
