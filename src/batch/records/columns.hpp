// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "batch/records/load.hpp"
#include "batch/records/pair_buffer.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// The keys of a block of boxes, as a structure of arrays. A lane without a valid box overlaps nothing; lanes
/// beyond the next multiple of `lane_group` after the last box are not set.
template <class Key, std::size_t capacity = load_block>
struct BoxColumnsOf {
  alignas(64) Key lo[3][capacity];
  alignas(64) Key hi[3][capacity];
};
using BoxColumns = BoxColumnsOf<std::int32_t>;

/// A grid of cells by monotone maps of keys: 64 on axis x, up to 256 on the others. The first cell of an axis is for
/// boxes below its range, the last for boxes above it.
struct CellGrid {
  static constexpr unsigned cells_in_x = 64;

  /// Cells of about the same size between two keys within the range; those at its ends are larger.
  struct Axis {
    Axis() = default;
    Axis(KeyKind kind, std::int32_t min, std::int32_t max, std::int32_t from, std::int32_t to, unsigned cells);

    std::int32_t min, max;   ///< the range
    std::int32_t from, to;   ///< those two
    bool are_floats;         ///< the keys, in the order of floats; otherwise they are spaced evenly as they are
    float origin, scale;     ///< from float to cell; its bits are as precise as they have to be
    std::int32_t last_cell;  ///< the one above the range
  };

  Axis axes[3];
  unsigned cells;  ///< on axes y and z

  /// Rows of cells along x have numbers, with a margin around them.
  static constexpr std::size_t rows(unsigned cells) { return std::size_t{cells + 2} * (cells + 2); }
  static constexpr std::uint32_t row_of(unsigned y, unsigned z, unsigned cells) {
    return (z + 1) * (cells + 2) + y + 1;
  }
};

/// Where in a grid the boxes of a block are. Lanes without a box are not to be used.
struct CellColumns {
  std::uint64_t x[load_block];    ///< the cells on axis x that the box touches, a bit each
  std::uint32_t row[load_block];  ///< of its first cell, plus once, twice or three times all rows if it reaches into
                                  ///< the next in y, in z or in both
  std::uint64_t wide;             ///< boxes that reach farther, whose row is not to be used
  std::uint8_t first[3][load_block], last[3][load_block];

  /// Boxes that are not in the first or the last cell of an axis altogether.
  std::uint64_t inside(const CellGrid& grid) const;
};

constexpr std::size_t lane_group = 16;

/// Reads `count` <= load_block boxes. Returns which are valid, box i as bit i.
std::uint64_t load_columns(const Aabb* boxes, std::size_t count, Faces faces, BoxColumns& out);

/// The same of `count` records, of which those with their bit in `valid` are.
void load_columns(const Record* records, std::size_t count, std::uint64_t valid, BoxColumns& out);

/// In the default floating-point environment.
void locate_cells(const BoxColumns& boxes, const CellGrid& grid, CellColumns& out);

/// The boxes with a marked cell in the word of their row. Not for wide boxes.
std::uint64_t find_marked(const CellColumns& boxes, const std::uint64_t* words);

struct FewAndMany {
  std::size_t few = 0, many = 0;
};

/// Emits the pairs between up to `thresholds.most_few` boxes and many others, which are read a block at a time. With
/// `few_first` the few are first in pairs. Counts valid boxes. False when the search is to stop.
bool compare_few(Span<const Aabb> few, Span<const Aabb> many, Faces faces, bool few_first, PairBuffer& pairs,
                 FewAndMany& valid);
bool compare_few(Span<const Aabb64> few, Span<const Aabb64> many, Faces faces, bool few_first, PairBuffer& pairs,
                 FewAndMany& valid);

/// Emits the pairs of `count` <= thresholds.most_small boxes that overlap, the smaller index first, and stops early
/// when the search is to stop. Indices count from `first_id`. Returns how many boxes are valid.
std::size_t compare_small(const Aabb* boxes, std::size_t count, Faces faces, std::uint32_t first_id, PairBuffer& pairs);
std::size_t compare_small(const Aabb64* boxes, std::size_t count, Faces faces, std::uint32_t first_id,
                          PairBuffer& pairs);

/// Boxes that were read, valid ones among them, and sets with at least two of these.
struct TinyCounts {
  std::size_t boxes = 0, valid = 0, sets = 0;
};

/// The same for `sets` sets one after the other, each of at most thresholds.most_tiny boxes: set i has those from
/// offsets[i] to offsets[i + 1], and the indices of `boxes`.
void compare_tiny(const Aabb* boxes, const std::uint64_t* offsets, std::size_t sets, Faces faces, PairBuffer& pairs,
                  TinyCounts& counts);
void compare_tiny(const Aabb64* boxes, const std::uint64_t* offsets, std::size_t sets, Faces faces, PairBuffer& pairs,
                  TinyCounts& counts);

}  // namespace boxstream::detail
