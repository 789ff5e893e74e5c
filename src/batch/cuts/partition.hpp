// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <boxstream/span.hpp>

#include "base/arena.hpp"
#include "base/thresholds.hpp"
#include "batch/cuts/cells.hpp"
#include "batch/records/source.hpp"

namespace boxstream::detail {

/// The boxes of a node, cut into the cells of a grid. Along one axis:
///
///      slab 0     slab 1     slab 2     slab 3         a box is copied to every slab that it touches; all copies
///   |  [--]    |     [----|-----]    |          |      but the first are marked as begun before their slab;
///   |     [----|----------|----------|-----]    |      one that spans more than a share of the slabs is *large*:
///   |          |          |  [--]    |          |      it goes to a list of the node and is not copied at all
///
/// Along two axes, the same holds for each of them, but only the first has large boxes.
///
/// A small box and a small box meet in the cell that owns their pair; pairs with a large box are the node's own.
///
/// Boxes are counted and copied by ranges of the source. In each cell, those of one range come before those of the
/// next, so that how many ranges there are, and which thread works on them, does not show. Everything lives in the
/// arena until the frame ends.
class Partition {
 public:
  /// Nothing is read yet. Ranges for that many threads. Records are kept from counting to copying unless they lie in
  /// the source.
  Partition(std::size_t boxes, const Grid& grid, std::size_t threads, bool lie_in_source, Arena& arena)
      : grid_(grid), cells_(grid.cells()), boxes_(boxes) {
    if (threads > 1)
      ranges_ = std::clamp<std::size_t>(boxes / thresholds.boxes_of_range, 1, ranges_per_thread * threads);
    places_ = arena.allocate<Place>(boxes + load_block);
    if (!lie_in_source) loaded_ = arena.allocate<Record>(boxes);
    crossings_ = arena.allocate<Crossings>((boxes + load_block - 1) / load_block);
    begin_ = arena.allocate<std::size_t>(grid_.lists());
    row_size_ = (grid_.lists() + 7) / 8 * 8;  // whole cache lines
    rows_ = arena.allocate<std::size_t>(ranges_ * row_size_);
  }

  std::size_t ranges() const { return ranges_; }

  /// Finds the cells of the boxes of one range of `source`, and counts; nothing is copied yet.
  template <class Source>
  void count(const Source& source, std::size_t range) {
    std::uint32_t counts[Grid::most_cells + 2] = {};
    assert(range < ranges_);
    Record last[load_block] = {};
    for (std::size_t begin = range_begin(range), end = range_begin(range + 1); begin < end; begin += load_block) {
      const std::size_t size = std::min(load_block, end - begin);
      Loaded loaded = source.load(begin, size, Source::is_in_memory ? nullptr : loaded_ + begin);
      if (size < load_block) loaded.records = std::copy_n(loaded.records, size, last) - size;
      crossings_[begin / load_block] = locate(loaded.records, size, loaded.valid, grid_, places_ + begin, counts);
    }
    std::copy_n(counts, grid_.lists(), row(range));
  }

  /// After all ranges were counted: makes positions of counts.
  void sum() {
    std::size_t position = 0;
    for (std::size_t s = 0; s < grid_.lists(); ++s) {
      begin_[s] = position;
      for (std::size_t range = 0; range < ranges_; ++range) position += std::exchange(row(range)[s], position);
      if (s < cells_) largest_cell_ = std::max(largest_cell_, position - begin_[s]);
    }
    absent_count_ = position - begin_[grid_.absent()];
  }

  std::size_t boxes() const { return boxes_ - absent_count_; }
  std::size_t invalid() const { return absent_count_; }
  std::size_t large_count() const { return begin_[cells_ + 1] - begin_[cells_]; }
  std::size_t copies() const { return begin_[cells_]; }
  std::size_t largest_cell() const { return largest_cell_; }

  /// Room for the copies.
  void make_room(Arena& arena) { records_ = arena.allocate<Record>(begin_[grid_.absent()] + absent_count_); }

  /// Copies the boxes of one range to their cells.
  template <class Source>
  void scatter(const Source& source, std::size_t range) {
    assert(range < ranges_ && records_ != nullptr);
    for (std::size_t begin = range_begin(range), end = range_begin(range + 1); begin < end; begin += load_block)
      copy_to_cells(loaded(source) + begin, std::min(load_block, end - begin), places_ + begin,
                    crossings_[begin / load_block], grid_, row(range), records_);
  }

  std::size_t cells() const { return cells_; }
  Span<const Record> cell(std::size_t s) const {
    assert(s <= cells_);
    return {records_ + begin_[s], begin_[s + 1] - begin_[s]};
  }
  Span<const Record> large() const { return cell(cells_); }

  /// Puts the small boxes of one range to those of all, once each and as they came. Overwrites the cells: for after
  /// they have been dealt with.
  template <class Source>
  void gather_small(const Source& source, std::size_t range) {
    assert(range < ranges_ && records_ != nullptr);
    std::size_t kept = small_before(range);
    Record unused;
    const Record* const all = loaded(source);
    for (std::size_t i = range_begin(range); i < range_begin(range + 1); ++i) {
      const std::size_t is_small = places_[i].cell() < cells_ ? 1 : 0;  // a branch would be mispredicted
      Record* const to[] = {&unused, records_ + kept};
      *to[is_small] = all[i];
      kept += is_small;
    }
  }
  /// After those of all ranges.
  Span<const Record> small() const { return {records_, small_before(ranges_)}; }

 private:
  // Several for each thread, because threads do not start at the same time.
  static constexpr std::size_t ranges_per_thread = 4;

  /// All of the source's records, after they were counted.
  template <class Source>
  const Record* loaded(const Source& source) const {
    if constexpr (Source::is_in_memory)
      return &source[0];
    else
      return loaded_;
  }

  std::size_t range_begin(std::size_t range) const {
    return range == ranges_ ? boxes_ : boxes_ / ranges_ * range / load_block * load_block;
  }

  /// How many small boxes the ranges before that one have: where the copying of one has ended, the next has begun.
  std::size_t small_before(std::size_t range) const {
    if (range == 0) return 0;
    const std::size_t* const ends = row(range - 1);
    return range_begin(range) - (ends[cells_] - begin_[cells_]) - (ends[grid_.absent()] - begin_[grid_.absent()]);
  }

  /// Of one range: counts per cell, then of large boxes, then of absent ones. Later: where the next box of each goes.
  std::size_t* row(std::size_t range) const { return rows_ + range * row_size_; }

  const Grid& grid_;
  std::size_t cells_;
  std::size_t boxes_;  // of the source
  std::size_t ranges_ = 1;
  Place* places_;         // per box
  Crossings* crossings_;  // per load_block of them
  std::size_t* begin_;    // per cell, and for large boxes, which lie behind: the first record; one more at the end
  std::size_t* rows_;     // see row
  std::size_t row_size_;
  Record* loaded_ = nullptr;
  Record* records_ = nullptr;
  std::size_t absent_count_ = 0;
  std::size_t largest_cell_ = 0;
};

}  // namespace boxstream::detail
