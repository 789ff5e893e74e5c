// SPDX-License-Identifier: MIT
#include "search/occupancy.hpp"

#include <algorithm>

namespace boxstream::detail {

namespace {

/// The rows that a box touches.
struct Rows {
  unsigned first_y, last_y, first_z, last_z;

  Rows(const CellColumns& boxes, int i)
      : first_y(boxes.first[1][i]), last_y(boxes.last[1][i]), first_z(boxes.first[2][i]), last_z(boxes.last[2][i]) {}

  unsigned count() const { return (last_y - first_y + 1) * (last_z - first_z + 1); }

  template <class Visit>
  void for_each(unsigned cells, const Visit& visit) const {
    for (unsigned z = first_z; z <= last_z; ++z)
      for (unsigned y = first_y; y <= last_y; ++y) visit(CellGrid::row_of(y, z, cells));
  }
};

}  // namespace

Occupancy::Occupancy(unsigned cells, Arena& arena)
    : cells_(cells), words_(arena.allocate<std::uint64_t>(4 * CellGrid::rows(cells))) {
  std::fill_n(words_, 4 * CellGrid::rows(cells), 0);
}

void Occupancy::mark_wide(const CellColumns& boxes, int i) {
  const Rows rows(boxes, i);
  const std::uint64_t x = boxes.x[i];
  if (rows.count() > most_rows())
    in_all_rows_ |= x;
  else
    rows.for_each(cells_, [&](std::uint32_t row) { words_[row] |= x; });
}

bool Occupancy::wide_may_meet(const CellColumns& boxes, int i) const {
  const Rows rows(boxes, i);
  if (rows.count() > most_rows()) return true;
  std::uint64_t found = 0;
  rows.for_each(cells_, [&](std::uint32_t row) { found |= words_[row]; });
  return (found & boxes.x[i]) != 0;
}

// Rows have a margin on all sides, so that each has neighbours.
void Occupancy::finish() {
  const std::size_t next_y = 1, next_z = cells_ + 2, size = CellGrid::rows(cells_);
  std::uint64_t *const one = words_, *const in_y = one + size, *const in_z = in_y + size, *const in_both = in_z + size;
  const std::size_t begin = next_z + next_y, end = size - begin;
  for (std::size_t i = begin; i < end; ++i)
    one[i] |= in_all_rows_ | in_y[i] | in_y[i - next_y] | in_z[i] | in_z[i - next_z] | in_both[i] |
              in_both[i - next_y] | in_both[i - next_z] | in_both[i - next_z - next_y];
  for (std::size_t i = begin; i < end; ++i) {
    in_y[i] = one[i] | one[i + next_y];
    in_z[i] = one[i] | one[i + next_z];
    in_both[i] = in_y[i] | one[i + next_z] | one[i + next_z + next_y];
  }
}

}  // namespace boxstream::detail
