// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <boxstream/span.hpp>

#include "search/arena.hpp"
#include "search/slabs.hpp"
#include "search/source.hpp"

namespace boxstream::detail {

/// The boxes of a node, split along one axis:
///
///      slab 0     slab 1     slab 2     slab 3         a box is copied to every slab that it touches; all copies
///   |  [--]    |     [----|-----]    |          |      but the first are marked as begun before their slab;
///   |     [----|----------|----------|-----]    |      one that spans more than half of the slabs is *large*:
///   |          |          |  [--]    |          |      it goes to a list of the node and is not copied at all
///
/// A small box and a small box meet in the slab that owns their pair; pairs with a large box are the node's own.
///
/// Boxes are counted and copied by ranges of the source. In each slab, those of one range come before those of the
/// next, so that how many ranges there are, and who works on them, does not show. Everything lives in the arena until
/// the frame ends.
class Partition {
 public:
  /// Nothing is read yet. Ranges for so many threads.
  Partition(std::size_t boxes, const Slabs& slabs, std::size_t threads, Arena& arena)
      : slabs_(slabs.count), bit_(1u << slabs.axis), boxes_(boxes) {
    if (threads > 1) ranges_ = std::clamp<std::size_t>(boxes / least_boxes_of_range, 1, ranges_per_thread * threads);
    first_slab_ = arena.allocate<std::uint8_t>(boxes);
    last_slab_ = arena.allocate<std::uint8_t>(boxes);
    begin_ = arena.allocate<std::size_t>(slabs_ + 2);
    row_size_ = (slabs_ + 2 + 7) / 8 * 8;  // whole cache lines
    rows_ = arena.allocate<std::size_t>(ranges_ * row_size_);
  }

  std::size_t ranges() const { return ranges_; }

  /// Finds the slabs of the valid boxes of one range of `source`, and counts; nothing is copied yet.
  template <class Source>
  void count(const Source& source, const Slabs& slabs, std::size_t range) {
    std::uint32_t begins[Slabs::most + 1] = {}, ends[Slabs::most + 1] = {};
    Record buffer[load_block];
    for (std::size_t begin = range_begin(range), end = range_begin(range + 1); begin < end; begin += load_block) {
      const std::size_t size = std::min(load_block, end - begin);
      const Loaded loaded = source.load(begin, size, buffer);
      std::uint8_t *const first_slab = first_slab_ + begin, *const last_slab = last_slab_ + begin;
      locate(loaded.records, size, slabs, first_slab, last_slab, begins, ends);
      for (std::uint64_t left = ~loaded.valid & ~std::uint64_t{0} >> (load_block - size); left != 0; left &= left - 1) {
        const int i = std::countr_zero(left);
        --begins[std::exchange(first_slab[i], absent)];
        --ends[last_slab[i]];
      }
    }
    std::size_t* const counts = row(range);
    std::size_t touching = 0, small = 0;
    for (std::size_t s = 0; s < slabs_; ++s) {
      small += begins[s];
      counts[s] = touching += begins[s];
      touching -= ends[s];
    }
    counts[slabs_] = begins[slabs_];
    counts[slabs_ + 1] = small;
  }

  /// After all ranges were counted: makes positions of counts.
  void sum() {
    std::size_t position = 0;
    for (std::size_t s = 0; s <= slabs_; ++s) {
      begin_[s] = position;
      for (std::size_t range = 0; range < ranges_; ++range) position += std::exchange(row(range)[s], position);
      if (s < slabs_) largest_slab_ = std::max(largest_slab_, position - begin_[s]);
    }
    begin_[slabs_ + 1] = position;
    for (std::size_t range = 0; range < ranges_; ++range) small_count_ += row(range)[slabs_ + 1];
  }

  std::size_t boxes() const { return small_count_ + large_count(); }
  std::size_t large_count() const { return begin_[slabs_ + 1] - begin_[slabs_]; }
  std::size_t copies() const { return begin_[slabs_]; }
  std::size_t largest_slab() const { return largest_slab_; }

  /// Room for the copies.
  void make_room(Arena& arena) { records_ = arena.allocate<Record>(begin_[slabs_ + 1]); }

  /// Copies the boxes of one range to their slabs.
  template <class Source>
  void scatter(const Source& source, std::size_t range) {
    Record buffer[load_block];
    for (std::size_t begin = range_begin(range), end = range_begin(range + 1); begin < end; begin += load_block) {
      const std::size_t size = std::min(load_block, end - begin);
      copy_to_slabs(source.load(begin, size, buffer).records, size, first_slab_ + begin, last_slab_ + begin, bit_,
                    absent, row(range), records_);
    }
  }

  std::size_t slabs() const { return slabs_; }
  Span<const Record> slab(std::size_t s) const { return {records_ + begin_[s], begin_[s + 1] - begin_[s]}; }
  Span<const Record> large() const { return slab(slabs_); }

  /// All small boxes once, as they came. Overwrites the slabs: for after they have been dealt with.
  Span<const Record> gather_small() {
    std::size_t kept = begin_[1];  // slab 0 has no copies but first ones
    for (std::size_t i = begin_[1]; i < begin_[slabs_]; ++i)
      if ((records_[i].before & bit_) == 0) records_[kept++] = records_[i];
    return {records_, kept};
  }

 private:
  static constexpr std::uint8_t absent = 255;  // for a first slab
  // Several for each thread, because threads do not start at the same time; none so short that handing it out shows.
  static constexpr std::size_t ranges_per_thread = 4;
  static constexpr std::size_t least_boxes_of_range = 4096;

  std::size_t range_begin(std::size_t range) const {
    return range == ranges_ ? boxes_ : boxes_ / ranges_ * range / load_block * load_block;
  }

  /// Of one range: counts per slab, then of large boxes, then of small ones. Later: where the next box of each goes.
  std::size_t* row(std::size_t range) const { return rows_ + range * row_size_; }

  std::size_t slabs_;
  std::uint32_t bit_;
  std::size_t boxes_;  // of the source
  std::size_t ranges_ = 1;
  // Per box. The large ones are in a slab of their own, behind the others.
  std::uint8_t* first_slab_;
  std::uint8_t* last_slab_;
  std::size_t* begin_;  // per slab, and for large boxes: the first record; one more at the end
  std::size_t* rows_;   // see row
  std::size_t row_size_;
  Record* records_ = nullptr;
  std::size_t small_count_ = 0;
  std::size_t largest_slab_ = 0;
};

}  // namespace boxstream::detail
