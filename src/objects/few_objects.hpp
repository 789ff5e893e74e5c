// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include <boxstream/detail/object_table.hpp>

#include "base/has_order.hpp"
#include "base/thresholds.hpp"
#include "objects/impl.hpp"

namespace boxstream::detail {

/// `overlaps` without branches: which of the six comparisons fails first is unpredictable.
template <class S>
bool touch(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  return (a.min[0] <= b.max[0]) & (b.min[0] <= a.max[0]) & (a.min[1] <= b.max[1]) & (b.min[1] <= a.max[1]) &
         (a.min[2] <= b.max[2]) & (b.min[2] <= a.max[2]);
}

/// So few objects that to compare their boxes one by one is all there is to do. What touches is found first, as bits,
/// and then visited: the floating-point environment is looked at once.
constexpr unsigned most_of_few = thresholds.scanned_objects;

/// The places from `first` on of the objects of a small table that touch a box and accept a filter. In the default
/// environment.
template <class S>
std::uint64_t few_touching(const ObjectTable<S>& table, std::uint32_t first, const BasicAabb<S>& box, Filter filter) {
  if (!has_order(box)) return 0;
  const FilterTest accepts(filter, table.special_filters());
  std::uint64_t found = 0;
  for (std::uint32_t place = first; place < table.places(); ++place) {
    // An unbounded box seems to touch inverted boxes.
    const BasicAabb<S>& other = table.box(place);
    const bool is_one = touch(other, box) & has_order(other) & accepts(place);
    found |= std::uint64_t{is_one} << place;
  }
  return found;
}

/// The pairs of objects of two small tables, row by row, as numbers `most_of_few row + column`. In the default
/// environment.
template <class S>
std::uint64_t few_pairs(const ObjectTable<S>& rows, const ObjectTable<S>& columns) {
  static_assert(most_of_few * most_of_few <= 64);
  std::uint64_t found = 0;
  for (std::uint32_t row = 0; row < rows.places(); ++row)
    found |= few_touching(columns, 0, rows.box(row), rows.filter(row)) << (most_of_few * row);
  return found;
}

/// The same of one table.
template <class S>
std::uint64_t few_pairs(const ObjectTable<S>& table) {
  std::uint64_t found = 0;
  for (std::uint32_t row = 0; row + 1 < table.places(); ++row)
    found |= few_touching(table, row + 1, table.box(row), table.filter(row)) << (most_of_few * row);
  return found;
}

/// Calls `visit(row, column)` for pairs as found by `few_pairs`, until it returns false.
template <class Visit>
void for_each_of_few(std::uint64_t pairs, const Visit& visit) {
  for (; pairs != 0; pairs &= pairs - 1) {
    const auto pair = static_cast<std::uint32_t>(std::countr_zero(pairs));
    if (!visit(pair / most_of_few, pair % most_of_few)) return;
  }
}

}  // namespace boxstream::detail
