// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "search/keys.hpp"
#include "search/pair_buffer.hpp"

namespace boxstream::detail {

/// Up to so many boxes of one set, comparing all with all takes less time than what saves most of the comparisons.
constexpr std::size_t most_small = 64;

/// All boxes of a small set: keys by axis, from the input at once. Invalid boxes overlap nothing.
struct SmallSet {
  alignas(64) std::int32_t lo[3][most_small];
  alignas(64) std::int32_t hi[3][most_small];
  std::size_t size;
  std::size_t invalid;

  explicit SmallSet(Span<const Aabb> boxes);
  /// The upper halves of the keys: pairs that overlap by these have to be tested again.
  explicit SmallSet(Span<const Aabb64> boxes);
};

/// Emits the pairs of `set` that overlap, the smaller index first. False when the buffer's owner wants to stop.
bool compare_all(const SmallSet& set, PairBuffer& pairs);

}  // namespace boxstream::detail
