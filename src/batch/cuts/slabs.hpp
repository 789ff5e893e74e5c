// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace boxstream::detail {

/// How boxes are cut into slabs along one axis: at ascending keys, each of which belongs to the slab before it.
class Slabs {
 public:
  static constexpr unsigned most = 64;
  static constexpr unsigned groups = 8;  ///< of consecutive slabs, all but the last of equal size

  int axis = -1;  ///< -1: not at all
  unsigned count = 1;
  unsigned most_crossed = 0;  ///< boundaries that a box may cross without being *large*

  unsigned bit() const { return axis < 0 ? 0 : 1u << axis; }  ///< of Record::before

  /// Cuts at `boundaries` keys, fewer than `most`.
  void cut(const std::int32_t* keys, unsigned boundaries) {
    assert(boundaries < most && std::is_sorted(keys, keys + boundaries));
    count = boundaries + 1;
    per_group = (count + groups - 1) / groups;
    std::fill_n(keys_, most + groups, INT32_MAX);  // nothing is beyond
    for (unsigned b = 0; b < boundaries; ++b) keys_[b % per_group * groups + b / per_group] = keys[b];
  }

  /// The `i`th key of each group, and beyond them what may be read but means nothing; the last is the group's end.
  const std::int32_t* keys(unsigned i) const { return keys_ + i * groups; }
  unsigned per_group = 1;

 private:
  std::int32_t keys_[most + groups];
};

}  // namespace boxstream::detail
