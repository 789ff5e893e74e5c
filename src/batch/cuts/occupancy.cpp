// SPDX-License-Identifier: MIT
#include "batch/cuts/occupancy.hpp"

#include <algorithm>

namespace boxstream::detail {

namespace {

/// The rows that a box touches.
struct Rows {
  unsigned first_y, last_y, first_z, last_z;

  Rows(const CellColumns& boxes, int i)
      : first_y(boxes.first[1][i]), last_y(boxes.last[1][i]), first_z(boxes.first[2][i]), last_z(boxes.last[2][i]) {}

  unsigned count() const { return (last_y - first_y + 1) * (last_z - first_z + 1); }

  /// Words that together stand for these rows, two by two where there are two.
  template <class Visit>
  void for_each_word(unsigned cells, const Visit& visit) const {
    const unsigned two_y = first_y < last_y ? 1 : 0, two_z = first_z < last_z ? 1 : 0;
    const std::size_t plane = (two_y + 2 * two_z) * CellGrid::rows(cells);
    const unsigned end_y = last_y - two_y, end_z = last_z - two_z;  // where the last two begin
    const auto visit_in_z = [&](unsigned z) {
      visit(plane + CellGrid::row_of(first_y, z, cells));
      for (unsigned y = first_y + 2; y < end_y; y += 2) visit(plane + CellGrid::row_of(y, z, cells));
      visit(plane + CellGrid::row_of(end_y, z, cells));
    };
    visit_in_z(first_z);
    for (unsigned z = first_z + 2; z < end_z; z += 2) visit_in_z(z);
    visit_in_z(end_z);
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
    rows.for_each_word(cells_, [&](std::size_t word) { words_[word] |= x; });
}

bool Occupancy::wide_may_meet(const CellColumns& boxes, int i) const {
  const Rows rows(boxes, i);
  if (rows.count() > most_rows()) return true;
  std::uint64_t found = 0;
  rows.for_each_word(cells_, [&](std::size_t word) { found |= words_[word]; });
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
