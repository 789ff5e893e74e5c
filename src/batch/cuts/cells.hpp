// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "batch/cuts/slabs.hpp"
#include "batch/records/load.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// How the boxes of a node are cut in one pass: into slabs along one axis, the rows, and all of these into the same
/// slabs along another one, the columns, or into one. Cells are numbered row by row.
struct Grid {
  static constexpr unsigned most_cells = 256;  ///< open write streams of the scatter

  Slabs rows;
  Slabs columns;
  unsigned most_crossed = 0;  ///< that of rows; while no box of the sample crosses that many, all may be crossed

  unsigned cells() const { return rows.count * columns.count; }
  /// In place of a cell: of boxes that are large for the rows, and of invalid ones.
  unsigned large() const { return cells(); }
  unsigned absent() const { return cells() + 1; }
  unsigned lists() const { return cells() + 2; }

  /// For boxes unlike their sample: cuts along one axis alone, large boxes apart. False if it does so already.
  bool simplify() {
    if (is_simple()) return false;
    columns.axis = -1;
    columns.count = 1;
    rows.most_crossed = most_crossed;
    return true;
  }
  bool is_simple() const { return columns.count == 1 && rows.most_crossed == most_crossed; }
};

/// Which cells a box touches: the first, and how many rows and columns it reaches beyond.
struct Place {
  std::uint32_t bits;

  unsigned cell() const { return bits & 0xffff; }
  unsigned more_rows() const { return bits >> 16 & 0xff; }
  unsigned more_columns() const { return bits >> 24; }
};

/// Which of up to 64 boxes touch more than a cell, bit i for box i: the one in the next row, the one in the next
/// column, others.
struct Crossings {
  std::uint64_t row = 0, column = 0, further = 0;
};

/// Where each of load_block records belongs, the first `count` > 0 of which are boxes; those without their bit in
/// `valid` are absent. Adds to how many touch each cell, are large, and are absent.
Crossings locate(const Record* records, std::size_t count, std::uint64_t valid, const Grid& grid, Place* places,
                 std::uint32_t* counts);

/// Copies records to where the cursors of their cells are. Copies in rows and columns that a box does not begin in get
/// these axes' bits in `before`.
void copy_to_cells(const Record* records, std::size_t count, const Place* places, const Crossings& crossings,
                   const Grid& grid, std::size_t* cursors, Record* out);

}  // namespace boxstream::detail
