// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "keys.hpp"

namespace boxstream::detail {

/// A box on its way through the tree: its bounds as keys, the caller's index, and for each axis (bit d) whether
/// the box begins before the region of the node that this copy is in.
///
/// A pair belongs to the one region that holds the low corner of the intersection. On an axis that corner is the larger
/// of the two low ends, so a region owns a pair unless both boxes began before it: (a.before & b.before) == 0.
struct Record {
  std::int32_t lo[3];
  std::int32_t hi[3];
  std::uint32_t id;
  std::uint32_t before;
};
static_assert(sizeof(Record) == 32);

/// The input boxes, read as records.
template <class S>
class BoxSource {
 public:
  BoxSource(Span<const BasicAabb<S>> boxes, const KeyMap<S>& keys) : boxes_(boxes), keys_(keys) {}

  std::size_t size() const { return boxes_.size(); }
  bool valid(std::size_t i) const { return has_valid_keys(boxes_[i]); }
  Record operator[](std::size_t i) const {
    Record r;
    for (int d = 0; d < 3; ++d) {
      r.lo[d] = keys_(boxes_[i].min[d], d);
      r.hi[d] = keys_(boxes_[i].max[d], d);
    }
    r.id = static_cast<std::uint32_t>(i);
    r.before = 0;
    return r;
  }

 private:
  Span<const BasicAabb<S>> boxes_;
  const KeyMap<S>& keys_;
};

/// Records of a node, all valid.
class RecordSource {
 public:
  explicit RecordSource(Span<const Record> records) : records_(records) {}

  std::size_t size() const { return records_.size(); }
  bool valid(std::size_t) const { return true; }
  const Record& operator[](std::size_t i) const { return records_[i]; }

 private:
  Span<const Record> records_;
};

}  // namespace boxstream::detail
