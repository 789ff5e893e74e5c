// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/arena.hpp"
#include "batch/records/columns.hpp"

namespace boxstream::detail {

/// Which cells of a grid the boxes of a set touch: a bit each, the 64 of axis x in a word. Cells are numbered by
/// monotone maps of keys, so boxes that overlap share a cell.
///
/// There are four words for each row of cells. A box is marked in the one that says whether it reaches into the next
/// row in y, and in z; `finish` then makes it the union of the rows that such a box touches. So most boxes are marked,
/// and looked for, in one word. *Wide* ones reach farther, and are marked and looked for row by row.
class Occupancy {
 public:
  /// Nothing is marked. The words lie in the arena.
  Occupancy(unsigned cells, Arena& arena);

  /// Marks those boxes of a block that have their bit in `which`.
  void mark(const CellColumns& boxes, std::uint64_t which) {
    for (std::uint64_t left = which & ~boxes.wide; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      words_[boxes.row[i]] |= boxes.x[i];
    }
    for (std::uint64_t left = which & boxes.wide; left != 0; left &= left - 1) mark_wide(boxes, std::countr_zero(left));
  }

  /// After the last has been marked, and before the first is looked for.
  void finish();

  /// Which boxes of a block may overlap a marked one.
  std::uint64_t may_meet(const CellColumns& boxes) const {
    std::uint64_t found = find_marked(boxes, words_) & ~boxes.wide;
    for (std::uint64_t left = boxes.wide; left != 0; left &= left - 1)
      found |= std::uint64_t{wide_may_meet(boxes, std::countr_zero(left))} << std::countr_zero(left);
    return found;
  }

 private:
  // A plane takes two layers of rows. What takes more is taken to be everywhere.
  unsigned most_rows() const { return 2 * cells_; }

  void mark_wide(const CellColumns& boxes, int i);
  bool wide_may_meet(const CellColumns& boxes, int i) const;

  unsigned cells_;
  std::uint64_t* words_;
  std::uint64_t in_all_rows_ = 0;
};

}  // namespace boxstream::detail
