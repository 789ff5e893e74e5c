// SPDX-License-Identifier: MIT
// So few objects that to compare their boxes one by one is all there is to do. A query of one takes as long as a call
// or two, so this is compiled into the caller. What touches is found first, as bits, and then visited: the
// floating-point environment is looked at once.
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/has_order.hpp>
#include <boxstream/detail/lazy_float_environment.hpp>
#include <boxstream/detail/object_table.hpp>
#include <boxstream/detector.hpp>

namespace boxstream::detail {

/// A set of no more has no gaps. Compiled into programs: a lower number would need another one for the ABI.
constexpr std::size_t most_of_few = 8;

/// `overlaps` without branches: which of the six comparisons fails first is unpredictable.
template <class S>
bool touch(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  return (a.min[0] <= b.max[0]) & (b.min[0] <= a.max[0]) & (a.min[1] <= b.max[1]) & (b.min[1] <= a.max[1]) &
         (a.min[2] <= b.max[2]) & (b.min[2] <= a.max[2]);
}

/// The places from `first` on for which `is(box)`, as bits.
template <class S, class Is>
unsigned find_few(const ObjectTable<S>& table, std::uint32_t first, Is&& is) {
  const BasicAabb<S>* const boxes = table.boxes().data();
  unsigned found = 0;
  for (std::uint32_t place = first; place < table.size(); ++place) {
    const unsigned one = is(boxes[place]);
    found |= one << place;
  }
  return found;
}

inline std::uint32_t lowest_bit(unsigned bits) {
#if defined(__GNUC__)
  return static_cast<std::uint32_t>(__builtin_ctz(bits));
#else
  std::uint32_t bit = 0;
  while ((bits >> bit & 1) == 0) ++bit;
  return bit;
#endif
}

/// Calls `visit(place)` for places that were found, until it returns false; returns whether none did.
template <class Visit>
bool visit_few(unsigned found, Visit&& visit) {
  for (; found != 0; found &= found - 1)
    if (!visit(lowest_bit(found))) return false;
  return true;
}

/// Calls `visit(place)` for each object that touches a box and accepts a filter, until it returns false.
template <class S, class Visit>
void visit_few_overlaps(const ObjectTable<S>& table, const BasicAabb<S>& box, Filter filter, Visit&& visit) {
  unsigned found;
  {
    const LazyFloatEnvironment environment;
    found = find_few(table, 0, [&](const BasicAabb<S>& other) {
      const bool touches = touch(other, box), is_box = has_order(other);
      return touches & is_box;  // an unbounded box seems to touch inverted ones
    });
    if (!has_order(box)) found = 0;
  }
  visit_few(found, [&](std::uint32_t place) { return !accepts(filter, table.filter(place)) || visit(place); });
}

/// Calls `visit(row, column)` for each pair that touches and whose filters accept each other, until it returns false.
/// The two tables may be one.
template <class S, class Visit>
void visit_few_pairs(const ObjectTable<S>& rows, const ObjectTable<S>& columns, Visit&& visit) {
  const bool is_same = &rows == &columns;
  unsigned found[most_of_few];
  {
    const LazyFloatEnvironment environment;
    const unsigned ordered = find_few(columns, 0, has_order<S>);
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
      const BasicAabb<S>& box = rows.box(row);
      const auto touches = [&](const BasicAabb<S>& other) { return touch(box, other); };
      found[row] = find_few(columns, is_same ? row + 1 : 0, touches) & (has_order(box) ? ordered : 0);
    }
  }
  for (std::uint32_t row = 0; row < rows.size(); ++row)
    if (!visit_few(found[row], [&](std::uint32_t column) {
          return !accepts(rows.filter(row), columns.filter(column)) || visit(row, column);
        }))
      return;
}

}  // namespace boxstream::detail
