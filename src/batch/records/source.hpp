// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "base/keys.hpp"
#include "batch/records/columns.hpp"
#include "batch/records/load.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// Up to load_block records of a source. Only those with their bit in `valid` are to be used.
struct Loaded {
  const Record* records;
  std::uint64_t valid;
};

/// The input boxes, read as records.
template <class S>
class BoxSource {
 public:
  static constexpr bool is_in_memory = false;  ///< all in a row, so that no load makes them

  BoxSource(Span<const BasicAabb<S>> boxes, const KeyMap<S>& keys) : boxes_(boxes), keys_(keys) {}

  /// Other boxes with the same map.
  BoxSource with(Span<const BasicAabb<S>> boxes) const { return {boxes, keys_}; }

  Span<const BasicAabb<S>> boxes() const { return boxes_; }
  std::size_t size() const { return boxes_.size(); }
  bool valid(std::size_t i) const { return has_valid_keys(boxes_[i]); }
  /// For samples: bits that its keys lost are not noted.
  Record operator[](std::size_t i) const {
    Record r;
    for (int d = 0; d < 3; ++d) {
      r.lo[d] = keys_(boxes_[i].min[d], d);
      r.hi[d] = keys_.high(boxes_[i].max[d], d);
    }
    r.id = static_cast<std::uint32_t>(i);
    r.before = 0;
    return r;
  }

  /// `count` records, 1 to load_block, from `begin` on, in `buffer` or elsewhere.
  Loaded load(std::size_t begin, std::size_t count, Record* buffer) const {
    return {buffer, load_records(&boxes_[begin], count, static_cast<std::uint32_t>(begin), keys_, buffer)};
  }

  /// The same as columns. Returns which are valid.
  std::uint64_t load(std::size_t begin, std::size_t count, BoxColumns& out) const {
    if constexpr (sizeof(S) == 4) {
      return load_columns(&boxes_[begin], count, keys_.faces(), out);
    } else {
      Record buffer[load_block];
      const Loaded loaded = load(begin, count, buffer);
      load_columns(loaded.records, count, loaded.valid, out);
      return loaded.valid;
    }
  }

 private:
  Span<const BasicAabb<S>> boxes_;
  const KeyMap<S>& keys_;
};

/// Records of a node, all valid.
class RecordSource {
 public:
  static constexpr bool is_in_memory = true;

  explicit RecordSource(Span<const Record> records) : records_(records) {}

  std::size_t size() const { return records_.size(); }
  bool valid(std::size_t) const { return true; }
  const Record& operator[](std::size_t i) const { return records_[i]; }
  Loaded load(std::size_t begin, std::size_t count, Record*) const {
    return {&records_[begin], ~std::uint64_t{0} >> (load_block - count)};
  }

 private:
  Span<const Record> records_;
};

}  // namespace boxstream::detail
