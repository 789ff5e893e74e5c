// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include <boxstream/span.hpp>

#include "arena.hpp"
#include "slabs.hpp"
#include "source.hpp"

namespace boxstream::detail {

/// The boxes of a node, split along one axis:
///
///      slab 0     slab 1     slab 2     slab 3         a box is copied to every slab that it touches; all copies
///   |  [--]    |     [----|-----]    |          |      but the first are marked as begun before their slab;
///   |     [----|----------|----------|-----]    |      one that spans more than half of the slabs is *large*:
///   |          |          |  [--]    |          |      it goes to a list of the node and is not copied at all
///
/// A small box and a small box meet in the slab that owns their pair; pairs with a large box are the node's own.
class Partition {
 public:
  /// Finds the slabs of all valid boxes of `source` and counts; nothing is copied yet. Lives in the arena until the
  /// frame ends.
  template <class Source>
  Partition(const Source& source, const Slabs& slabs, Arena& arena) : slabs_(slabs.count), bit_(1u << slabs.axis) {
    const std::size_t n = source.size();
    first_slab_ = arena.allocate<std::uint8_t>(n);
    last_slab_ = arena.allocate<std::uint8_t>(n);
    begin_ = arena.allocate<std::size_t>(slabs_ + 1);
    std::fill_n(begin_, slabs_ + 1, std::size_t{0});
    Record buffer[load_block];
    for (std::size_t begin = 0; begin < n; begin += load_block) {
      const std::size_t count = std::min(load_block, n - begin);
      const Loaded loaded = source.load(begin, count, buffer);
      locate(loaded.records, count, slabs, first_slab_ + begin, last_slab_ + begin);
      for (std::size_t i = 0; i < count; ++i) {
        std::uint8_t& first = first_slab_[begin + i];
        const std::uint8_t last = last_slab_[begin + i];
        if ((loaded.valid >> i & 1) == 0) {
          first = absent;
        } else if (is_large(first, last)) {
          ++large_count_;
        } else {
          ++small_count_;
          for (unsigned s = first; s <= last; ++s) ++begin_[s];
        }
      }
    }
    // From counts to offsets.
    std::size_t total = 0;
    for (std::size_t s = 0; s <= slabs_; ++s) {
      const std::size_t count = begin_[s];
      largest_slab_ = std::max(largest_slab_, count);
      begin_[s] = total;
      total += count;
    }
  }

  std::size_t boxes() const { return small_count_ + large_count_; }
  std::size_t copies() const { return begin_[slabs_]; }
  std::size_t largest_slab() const { return largest_slab_; }

  /// Copies the boxes to their slabs.
  template <class Source>
  void scatter(const Source& source, Arena& arena) {
    records_ = arena.allocate<Record>(begin_[slabs_]);
    large_ = arena.allocate<Record>(large_count_);
    auto* cursor = arena.allocate<std::size_t>(slabs_);
    std::copy_n(begin_, slabs_, cursor);
    std::size_t large = 0;
    Record buffer[load_block];
    for (std::size_t begin = 0; begin < source.size(); begin += load_block) {
      const std::size_t count = std::min(load_block, source.size() - begin);
      const Record* const records = source.load(begin, count, buffer).records;
      for (std::size_t i = 0; i < count; ++i) {
        const unsigned first = first_slab_[begin + i], last = last_slab_[begin + i];
        if (first == absent) continue;
        if (is_large(first, last)) {
          large_[large++] = records[i];
          continue;
        }
        records_[cursor[first]++] = records[i];
        if (last == first) continue;
        Record copy = records[i];
        copy.before |= bit_;
        for (unsigned s = first + 1; s <= last; ++s) records_[cursor[s]++] = copy;
      }
    }
  }

  std::size_t slabs() const { return slabs_; }
  Span<const Record> slab(std::size_t s) const { return {records_ + begin_[s], begin_[s + 1] - begin_[s]}; }
  Span<const Record> large() const { return {large_, large_count_}; }

  /// All small boxes once, as they came. Overwrites the slabs: for after they have been dealt with.
  Span<const Record> gather_small() {
    std::size_t kept = begin_[1];  // slab 0 has no copies but first ones
    for (std::size_t i = begin_[1]; i < begin_[slabs_]; ++i)
      if ((records_[i].before & bit_) == 0) records_[kept++] = records_[i];
    return {records_, kept};
  }

 private:
  static constexpr std::uint8_t absent = 255;

  bool is_large(unsigned first, unsigned last) const { return slabs_ >= 4 && (last - first + 1) * 2 > slabs_; }

  std::size_t slabs_;
  std::uint32_t bit_;
  std::uint8_t* first_slab_;
  std::uint8_t* last_slab_;
  std::size_t* begin_;  // per slab: its first record; one more at the end
  Record* records_ = nullptr;
  Record* large_ = nullptr;
  std::size_t small_count_ = 0;
  std::size_t large_count_ = 0;
  std::size_t largest_slab_ = 0;
};

}  // namespace boxstream::detail
